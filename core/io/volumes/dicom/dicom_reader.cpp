#include "core/io/volumes/dicom/dicom_reader.h"

#include "core/base/memory.h"
#include "core/io/volumes/dicom/dicom_folder.h"
#include "core/io/volumes/dicom/dicom_pixels.h"
#include "core/io/volumes/dicom/dicom_segments.h"
#include "core/io/volumes/dicom/dicom_stack.h"
#include "core/io/volumes/voxel_data.h"

#include <algorithm>
#include <cmath>
#include <oneapi/tbb/parallel_for.h>
#include <system_error>

namespace ramus::io {

namespace {

namespace fs = std::filesystem;

constexpr float kHeaders = 0.1F; // approximate share of the work

// Reads frames in the order of the stack, some at a time in parallel.
class PixelLoop {
public:
    PixelLoop(const std::vector<DicomImage>& images, const DicomStack& stack, const JobRange& job)
        : images_(images), stack_(stack), job_(job) {}

    Result<void> run(volume::VoxelStore& store) {
        // All compressed frames of a file are decoded at once.
        const DicomImage& first = images_[stack_.slices[0].image];
        std::string decoded;
        const bool at_once = first.layout.encapsulated && first.frames.size() > 1;
        if (at_once) {
            auto all = decode_pixels(first);
            if (!all) return tl::unexpected(all.error());
            decoded = std::move(*all);
        }
        constexpr std::size_t kAtOnce = 16;
        std::vector<Result<std::string>> pixels;
        for (std::size_t begin = 0; begin < stack_.slices.size(); begin += kAtOnce) {
            if (job_.cancelled()) return fail("cancelled");
            pixels.assign(std::min(kAtOnce, stack_.slices.size() - begin), std::string());
            tbb::parallel_for(std::size_t{0}, pixels.size(), [&](std::size_t n) {
                const DicomSlice& slice = stack_.slices[begin + n];
                pixels[n] = frame_pixels(images_[slice.image], slice.frame, at_once ? &decoded : nullptr);
            });
            for (std::size_t n = 0; n < pixels.size(); ++n) {
                if (!pixels[n]) return tl::unexpected(pixels[n].error());
                const DicomSlice& slice = stack_.slices[begin + n];
                const DicomImage& image = images_[slice.image];
                auto kept = append_frame(image, image.frames[slice.frame].scaling, *pixels[n], store);
                if (!kept) return kept;
            }
            job_.report(static_cast<float>(begin + pixels.size()) / static_cast<float>(stack_.slices.size()));
        }
        return {};
    }

private:
    const std::vector<DicomImage>& images_;
    const DicomStack& stack_;
    const JobRange& job_;
};

// The unit that all slices state; empty if they differ.
std::string common_unit(const std::vector<DicomImage>& images, const DicomStack& stack) {
    const auto unit_of = [&](const DicomSlice& slice) {
        return value_unit(images[slice.image], images[slice.image].frames[slice.frame]);
    };
    const std::string unit = unit_of(stack.slices[0]);
    return std::ranges::all_of(stack.slices, [&](const DicomSlice& slice) { return unit_of(slice) == unit; }) ? unit
                                                                                                              : "";
}

Result<volume::Volume> read_series(const std::vector<DicomImage>& images, const std::string& name,
                                   const ReadVolumeOptions& options, Job& job) {
    RAMUS_TRY(stack, stack_images(images, name));
    const volume::Keeping keeping = options.keeping();
    const DicomImage& first = images[stack.slices[0].image];
    for (const DicomSlice& slice : stack.slices)
        if (slice.frame == 0)
            if (auto fits = check_pixels(images[slice.image], keeping.memory_bytes); !fits)
                return tl::unexpected(fits.error());
    const glm::ivec3 size(first.columns, first.rows, static_cast<int>(stack.slices.size()));
    if (auto fits = check_declared_size({size, 0.0, 0.0, keeping.memory_bytes}, name); !fits)
        return tl::unexpected(fits.error());
    volume::VoxelStore store(size, keeping, name);
    const JobRange range(job, kHeaders, 1.0F);
    if (auto read = PixelLoop(images, stack, range).run(store); !read) return tl::unexpected(read.error());
    volume::Volume volume;
    std::move(store).finish(volume);
    volume.to_patient = stack.to_patient;
    volume.type = "DICOM" + (first.modality.empty() ? "" : " " + first.modality) + ", " + number_type_name(first);
    volume.unit_mm = 1.0; // PS3.3, C.7.6.2
    volume.value_unit = common_unit(images, stack);
    volume.modality = first.modality;
    const DicomSlice& middle = stack.slices[stack.slices.size() / 2];
    volume.window = images[middle.image].frames[middle.frame].window;
    volume.notes = std::move(stack.notes);
    return volume;
}

Result<volume::Volume> read_images(const std::vector<DicomImage>& images, const std::string& name,
                                   const ReadVolumeOptions& options, Job& job) {
    if (images.front().segments != SegmentKind::kNone)
        return read_segments(images.front(), options, JobRange(job, kHeaders, 1.0F));
    return read_series(images, name, options, job);
}

std::string files_text(std::size_t count) { return std::to_string(count) + (count == 1 ? " file" : " files"); }

// Reports damaged files of the folder as a note. If the volume failed, the damaged files, which leave slices out, are
// the likely reason: returns their error instead.
Result<volume::Volume> with_damage(Result<volume::Volume> volume, const std::vector<Error>& unreadable) {
    if (unreadable.empty() || (!volume && volume.error().what == "cancelled")) return volume;
    if (!volume) return tl::unexpected(unreadable.front());
    volume->notes.push_back("left out: " + files_text(unreadable.size()) + " beside it that cannot be read, " +
                            unreadable.front().where + ": " + unreadable.front().what);
    return volume;
}

} // namespace

Result<volume::Volume> read_dicom(ByteSource& source, const ReadVolumeOptions& options, Job& job) {
    const std::string& name = source.name();
    RAMUS_TRY(file, stored_bytes_of(source, memory_left(options.memory_bytes)));
    const bool in_file = file.bytes == nullptr;
    RAMUS_TRY(named, read_dicom_image(file));
    if (!named) return fail("this is a DICOM file without an image", name, "name an image, or the folder of a series");
    const bool alone = !in_file || named->frames.size() > 1 || named->segments != SegmentKind::kNone;
    if (alone || named->series_uid.empty()) return read_images({*named}, name, options, job);
    RAMUS_TRY(folder, read_dicom_headers(source.path().parent_path(), JobRange(job, 0.0F, kHeaders)));
    for (const DicomSeries& series : series_of(std::move(folder.images)))
        if (std::ranges::any_of(series.images, [&](const DicomImage& image) { return image.file.path == file.path; }))
            return with_damage(read_images(series.images, name, options, job), folder.unreadable);
    return read_images({*named}, name, options, job); // the file was removed meanwhile
}

Result<volume::Volume> read_dicom_folder(const fs::path& folder, const ReadVolumeOptions& options, Job& job) {
    const std::string name = folder.string();
    RAMUS_TRY(found, read_dicom_headers(folder, JobRange(job, 0.0F, kHeaders)));
    if (found.images.empty()) {
        if (!found.unreadable.empty()) return tl::unexpected(found.unreadable.front());
        return fail("there is no DICOM image in this folder", name, "name a folder with a series, or a file");
    }
    const std::vector<DicomSeries> all = series_of(std::move(found.images));
    auto volume = with_damage(read_images(all.front().images, name, options, job), found.unreadable);
    if (!volume || all.size() == 1) return volume;
    const auto listed = [](const DicomSeries& series) {
        return series_name(series.images.front()) + " (" + std::to_string(series.slices) + ")";
    };
    std::string others;
    constexpr std::size_t kListed = 10;
    for (std::size_t n = 1; n < std::min(all.size(), kListed); ++n) others += "; " + listed(all[n]);
    if (all.size() > kListed) others += "; and " + std::to_string(all.size() - kListed) + " more";
    volume->notes.push_back("the folder holds several series: read " + listed(all.front()) + "; name a file of " +
                            "another for that: " + others.substr(2));
    return volume;
}

bool holds_dicom(const fs::path& folder) {
    std::error_code error;
    for (fs::directory_iterator each(folder, error); !error && each != fs::directory_iterator();
         each.increment(error)) {
        std::error_code ignored;
        if (each->is_regular_file(ignored) && begins_as_dicom(each->path())) return true;
    }
    return false;
}

} // namespace ramus::io
