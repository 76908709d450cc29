#include "core/io/volumes/dicom/dicom_image.h"

#include "core/io/volumes/dicom/dicom_elements.h"
#include "core/io/volumes/dicom/dicom_lab.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>

namespace ramus::io {

namespace {

constexpr std::string_view kSegmentation = "1.2.840.10008.5.1.4.1.1.66.4", kLabelMap = "1.2.840.10008.5.1.4.1.1.66.7";

std::optional<glm::dvec3> vector_of(const std::vector<double>& numbers, std::size_t from) {
    if (numbers.size() < from + 3) return std::nullopt;
    return glm::dvec3(numbers[from], numbers[from + 1], numbers[from + 2]);
}

// Overrides the known properties of a frame by those in a set of elements: the data set of a file with one image, or an
// item of a functional group.
void take_position(const DicomSet& set, DicomFrame& frame) {
    if (const auto position = vector_of(set.decimals(0x00200032), 0)) frame.position = position;
}
void take_orientation(const DicomSet& set, DicomFrame& frame) {
    const auto numbers = set.decimals(0x00200037);
    if (numbers.size() == 6) frame.direction = {*vector_of(numbers, 0), *vector_of(numbers, 3)};
}
void take_measures(const DicomSet& set, DicomFrame& frame) {
    // The first number is from row to row.
    const auto spacing = set.decimals(0x00280030);
    if (spacing.size() == 2) frame.spacing = glm::dvec2(spacing[1], spacing[0]);
    if (const auto between = set.decimals(0x00180088); between.size() == 1) frame.between_slices = between[0];
    if (const auto thickness = set.decimals(0x00180050); thickness.size() == 1) frame.thickness = thickness[0];
}
void take_scaling(const DicomSet& set, DicomFrame& frame) {
    const auto slope = set.decimals(0x00281053);
    const auto intercept = set.decimals(0x00281052);
    frame.scaled = frame.scaled || !slope.empty() || !intercept.empty();
    if (const std::string type = set.text(0x00281054); !type.empty()) frame.value_type = type;
    if (slope.size() == 1 && slope[0] != 0.0 && std::isfinite(slope[0])) frame.scaling.slope = slope[0];
    if (intercept.size() == 1 && std::isfinite(intercept[0])) frame.scaling.intercept = intercept[0];
}
// The first of several windows.
void take_window(const DicomSet& set, DicomFrame& frame) {
    const auto centre = set.decimals(0x00281050);
    const auto width = set.decimals(0x00281051);
    if (centre.empty() || width.empty() || !std::isfinite(centre[0])) return;
    if (width[0] > 0.0 && std::isfinite(width[0])) frame.window = {centre[0], width[0]};
}
void take_segment(const DicomSet& set, DicomFrame& frame) {
    if (const auto segment = set.number(0x0062000b)) frame.segment = *segment;
}

void take_groups(const DicomSet& groups, DicomFrame& frame) {
    using Take = void (*)(const DicomSet&, DicomFrame&);
    constexpr std::pair<std::uint32_t, Take> kGroups[] = {{0x00209113, take_position}, {0x00209116, take_orientation},
                                                          {0x00289110, take_measures}, {0x00289132, take_window},
                                                          {0x00289145, take_scaling},  {0x0062000a, take_segment}};
    for (const auto& [tag, take] : kGroups)
        if (const auto& items = groups.items(tag); !items.empty()) take(items[0], frame);
}

Result<void> take_frames(const DicomSet& set, DicomImage& image) {
    DicomFrame frame;
    take_position(set, frame);
    take_orientation(set, frame);
    take_measures(set, frame);
    take_scaling(set, frame);
    take_window(set, frame);
    const auto claimed = set.decimals(0x00280008);
    const double count = claimed.size() == 1 ? claimed[0] : 1.0;
    const auto& shared = set.items(0x52009229);
    const auto& each = set.items(0x52009230);
    if (!shared.empty()) take_groups(shared[0], frame);
    if (each.empty()) {
        if (count != 1.0)
            return fail("its frames do not say where they lie", image.file.name, "export it as single images");
        image.frames = {frame};
        return {};
    }
    if (count != static_cast<double>(each.size()))
        return fail("it claims other frames than it describes", image.file.name, "export it again");
    image.frames.reserve(each.size());
    for (std::size_t n = 0; n < each.size(); ++n) {
        image.frames.push_back(frame);
        take_groups(each[n], image.frames.back());
    }
    return {};
}

// Recommended Display CIELab Value.
std::optional<std::array<std::uint8_t, 3>> colour_of(const DicomSet& segment) {
    constexpr std::uint32_t kLab = 0x0062000d;
    const auto lightness = segment.number(kLab, 0), a = segment.number(kLab, 1), b = segment.number(kLab, 2);
    if (!lightness || !a || !b) return std::nullopt;
    return srgb_of_dicom_lab({*lightness, *a, *b});
}

Result<void> take_segments(const DicomSet& set, DicomImage& image) {
    if (image.sop_class != kSegmentation && image.sop_class != kLabelMap) return {};
    const std::string kind = set.text(0x00620001);
    image.segments = kind == "BINARY"       ? SegmentKind::kBinary
                     : kind == "FRACTIONAL" ? SegmentKind::kFractional
                     : kind == "LABELMAP"   ? SegmentKind::kLabels
                                            : SegmentKind::kNone;
    if (image.segments == SegmentKind::kNone)
        return fail("its segmentation is of an unknown kind: " + kind, image.file.name, "export it as NIfTI");
    image.most_fraction = set.number(0x0062000e).value_or(255);
    const auto& segments = set.items(0x00620002);
    for (const DicomSet& segment : segments)
        if (const auto label = segment.number(0x00620004); label && *label != 0)
            image.segment_names.push_back(
                {.label = *label, .name = segment.text(0x00620005), .colour = colour_of(segment)});
    return {};
}

void take_identity(const DicomSet& set, DicomImage& image) {
    image.sop_class = set.text(0x00080016);
    image.series_uid = set.text(0x0020000e);
    image.series_number = set.text(0x00200011);
    image.description = set.text(0x0008103e);
    image.modality = set.text(0x00080060);
    const std::string type = set.text(0x00080008);
    image.localizer = type.find("LOCALIZER") != std::string::npos;
    // PS3.3, C.8.2.1: the output of the scaling is HU in original images that are neither localizers nor multi-energy.
    image.implies_hounsfield =
        image.modality == "CT" && type.starts_with("ORIGINAL\\") && !image.localizer && set.text(0x00189361) != "YES";
}

Result<void> take_pixel_format(const DicomSet& set, DicomImage& image) {
    const auto number = [&](std::uint32_t tag, int otherwise) { return set.number(tag).value_or(otherwise); };
    image.rows = number(0x00280010, 0);
    image.columns = number(0x00280011, 0);
    image.samples = number(0x00280002, 1);
    image.bits_allocated = number(0x00280100, 0);
    image.bits_stored = number(0x00280101, image.bits_allocated);
    image.high_bit = number(0x00280102, image.bits_stored - 1);
    image.is_signed = number(0x00280103, 0) == 1;
    image.photometric = set.text(0x00280004);
    if (image.rows == 0 || image.columns == 0)
        return fail("its images have no rows or columns", image.file.name, "export it again");
    if (image.samples != 1 || image.photometric == "PALETTE COLOR")
        return fail("its pixels are colours", image.file.name, "name a series of grey values");
    const int bits = image.bits_allocated;
    if ((bits != 1 && bits != 8 && bits != 16 && bits != 32) || image.bits_stored < 1 || image.bits_stored > bits ||
        image.high_bit < image.bits_stored - 1 || image.high_bit >= bits)
        return fail("its pixels have " + std::to_string(image.bits_stored) + " of " + std::to_string(bits) +
                        " bits, up to number " + std::to_string(image.high_bit),
                    image.file.name, "export it with 8 or 16 bits for each pixel");
    return {};
}

} // namespace

std::string series_name(const DicomImage& image) {
    std::string name = image.series_number.empty() ? "without a number" : "number " + image.series_number;
    if (!image.description.empty()) name += ", \"" + image.description + '"';
    return image.modality.empty() ? name : name + ", " + image.modality;
}

std::string value_unit(const DicomImage& image, const DicomFrame& frame) {
    // PS3.3, C.11.1.1.2: US means unspecified.
    if (!frame.value_type.empty()) return frame.value_type == "US" ? "" : frame.value_type;
    return frame.scaled && image.implies_hounsfield ? "HU" : "";
}

Result<std::optional<DicomImage>> read_dicom_image(const StoredBytes& file) {
    RAMUS_TRY(layout, dicom_layout(file));
    if (!layout.has_pixels) return std::nullopt;
    const DicomSet set = std::exchange(layout.elements, DicomSet());
    DicomImage image;
    image.file = file;
    image.layout = std::move(layout);
    take_identity(set, image);
    if (auto taken = take_pixel_format(set, image); !taken) return tl::unexpected(taken.error());
    if (auto taken = take_segments(set, image); !taken) return tl::unexpected(taken.error());
    if (auto taken = take_frames(set, image); !taken) return tl::unexpected(taken.error());
    return image;
}

} // namespace ramus::io
