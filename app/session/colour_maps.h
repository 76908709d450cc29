// Colour maps for quantities: even steps look even, in grey and to colour-blind eyes as well. viridis and magma by
// S. van der Walt and N. Smith (2015), cividis by J. Nunez, C. Anderton and R. Renslow (2018), all in the public domain
// (CC0); here as nine stations each.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <string_view>
#include <vector>

namespace ramus::app {

enum class ColourMap : std::uint8_t { kViridis, kCividis, kMagma };
inline constexpr std::array kColourMaps{ColourMap::kViridis, ColourMap::kCividis, ColourMap::kMagma};
[[nodiscard]] std::string_view name_of(ColourMap map); // "viridis", ...

// sRGB at t from 0 to 1. The darkest end is left out: it would sink into the dark background.
[[nodiscard]] glm::vec3 colour_at(ColourMap map, double t);
// The whole map in `steps` even steps, both ends included.
[[nodiscard]] std::vector<glm::vec3> ramp_of(ColourMap map, std::size_t steps = 64);

} // namespace ramus::app
