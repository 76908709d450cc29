// Comparison: which surfaces of one tree are looked at together, and how. Plain values, part of what undo covers.
#pragma once

#include "core/mesh/method.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ramus::app {

struct Comparison {
    enum class Mode : std::uint8_t {
        kOff,
        kSideBySide,   // each in a viewport of its own, seen by one camera
        kBlend,        // the first two, one fading into the other
        kSuperimposed, // the first shaded, the second as a wireframe over it
    };
    Mode mode = Mode::kOff;
    // Two or three, none twice.
    std::vector<mesh::Method> surfaces{mesh::Method::kConvolutionSurface, mesh::Method::kTruncatedCones};
    std::string mask;                 // of the isosurface: a file, absolute; empty: the tree's own voxels
    std::string mask_units;           // of its lengths, "cm"; empty: as its file says
    std::vector<std::int32_t> labels; // in the mask, ascending; empty: whatever is inside
    double blend = 0.5;               // 0: the first surface alone; 1: the second
    bool operator==(const Comparison&) const = default;
};
inline constexpr std::array kComparisonModes{Comparison::Mode::kOff, Comparison::Mode::kSideBySide,
                                             Comparison::Mode::kBlend, Comparison::Mode::kSuperimposed};
[[nodiscard]] std::string_view name_of(Comparison::Mode mode); // "off", "side-by-side", "blend", "superimposed"
[[nodiscard]] std::optional<Comparison::Mode> comparison_mode_named(std::string_view name);

// The surfaces that are in the picture, in their order; none when nothing is compared.
[[nodiscard]] std::vector<mesh::Method> compared_surfaces(const Comparison& comparison);

// "Convolution surface", "Truncated cones", "Isosurface of liver.nii.gz".
[[nodiscard]] std::string title_of(mesh::Method method, const Comparison& comparison);

// "cs,iso": two or three, none twice.
[[nodiscard]] std::optional<std::vector<mesh::Method>> surface_list(std::string_view text);
// "1,2": whole numbers other than 0, made ascending, without repeats.
[[nodiscard]] std::optional<std::vector<std::int32_t>> label_list(std::string_view text);
// "1+3,2": the labels of each of several groups, as label_list() has them.
[[nodiscard]] std::optional<std::vector<std::vector<std::int32_t>>> label_groups(std::string_view text);

} // namespace ramus::app
