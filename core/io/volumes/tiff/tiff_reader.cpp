#include "core/io/volumes/tiff/tiff_reader.h"

#include "core/base/memory.h"
#include "core/base/printable.h"
#include "core/io/volumes/tiff/tiff_description.h"
#include "core/io/volumes/tiff/tiff_pixels.h"
#include "core/io/volumes/tiff/tiff_stack.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <iterator>
#include <system_error>
#include <utility>

namespace ramus::io {

namespace {

constexpr const char* kEqualPages = "write pages of one size and type, one file for each volume";

std::string size_text(const TiffPage& page) {
    return std::to_string(page.width) + " x " + std::to_string(page.height) + " pixels of " +
           std::to_string(page.bits) + " bits";
}

// The pages of the chosen planes.
class PlaneChoice {
public:
    PlaneChoice(const TiffFile& file, const TiffDescription& description, const std::string& name)
        : file_(file), description_(description), name_(name) {}

    [[nodiscard]] Result<std::vector<TiffPlane>> planes(const ChosenPart& part) const {
        const std::uint64_t all = description_.planes(), pages = file_.layout.pages.size();
        const bool raw = pages == 1 && all > 1 && description_.program == "ImageJ";
        if (!description_.runs.empty()) return listed(part);
        if (raw) return behind_first(part);
        if (all != pages)
            return fail(description_.program + "'s description says " + std::to_string(all) +
                            " planes, and the file has " + std::to_string(pages) + (pages == 1 ? " page" : " pages"),
                        name_, "copy the file again, or write it again with the program that made it");
        std::vector<TiffPlane> planes;
        for (std::uint64_t slice = 0; slice < description_.slices; ++slice)
            planes.push_back({0, description_.plane_at(part.channel, slice, part.time), 0});
        return planes;
    }

private:
    // Planes behind the first page, without pages of their own.
    [[nodiscard]] Result<std::vector<TiffPlane>> behind_first(const ChosenPart& part) const {
        const TiffPage& page = file_.layout.pages.front();
        if (page.compression != 1 || page.tiled() || !page.offsets || page.offsets->count != 1)
            return fail("ImageJ's description says " + std::to_string(description_.planes()) +
                            " images, and the file has 1 page",
                        name_, "copy the file again, or open it in ImageJ and save it again");
        constexpr std::uint64_t kMostImages = 1'000'000;
        if (description_.planes() > kMostImages)
            return fail("ImageJ's description says more than a million images", name_, "write it as OME-Zarr");
        const std::uint64_t plane_bytes = (page.width * page.bits + 7) / 8 * page.height;
        if (static_cast<double>(plane_bytes) * static_cast<double>(description_.planes()) >
            static_cast<double>(file_.layout.file_bytes))
            return fail("ImageJ's description says " + std::to_string(description_.planes()) +
                            " images, more than the file can hold",
                        name_, "copy the file again");
        std::vector<TiffPlane> planes;
        for (std::uint64_t slice = 0; slice < description_.slices; ++slice)
            planes.push_back({0, 0, plane_bytes * description_.plane_at(part.channel, slice, part.time)});
        return planes;
    }

    // Planes whose pages OME-XML lists.
    [[nodiscard]] Result<std::vector<TiffPlane>> listed(const ChosenPart& part) const {
        if (description_.slices > file_.layout.pages.size()) return missing(file_.layout.pages.size());
        std::vector<TiffPlane> planes;
        for (std::uint64_t slice = 0; slice < description_.slices; ++slice) {
            const std::uint64_t plane = description_.plane_at(part.channel, slice, part.time);
            const auto after = std::ranges::upper_bound(description_.runs, plane, {}, &TiffDescription::Run::plane);
            if (after == description_.runs.begin()) return missing(slice);
            const TiffDescription::Run& run = *std::prev(after);
            if (plane - run.plane >= run.count) return missing(slice);
            planes.push_back({0, run.page + (plane - run.plane), 0});
        }
        return planes;
    }

