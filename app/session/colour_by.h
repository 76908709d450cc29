// The table of colourings: what colours can show of a branch or a surface point. Rows for quantities come from
// app/session/quantity.h. Commands, the menu and sessions read this table. Arrays of the tree's file
// (core/tree/data_array.h) are further colourings, identified by name. ColourLook says how colours follow a quantity.
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
    Quantity quantity{}; // for kQuantity
    std::string data;    // for kData: the name of the array
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
    std::string_view key;   // in sessions and for the command colour-by
    std::string_view label; // in the menu
    std::string_view help;
};

[[nodiscard]] const std::vector<ColouringRow>& colourings(); // in the order of the menu
[[nodiscard]] std::string name_of(const ColourBy& by);       // the key; "file:NAME" for an array of the file
// Accepts a key of the table, or "file:" followed by any name.
[[nodiscard]] std::optional<ColourBy> colouring_named(std::string_view key);
// Also accepts the plain names of the tree's arrays, after the keys of the table. Errors list all colourings.
[[nodiscard]] Result<ColourBy> colouring_of_tree(std::string_view key, const tree::VesselTree& tree);

// Perceptually uniform colour maps, also in grey and for colour-blind people. viridis, magma and plasma by S. van der
// Walt and N. Smith (2015), cividis by J. Nunez, C. Anderton and R. Renslow (2018), all in the public domain (CC0);
// coolwarm, which diverges from its middle, by K. Moreland (2009). Stored as nine sRGB values each, interpolated in
// sRGB.
enum class ColourMap : std::uint8_t { kViridis, kCividis, kMagma, kPlasma, kCoolwarm, kGrey };
inline constexpr std::array kColourMaps{ColourMap::kViridis, ColourMap::kCividis,  ColourMap::kMagma,
                                        ColourMap::kPlasma,  ColourMap::kCoolwarm, ColourMap::kGrey};
[[nodiscard]] std::string_view name_of(ColourMap map); // "viridis", ...
[[nodiscard]] std::optional<ColourMap> colour_map_named(std::string_view name);

// sRGB at t from 0 to 1. Omits the darkest end, which would be invisible on the dark background.
[[nodiscard]] glm::vec3 colour_at(ColourMap map, double t);
// Samples the whole map in `steps` even steps, both ends included.
[[nodiscard]] std::vector<glm::vec3> ramp_of(ColourMap map, std::size_t steps = 64);

// Maps the values of a quantity to colours.
struct ColourLook {
    std::optional<std::array<double, 2>> range{}; // values at the ends of the colour map, ascending; none: of the data
    std::optional<bool> logarithmic{};            // none: the quantity's default
    bool legend = true;
    bool operator==(const ColourLook&) const = default;
};
// Parses "12,80": two ascending numbers of at most 1e14; none if invalid.
[[nodiscard]] std::optional<std::array<double, 2>> colour_range_in(std::string_view text);
// Fails if a logarithmic scale starts at or below 0.
[[nodiscard]] Result<void> check(const ColourLook& look);

// The colour of unknown values, sRGB: a grey that occurs in no other map, darker than the middle of the grey map.
inline constexpr glm::vec3 kUnknownColour{0.47F, 0.50F, 0.54F};

[[nodiscard]] std::array<std::uint8_t, 3> bytes_of(const glm::vec3& colour); // of channels from 0 to 1

// Colours as text: #RRGGBB, sRGB. The # is optional, because it starts a comment in command files.
[[nodiscard]] std::string colour_text(const std::array<std::uint8_t, 3>& colour); // "#c98268"
[[nodiscard]] std::optional<std::array<std::uint8_t, 3>> colour_in(std::string_view text);

} // namespace ramus::app
