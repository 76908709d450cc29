// Centerline: how positions and radii are interpolated between the points of a centerline.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace ramus::tree {

// kSmooth: smooth curves (core/tree/curves.h). kLines: the straight segments with linear radii of the paper.
enum class Centerline : std::uint8_t { kSmooth, kLines };

// The names in files, commands and on the command line, in the order of `Centerline`.
inline constexpr std::array<std::string_view, 2> kCenterlines{"smooth", "lines"};

[[nodiscard]] constexpr std::string_view name_of(Centerline centerline) {
    return kCenterlines[static_cast<std::size_t>(centerline)];
}

} // namespace ramus::tree
