// What the surface is held against when colours say how far it lies from another one, and the scale of these colours.
// A plain value, part of what undo covers. The isosurface is that of the mask of the comparison (comparison.h).
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace ramus::app {

struct Comparison;

struct DeviationChoice {
    enum class From : std::uint8_t { kCones, kIsosurface, kFile };
    enum class Unit : std::uint8_t { kMm, kVoxels }; // of the scale: voxels are diagonals of the mask's
    From from = From::kCones;
    std::string file;      // of kFile: a mesh, absolute
    Unit unit = Unit::kMm; // kVoxels of isosurfaces alone
    double most = 0.0;     // where the scale ends, in its unit; 0: where nearly all distances lie below
    std::string axes{};    // of a mesh that does not state them: "LPS"; empty: nobody has said
    bool operator==(const DeviationChoice&) const = default;
};
inline constexpr std::array kDeviationUnits{DeviationChoice::Unit::kMm, DeviationChoice::Unit::kVoxels};
inline constexpr double kLeastDeviation = 1e-6, kMostDeviation = 1e6; // ends of scales

[[nodiscard]] std::string_view name_of(DeviationChoice::Unit unit); // "mm", "voxels"
[[nodiscard]] std::optional<DeviationChoice::Unit> deviation_unit_named(std::string_view name);
[[nodiscard]] constexpr bool may_count_voxels(DeviationChoice::From from) {
    return from == DeviationChoice::From::kIsosurface;
}

// "truncated cones", "isosurface of liver.nii.gz", "liver.ply".
[[nodiscard]] std::string noun_of(const DeviationChoice& choice, const Comparison& comparison);

} // namespace ramus::app
