// What colours say, of a branch or of a place of the surface: one row for each possibility, those of quantities from
// their own table (app/session/quantity.h). Commands, the menu and sessions read it. Arrays of the tree's file
// (core/tree/data_array.h) are further possibilities, by their names; how colours follow a quantity is a ColourLook.
#pragma once

#include "app/session/quantity.h"
#include "core/base/error.h"

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace ramus::app {

struct ColourBy {
    enum class Kind : std::uint8_t {
        kNothing,
        kState,
        kQuantity,
        kLesion,
        kLabel,
        kBranch,
        kSystem,
        kDeviation,
        kData
    };
    using enum Kind;
    Kind kind = kNothing;
    Quantity quantity{}; // of kQuantity
    std::string data;    // of kData: the name of the array
    ColourBy() = default;
    ColourBy(Kind what) : kind(what) {}
    ColourBy(Quantity what) : kind(kQuantity), quantity(what) {}
    [[nodiscard]] static ColourBy array(std::string name) {
        ColourBy by(kData);
        by.data = std::move(name);
        return by;
    }
    bool operator==(const ColourBy&) const = default;
};

struct ColouringRow {
    ColourBy by;
    std::string_view key;   // what colour-by takes, and sessions say
    std::string_view label; // in the menu
    std::string_view help;
};

[[nodiscard]] const std::vector<ColouringRow>& colourings(); // in the order of the menu
[[nodiscard]] std::string name_of(const ColourBy& by);       // its key; of an array of the file "file:NAME"
// A key of the table, or "file:" with any name behind it.
[[nodiscard]] std::optional<ColourBy> colouring_named(std::string_view key);
// The same, and the bare names of a tree's arrays: what is in the table comes first. Fails with all that there is.
[[nodiscard]] Result<ColourBy> colouring_of_tree(std::string_view key, const tree::VesselTree& tree);

// Colour maps for quantities: even steps look even, in grey and to colour-blind eyes as well. viridis, magma and plasma
// by S. van der Walt and N. Smith (2015), cividis by J. Nunez, C. Anderton and R. Renslow (2018), all in the public
// domain (CC0); coolwarm, for values on both sides of a middle, by K. Moreland (2009). Here as nine stations each;
// their sRGB values are mixed, as the tables are meant.
enum class ColourMap : std::uint8_t { kViridis, kCividis, kMagma, kPlasma, kCoolwarm, kGrey };
inline constexpr std::array kColourMaps{ColourMap::kViridis, ColourMap::kCividis,  ColourMap::kMagma,
                                        ColourMap::kPlasma,  ColourMap::kCoolwarm, ColourMap::kGrey};
[[nodiscard]] std::string_view name_of(ColourMap map); // "viridis", ...
[[nodiscard]] std::optional<ColourMap> colour_map_named(std::string_view name);

// sRGB at t from 0 to 1. The darkest end is left out: it would sink into the dark background.
[[nodiscard]] glm::vec3 colour_at(ColourMap map, double t);
// The whole map in `steps` even steps, both ends included.
[[nodiscard]] std::vector<glm::vec3> ramp_of(ColourMap map, std::size_t steps = 64);

// How the colours of a quantity follow its values.
struct ColourLook {
    std::optional<std::array<double, 2>> range{}; // of the colour map, ascending; none: the least and largest value
    std::optional<bool> logarithmic{};            // none: as is usual for the quantity
    bool legend = true;
    bool operator==(const ColourLook&) const = default;
};
// "12,80"; none: it is no two numbers that ascend, of 1e14 at most.
[[nodiscard]] std::optional<std::array<double, 2>> colour_range_in(std::string_view text);
// Fails where both cannot be: a logarithmic scale from 0 or below.
[[nodiscard]] Result<void> check(const ColourLook& look);

// Of what nothing is known, sRGB: no colour of any map but grey, and darker than its middle.
inline constexpr glm::vec3 kUnknownColour{0.47F, 0.50F, 0.54F};

// Colours as people write them: #RRGGBB, in sRGB. The sign may be left out: in commands files it begins a comment.
[[nodiscard]] std::string colour_text(const std::array<std::uint8_t, 3>& colour); // "#c98268"
[[nodiscard]] std::optional<std::array<std::uint8_t, 3>> colour_in(std::string_view text);

} // namespace ramus::app
