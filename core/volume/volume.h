// Volume: a voxel image, usually a segmentation mask, with its position in the patient. A plain value; large volumes
// are shared as shared_ptr<const Volume>. Values are stored as runs of equal values if that takes less memory, as for
// masks, else in the smallest type that holds all of them, independent of the type in the file.
#pragma once

#include "core/base/mapped_pages.h"
#include "core/volume/voxel_runs.h"

#include <array>
#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace ramus::volume {

// Whole numbers are exact; fractions are in single precision.
using Voxels = std::variant<SparseArray<std::uint8_t>, SparseArray<std::uint16_t>, SparseArray<std::int16_t>,
                            SparseArray<std::int32_t>, SparseArray<float>, VoxelRuns, FractionRuns>;

// The name and colour of a label: 3, "portal vein".
struct LabelName {
    std::int32_t label = 0;
    std::string name;
    std::optional<std::array<std::uint8_t, 3>> colour = std::nullopt; // sRGB
    bool operator==(const LabelName&) const = default;
};

// A value that stands for several labels: its voxels have all of them (core/volume/overlap_table.h).
struct Overlap {
    std::int32_t value = 0;
    std::vector<std::int32_t> labels; // two or more, ascending
    bool operator==(const Overlap&) const = default;
};

// The values that a viewer should show first: `width` values around `centre`, in the unit of the values.
struct DisplayWindow {
    double centre = 0.0, width = 1.0; // width > 0
    bool operator==(const DisplayWindow&) const = default;
};

// The beginning of the note of a volume whose file does not state the patient's sides.
inline constexpr std::string_view kLeavesSidesOpen = "the file does not say how the patient lies";

struct Volume {
    glm::ivec3 size{0};
    // Voxel indices, with whole numbers at voxel centres, to mm, RAS. Invertible and finite; may mirror and shear.
    glm::dmat4 to_patient{1.0};
    Voxels voxels;                       // voxel (i, j, k) at index i + size.x * (j + size.y * k)
    double minimum = 0.0, maximum = 0.0; // of the values, without those that stand for several labels
    std::optional<double> threshold;     // values are 1 where the file has at least this one, else 0; none: as the file
    std::string type;                    // of the file: "NIfTI-1, int16"
    std::optional<double> unit_mm;       // unit that the file states, included in to_patient; none: not stated
    std::vector<std::string> notes;      // assumptions where the file states nothing; one sentence each
    std::vector<std::string> suspicions; // assumptions or statements that are likely wrong; one sentence each
    std::vector<LabelName> label_names;  // ascending; empty: the file has no names
    std::vector<Overlap> overlaps;       // ascending by value; empty: no voxel has two labels
    bool segmentation = false;           // label_names lists all segments, also those without voxels
    std::string value_unit;              // that the file states: "HU"; empty: not stated
    std::string modality;                // of DICOM: "CT", "MR"; empty: not stated
    std::optional<DisplayWindow> window; // that the file proposes; none: not stated
};

// Whether the file states the patient's sides. If not, the axes are a guess, and a note says so.
[[nodiscard]] bool says_sides(const Volume& volume);
[[nodiscard]] std::size_t voxel_count(const glm::ivec3& size);
[[nodiscard]] bool holds_whole_numbers(const Volume& volume);
// The value of a voxel within `size`. Where labels overlap, the greatest of them.
[[nodiscard]] double value_at(const Volume& volume, const glm::ivec3& voxel);
// The name of a label. Null: the file has none.
[[nodiscard]] const LabelName* name_of_label(const Volume& volume, std::int32_t label);

// Whether the volume is most likely a mask: a segmentation, whole numbers from 0 to 255, or fractions from 0 to 1.
[[nodiscard]] bool looks_like_a_mask(const Volume& volume);

[[nodiscard]] glm::dvec3 spacing_mm(const glm::dmat4& to_patient); // distance of voxels along each axis of the volume
[[nodiscard]] double voxel_volume_mm3(const glm::dmat4& to_patient);
[[nodiscard]] bool mirrors(const glm::dmat4& to_patient); // whether the determinant is negative

// The side of the patient that each axis leads to, for oblique axes the nearest: "RAS" is right, anterior, superior.
[[nodiscard]] std::string orientation(const glm::dmat4& to_patient);

} // namespace ramus::volume