    [[nodiscard]] tl::unexpected<Error> missing(std::uint64_t slice) const {
        return fail("its OME description lists no page for slice " + std::to_string(slice + 1), name_,
                    "write it again with the program that made it");
    }

    const TiffFile& file_;
    const TiffDescription& description_;
    const std::string& name_;
};

std::string page_place(const TiffFile& file, std::size_t page) {
    return file.bytes.name + ": page " + std::to_string(page + 1);
}

// All pages that are planes, by their size, type and strips. Returns the type.
Result<VoxelType> check_pages(const std::vector<TiffFile>& files, const std::vector<TiffPlane>& planes, double memory) {
    const auto page_of = [&](const TiffPlane& plane) -> const TiffPage& {
        return files[plane.file].layout.pages[plane.page];
    };
    const TiffPage& first = page_of(planes.front());
    RAMUS_TRY(type, tiff_voxel_type(first, page_place(files[planes.front().file], planes.front().page)));
    for (const TiffPlane& plane : planes) {
        const std::string place = page_place(files[plane.file], plane.page);
        const TiffPage& page = page_of(plane);
        if (!page.same_pixels(first))
            return fail("its pages differ: " + size_text(first) + ", and " + size_text(page), place, kEqualPages);
        if (auto same = tiff_voxel_type(page, place); !same) return tl::unexpected(same.error());
        if (auto sound = check_tiff_page(page, memory, place); !sound) return tl::unexpected(sound.error());
    }
    return type;
}

// Notes about tags that this reader does not use, or not as other programs do.
void note_tags(const TiffFile& file, const TiffPage& page, volume::Volume& volume) {
    if (page.photometric == 0)
        volume.notes.emplace_back("the file shows 0 as white: its numbers were taken as they are");
    if (page.orientation != 1)
        volume.notes.emplace_back("the file's tag Orientation was not used: its first row of pixels is the first row");
    if (file.layout.left_out > 0)
        volume.notes.push_back(std::to_string(file.layout.left_out) +
                               " pages were left out, which are smaller copies or masks of other pages");
}

Result<volume::Volume> read_planes(std::vector<TiffFile> files, const std::vector<TiffPlane>& planes,
                                   const TiffDescription& description, const ReadVolumeOptions& options, Job& job) {
    const std::string name =
        files.size() > 1 ? files.front().bytes.path.parent_path().string() + "/" : files.front().bytes.name;
    const volume::Keeping keeping = options.keeping();
    RAMUS_TRY(type, check_pages(files, planes, keeping.memory_bytes));
    const TiffPage page = files[planes.front().file].layout.pages[planes.front().page];
    VoxelLayout layout;
    layout.size = {static_cast<int>(page.width), static_cast<int>(page.height), static_cast<int>(planes.size())};
    layout.type = type;
    double most = 0.0;
    for (const TiffFile& file : files) most += most_tiff_bytes(file);
    // Before anything of the size that the tags claim is decoded.
    const double bytes = static_cast<double>(bytes_of(type)) * static_cast<double>(layout.size.x) *
                         static_cast<double>(layout.size.y) * static_cast<double>(layout.size.z);
    if (auto fits = check_declared_size({layout.size, bytes, most, keeping.memory_bytes}, name); !fits)
        return tl::unexpected(fits.error());
    const TiffFile first{files.front().bytes,
                         {false, files.front().layout.big, 0, {}, {}, files.front().layout.left_out}};
    RAMUS_TRY(source, ByteSource::of_stage(tiff_stage(std::move(files), planes), name, most));
    RAMUS_TRY(volume, read_voxels(source, 0, layout, keeping, job));
    if (auto placed = place_by(description.claims, volume, name); !placed) return tl::unexpected(placed.error());
    note_tags(first, page, volume);
    volume.type = std::string(first.layout.big ? "BigTIFF" : "TIFF") +
                  (description.program.empty() ? "" : " of " + description.program) + ", " +
                  (page.bits == 1 ? "single bits" : std::string(name_of(type)));
    return std::move(volume);
}

Result<volume::Volume> read_pages(TiffFile file, const ReadVolumeOptions& options, Job& job) {
    const std::string name = file.bytes.name;
    RAMUS_TRY(description, tiff_description(file.layout, name));
    RAMUS_TRY(part, chosen_part(description.parts, options.part, name));
    RAMUS_TRY(planes, PlaneChoice(file, description, name).planes(part));
    std::vector<TiffFile> files;
    files.push_back(std::move(file));
    RAMUS_TRY(volume, read_planes(std::move(files), planes, description, options, job));
    if (!part.words.empty()) volume.type += ", " + part.words;
    return std::move(volume);
}

Result<volume::Volume> read_stack(const std::vector<std::filesystem::path>& paths, const ReadVolumeOptions& options,
                                  Job& job) {
    std::vector<TiffFile> files;
    std::vector<TiffPlane> planes;
    for (const std::filesystem::path& path : paths) {
        if (job.cancelled()) return fail("cancelled");
        StoredBytes bytes{path, nullptr, path.string()};
        RAMUS_TRY(layout, tiff_layout(bytes));
        if (layout.pages.size() > 1)
            return fail("it has " + std::to_string(layout.pages.size()) + " pages, and the files of a stack have one",
                        bytes.name, "put a file with several pages into a folder of its own, and name the file");
        if (!files.empty()) layout.description.clear(); // of each slice: may be long
        planes.push_back({files.size(), 0, 0});
        files.push_back({std::move(bytes), std::move(layout)});
    }
    // Of the description only distances: it may describe the whole stack, or one slice.
    RAMUS_TRY(described, tiff_description(files.front().layout, files.front().bytes.name));
    if (auto only = chosen_part({}, options.part, files.front().bytes.name); !only) return tl::unexpected(only.error());
    TiffDescription description;
    description.program = described.program;
    description.claims = described.claims;
    description.claims.notes.push_back("read as a stack of " + std::to_string(paths.size()) + " files, " +
                                       printable(paths.front().filename().string()) + " to " +
                                       printable(paths.back().filename().string()));
    return read_planes(std::move(files), planes, description, options, job);
}

} // namespace

Result<volume::Volume> read_tiff(ByteSource& source, const ReadVolumeOptions& options, Job& job) {
    RAMUS_TRY(bytes, stored_bytes_of(source, memory_left(options.memory_bytes)));
    RAMUS_TRY(layout, tiff_layout(bytes));
    if (layout.pages.size() == 1 && !bytes.path.empty()) {
        RAMUS_TRY(described, tiff_description(layout, bytes.name));
        if (described.planes() == 1 && described.runs.size() < 2) {
            RAMUS_TRY(stack, tiff_stack_of(bytes.path));
            if (stack.size() > 1) return read_stack(stack, options, job);
        }
    }
    return read_pages({std::move(bytes), std::move(layout)}, options, job);
}

Result<volume::Volume> read_tiff_folder(const std::filesystem::path& folder, const ReadVolumeOptions& options,
                                        Job& job) {
    RAMUS_TRY(files, tiff_stack_in(folder));
    if (files.size() > 1) return read_stack(files, options, job);
    RAMUS_TRY(source, ByteSource::open(files.front(), Unpack::kNothing));
    return read_tiff(source, options, job);
}

bool holds_tiff(const std::filesystem::path& folder) {
    std::error_code error;
    for (std::filesystem::directory_iterator each(folder, error);
         !error && each != std::filesystem::directory_iterator(); each.increment(error)) {
        std::error_code ignored;
        if (!names_tiff(each->path()) || !each->is_regular_file(ignored)) continue;
        std::array<char, 4> head{};
        std::ifstream stream(each->path(), std::ios::binary);
        if (stream.read(head.data(), head.size()) && is_tiff({head.data(), head.size()})) return true;
    }
    return false;
}

} // namespace ramus::io
