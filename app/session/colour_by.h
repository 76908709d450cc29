// What colours say, of a branch or of a place of the surface: one row for each possibility, those of quantities from
// their own table (app/session/quantity.h). Commands, the menu and sessions read it.
#pragma once

#include "app/session/quantity.h"

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ramus::app {

struct ColourBy {
    enum class Kind : std::uint8_t { kNothing, kState, kQuantity, kLesion, kLabel, kBranch, kSystem, kDeviation };
    using enum Kind;
    Kind kind = kNothing;
    Quantity quantity{}; // of kQuantity
    ColourBy() = default;
    ColourBy(Kind what) : kind(what) {}
    ColourBy(Quantity what) : kind(kQuantity), quantity(what) {}
    bool operator==(const ColourBy&) const = default;
};

struct ColouringRow {
    ColourBy by;
    std::string_view key;   // what colour-by takes, and sessions say
    std::string_view label; // in the menu
    std::string_view help;
};

[[nodiscard]] const std::vector<ColouringRow>& colourings(); // in the order of the menu
[[nodiscard]] std::string_view name_of(ColourBy by);         // its key
[[nodiscard]] std::optional<ColourBy> colouring_named(std::string_view key);

// Colour maps for quantities: even steps look even, in grey and to colour-blind eyes as well. viridis and magma by
// S. van der Walt and N. Smith (2015), cividis by J. Nunez, C. Anderton and R. Renslow (2018), all in the public domain
// (CC0); here as nine stations each.
enum class ColourMap : std::uint8_t { kViridis, kCividis, kMagma };
inline constexpr std::array kColourMaps{ColourMap::kViridis, ColourMap::kCividis, ColourMap::kMagma};
[[nodiscard]] std::string_view name_of(ColourMap map); // "viridis", ...
[[nodiscard]] std::optional<ColourMap> colour_map_named(std::string_view name);

// sRGB at t from 0 to 1. The darkest end is left out: it would sink into the dark background.
[[nodiscard]] glm::vec3 colour_at(ColourMap map, double t);
// The whole map in `steps` even steps, both ends included.
[[nodiscard]] std::vector<glm::vec3> ramp_of(ColourMap map, std::size_t steps = 64);

// Colours as people write them: #RRGGBB, in sRGB. The sign may be left out: in commands files it begins a comment.
[[nodiscard]] std::string colour_text(const std::array<std::uint8_t, 3>& colour); // "#c98268"
[[nodiscard]] std::optional<std::array<std::uint8_t, 3>> colour_in(std::string_view text);

} // namespace ramus::app
