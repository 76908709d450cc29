// What the colour of a branch says: one row for each possibility, those of quantities from their own table
// (app/session/quantity.h). Commands, the menu and sessions read it.
#pragma once

#include "app/session/quantity.h"

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace ramus::app {

struct ColourBy {
    enum class Kind : std::uint8_t { kNothing, kState, kQuantity, kLesion, kLabel, kBranch };
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

} // namespace ramus::app
