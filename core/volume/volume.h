// Volume: a voxel image, a segmentation mask as a rule, and where it lies in the patient. A plain value; large ones are
// shared as shared_ptr<const Volume>. Values are kept as runs of equal ones where that takes less, as it does of masks,
// else in the smallest type that holds them all, whatever type the file has.
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

// Whole numbers exactly; others in single precision.
using Voxels = std::variant<SparseArray<std::uint8_t>, SparseArray<std::uint16_t>, SparseArray<std::int16_t>,
                            SparseArray<std::int32_t>, SparseArray<float>, VoxelRuns, FractionRuns>;

// What a label of a mask stands for: 3, "portal vein".
struct LabelName {
    std::int32_t label = 0;
    std::string name;
    std::optional<std::array<std::uint8_t, 3>> colour = std::nullopt; // sRGB
    bool operator==(const LabelName&) const = default;
};

// A value that stands for several labels at once: its voxels belong to all of them (core/volume/overlap_table.h).
struct Overlap {
    std::int32_t value = 0;
    std::vector<std::int32_t> labels; // two or more, ascending
    bool operator==(const Overlap&) const = default;
};

// How the note of a volume begins whose file leaves the patient's sides open.
inline constexpr std::string_view kLeavesSidesOpen = "the file does not say how the patient lies";

struct Volume {
    glm::ivec3 size{0};
    // Of voxel indices, whole numbers at the centres, to mm, RAS. Invertible and finite; may mirror and shear.
    glm::dmat4 to_patient{1.0};
    Voxels voxels;                       // of (i, j, k) at i + size.x * (j + size.y * k)
    double minimum = 0.0, maximum = 0.0; // of labels that overlap, without the values that stand for several
    std::string type;                    // as it was kept: "NIfTI-1, int16"
    std::optional<double> unit_mm;       // that the file states and to_patient counts with; none: it states none
    std::vector<std::string> notes;      // what was assumed where the file does not say; one sentence each
    std::vector<std::string> suspicions; // what is likely another than it was taken for; one sentence each
    std::vector<LabelName> label_names;  // ascending; empty: the file names none
    std::vector<Overlap> overlaps;       // by value; empty: no voxel belongs to two labels
    bool segmentation = false;           // label_names are the list of all its segments, also of those without voxels
};

// Whether the file says how the patient lies: else the axes are a guess, and a note says so.
[[nodiscard]] bool says_sides(const Volume& volume);
[[nodiscard]] std::size_t voxel_count(const Volume& volume);
[[nodiscard]] bool holds_whole_numbers(const Volume& volume);
// Of a voxel within `size`. Where labels overlap, the greatest of them.
[[nodiscard]] double value_at(const Volume& volume, const glm::ivec3& voxel);
// What a label is called; null: the file does not name it.
[[nodiscard]] const LabelName* name_of_label(const Volume& volume, std::int32_t label);

// What may be taken for a mask without a word: a segmentation, whole numbers from 0 to 255, or fractions from 0 to 1.
[[nodiscard]] bool looks_like_a_mask(const Volume& volume);

[[nodiscard]] glm::dvec3 spacing_mm(const glm::dmat4& to_patient); // from voxel to voxel along each axis of the volume
[[nodiscard]] double voxel_volume_mm3(const glm::dmat4& to_patient);
[[nodiscard]] bool mirrors(const glm::dmat4& to_patient); // turns right hands into left ones

// Where each axis of the volume leads, for oblique ones nearly: "RAS" is right, anterior, superior; also L, P, I.
[[nodiscard]] std::string orientation(const glm::dmat4& to_patient);

} // namespace ramus::volume
