#include "core/io/volumes/dicom/dicom_segments.h"

#include "core/io/volumes/dicom/dicom_pixels.h"
#include "core/io/volumes/dicom/dicom_stack.h"
#include "core/io/volumes/voxel_data.h"
#include "core/volume/overlap_table.h"
#include "core/volume/voxel_store.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>
#include <utility>

namespace ramus::io {

namespace {

constexpr double kOneSlice = 1e-3; // mm
constexpr double kOffSlice = 0.25; // of a step, as of series
constexpr double kMostSlices = 65535;

// Every label is below this number.
std::int32_t above_labels(const DicomImage& image) {
    if (image.segments == SegmentKind::kLabels) return 65536; // its pixels have 16 bits
    std::int32_t most = 0;
    for (const DicomFrame& frame : image.frames) most = std::max(most, frame.segment);
    return most + 1;
}

class Segments {
public:
    Segments(const DicomImage& image, const volume::Keeping& keeping, const JobRange& job)
        : image_(image), keeping_(keeping), job_(job), overlaps_(above_labels(image)), labels_(pixels_of_frame()) {}

    Result<volume::Volume> run() {
        if (auto placed = place_frames(); !placed) return tl::unexpected(placed.error());
        if (auto fits = check_pixels(image_, keeping_.memory_bytes); !fits) return tl::unexpected(fits.error());
        const glm::ivec3 size(image_.columns, image_.rows, slices_);
        if (auto fits = check_declared_size({size, 0.0, 0.0, keeping_.memory_bytes}, image_.file.name); !fits)
            return tl::unexpected(fits.error());
        auto sound = check_affine(to_patient_, size, "geometry (positions and orientation of its frames)",
                                  "export it again", image_.file.name);
        if (!sound) return tl::unexpected(sound.error());
        volume::VoxelStore store(size, keeping_, image_.file.name);
        if (auto read = read_slices(store); !read) return tl::unexpected(read.error());
        volume::Volume volume;
        std::move(store).finish(volume);
        describe(volume);
        std::move(overlaps_).finish(volume);
        return volume;
    }

private:
    [[nodiscard]] std::size_t pixels_of_frame() const {
        return static_cast<std::size_t>(image_.rows) * static_cast<std::size_t>(image_.columns);
    }

    // The step between slices in mm: as the file states it, if the frames agree with it, or the least distance between
    // two frames.
    double step_mm(const std::vector<double>& places) {
        const DicomFrame& first = image_.frames.front();
        double least = 0.0;
        for (std::size_t n = 1; n < places.size(); ++n) {
            const double gap = places[n] - places[n - 1];
            if (gap > kOneSlice && (least == 0.0 || gap < least)) least = gap;
        }
        const double said = first.between_slices > 0.0 ? first.between_slices : first.thickness;
        if (!(said > 0.0 && std::isfinite(said))) {
            if (least == 0.0) notes_.emplace_back("all its frames lie in one slice: taken as 1 mm thick");
            return least > 0.0 ? least : 1.0;
        }
        const double steps = least / said;
        return std::abs(steps - std::round(steps)) <= kOffSlice && (least == 0.0 || steps > 0.5) ? said : least;
    }

    // The slice of each frame.
    Result<void> place_frames() {
        const DicomFrame& first = image_.frames.front();
        for (const DicomFrame& frame : image_.frames) {
            if (auto sound = check_frame(frame, image_.file.name); !sound) return sound;
            if (!lie_alike(frame, first))
                return fail("its frames are not parallel", image_.file.name, "export it as NIfTI");
        }
        const glm::dvec3 normal = frame_normal(first);
        std::vector<double> places;
        for (const DicomFrame& frame : image_.frames) places.push_back(glm::dot(*frame.position, normal));
        const std::vector<double> unsorted = places;
        std::ranges::sort(places);
        const double step = step_mm(places);
        const double last = std::round((places.back() - places.front()) / step);
        if (!(last < kMostSlices))
            return fail("its frames lie further apart than a patient is tall", image_.file.name, "export it again");
        slices_ = static_cast<int>(last) + 1;
        // A tilted gantry shifts slices in their plane.
        const auto lowest = static_cast<std::size_t>(std::ranges::min_element(unsorted) - unsorted.begin());
        const auto highest = static_cast<std::size_t>(std::ranges::max_element(unsorted) - unsorted.begin());
        const glm::dvec3 origin = *image_.frames[lowest].position;
        const glm::dvec3 between = slices_ > 1 ? (*image_.frames[highest].position - origin) / last : step * normal;
        for (std::size_t n = 0; n < image_.frames.size(); ++n) {
            const double at = std::round((unsorted[n] - places.front()) / step);
            if (glm::length(*image_.frames[n].position - origin - at * between) > kOffSlice * step)
                return fail("its frames do not lie one behind the other in even steps", image_.file.name,
                            "export it as NIfTI");
            order_.emplace_back(static_cast<int>(at), n);
        }
        std::ranges::sort(order_, {},
                          [&](const auto& each) { return std::pair(each.first, image_.frames[each.second].segment); });
        to_patient_ = frame_affine(image_.frames[lowest], between);
        return {};
    }

