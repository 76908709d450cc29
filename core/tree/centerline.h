// What runs between the points of a centerline, and how its radius does.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace ramus::tree {

// Smooth curves, or the straight lines of the paper with radii whose slope jumps at every point.
enum class Centerline : std::uint8_t { kSmooth, kLines };

// In the order of `Centerline`: what they are called in files, commands and on the command line.
inline constexpr std::array<std::string_view, 2> kCenterlines{"smooth", "lines"};

[[nodiscard]] constexpr std::string_view name_of(Centerline centerline) {
    return kCenterlines[static_cast<std::size_t>(centerline)];
}

} // namespace ramus::tree
