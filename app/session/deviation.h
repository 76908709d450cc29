// DeviationChoice: the reference surface and the scale for colouring a surface by its distance from another one. A
// plain value, covered by undo. The reference isosurface uses the mask of the comparison (comparison.h).
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
    enum class Unit : std::uint8_t { kMm, kVoxels }; // of the scale; kVoxels: diagonals of the mask's voxels
    From from = From::kCones;
    std::string file;      // for kFile: absolute path of a mesh
    Unit unit = Unit::kMm; // kVoxels only for isosurfaces
    double most = 0.0;     // end of the scale, in its unit; 0: chosen so that nearly all distances lie below
    std::string axes{};    // of a mesh that does not state them: "LPS"; empty: not specified
    bool operator==(const DeviationChoice&) const = default;
};
inline constexpr std::array kDeviationUnits{DeviationChoice::Unit::kMm, DeviationChoice::Unit::kVoxels};
inline constexpr double kLeastDeviation = 1e-6, kMostDeviation = 1e6; // bounds of `most`

[[nodiscard]] std::string_view name_of(DeviationChoice::Unit unit); // "mm", "voxels"
[[nodiscard]] std::optional<DeviationChoice::Unit> deviation_unit_named(std::string_view name);
[[nodiscard]] constexpr bool may_count_voxels(DeviationChoice::From from) {
    return from == DeviationChoice::From::kIsosurface;
}

// "truncated cones", "isosurface of liver.nii.gz", "liver.ply".
[[nodiscard]] std::string noun_of(const DeviationChoice& choice, const Comparison& comparison);

} // namespace ramus::app