    Result<void> read_slices(volume::VoxelStore& store) {
        std::optional<std::string> decoded;
        if (image_.layout.encapsulated) {
            if (image_.bits_allocated == 1)
                return fail("its pixels are single bits, compressed", image_.file.name, "export it uncompressed");
            RAMUS_TRY(all, decode_pixels(image_));
            decoded = std::move(all);
        }
        auto next = order_.begin();
        for (int slice = 0; slice < slices_; ++slice) {
            if (job_.cancelled()) return fail("cancelled");
            std::ranges::fill(labels_, 0);
            for (; next != order_.end() && next->first == slice; ++next)
                if (auto put = put_frame(next->second, decoded ? &*decoded : nullptr); !put) return put;
            if (auto kept = store.append(labels_.data(), labels_.size(), {}); !kept) return kept;
            job_.report(static_cast<float>(slice + 1) / static_cast<float>(slices_));
        }
        return {};
    }

    [[nodiscard]] Result<void> put_label(std::size_t pixel, int label) {
        if (labels_[pixel] == 0) {
            labels_[pixel] = label;
            return {};
        }
        auto both = overlaps_.with(labels_[pixel], label);
        if (!both) return fail(both.error().what, image_.file.name, both.error().hint);
        labels_[pixel] = *both;
        return {};
    }

    Result<void> put_frame(std::size_t n, const std::string* decoded) {
        const int label = image_.frames[n].segment;
        if (label == 0 && image_.segments != SegmentKind::kLabels)
            return fail("one of its frames does not say to which segment it belongs", image_.file.name,
                        "export it again");
        if (image_.bits_allocated == 1) return put_bits(n, label);
        if (image_.bits_allocated != 8 && !(image_.segments == SegmentKind::kLabels && image_.bits_allocated == 16))
            return fail("its pixels have " + std::to_string(image_.bits_allocated) + " bits", image_.file.name,
                        "export it as NIfTI");
        RAMUS_TRY(pixels, frame_pixels(image_, n, decoded));
        const std::size_t width = static_cast<std::size_t>(image_.bits_allocated) / 8;
        const bool swapped = image_.layout.transfer_syntax == kDicomBigEndian;
        for (std::size_t pixel = 0; pixel < labels_.size(); ++pixel) {
            int value = static_cast<std::uint8_t>(pixels[pixel * width + (swapped ? width - 1 : 0)]);
            if (width == 2) value += 256 * static_cast<std::uint8_t>(pixels[pixel * 2 + (swapped ? 0 : 1)]);
            const bool labels = image_.segments == SegmentKind::kLabels;
            const int least = image_.segments == SegmentKind::kFractional ? image_.most_fraction : 1;
            if (labels ? value == 0 : 2 * value < least) continue;
            if (auto put = put_label(pixel, labels ? value : label); !put) return put;
        }
        return {};
    }

    // Frames follow each other without a gap, from the lowest bit of each byte on.
    Result<void> put_bits(std::size_t n, int label) {
        const std::uint64_t begin = n * labels_.size(), end = begin + labels_.size();
        RAMUS_TRY(bytes, read_pixel_bytes(image_, begin / 8, (end + 7) / 8 - begin / 8));
        for (std::size_t pixel = 0; pixel < labels_.size(); ++pixel) {
            const std::uint64_t bit = begin % 8 + pixel;
            if ((static_cast<std::uint8_t>(bytes[bit / 8]) >> (bit % 8) & 1) == 0) continue;
            if (auto put = put_label(pixel, label); !put) return put;
        }
        return {};
    }

    void describe(volume::Volume& volume) {
        volume.to_patient = to_patient_;
        volume.unit_mm = 1.0;
        const char* kind = image_.segments == SegmentKind::kFractional ? "fractions"
                           : image_.segments == SegmentKind::kLabels   ? "labels"
                                                                       : "bits";
        volume.type = std::string("DICOM SEG, ") + kind;
        volume.label_names = image_.segment_names;
        std::ranges::stable_sort(volume.label_names, {}, &volume::LabelName::label);
        volume.segmentation = true;
        if (image_.segments == SegmentKind::kFractional)
            notes_.emplace_back("its segments are fractions: those from one half on count");
        volume.notes = std::move(notes_);
    }

    const DicomImage& image_;
    volume::Keeping keeping_;
    const JobRange& job_;
    std::vector<std::pair<int, std::size_t>> order_; // slice, frame
    int slices_ = 0;
    glm::dmat4 to_patient_{1.0};
    volume::OverlapTable overlaps_;
    std::vector<std::int32_t> labels_; // of a slice
    std::vector<std::string> notes_;
};

} // namespace

Result<volume::Volume> read_segments(const DicomImage& image, const ReadVolumeOptions& options, const JobRange& job) {
    const volume::Keeping keeping = options.keeping();
    // One slice of labels is needed in addition to the volume.
    if (4.0 * image.rows * image.columns > keeping.memory_bytes)
        return fail("its slices are larger than the memory that is left", image.file.name, "allow more with --memory");
    return Segments(image, keeping, job).run();
}

} // namespace ramus::io
