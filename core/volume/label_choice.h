// LabelChoice: a label of a mask that a person chooses by number or by name (3, "portal vein"). label_numbers() looks
// the names up in the mask.
#pragma once

#include "core/base/error.h"

#include <compare>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace ramus::volume {

struct Volume;

struct LabelChoice {
    std::int32_t number = 0; // 0: the label is chosen by its name
    std::string name;

    LabelChoice() = default;
    LabelChoice(std::int32_t chosen) : number(chosen) {} // NOLINT(google-explicit-constructor): numbers are choices
    explicit LabelChoice(std::string chosen) : name(std::move(chosen)) {}
    [[nodiscard]] bool none() const { return number == 0 && name.empty(); }
    auto operator<=>(const LabelChoice&) const = default; // NOLINT(modernize-use-nullptr): the rule mistakes it
};

// The number of each choice, in the order of the choices. A name matches `volume.label_names` exactly, or else the only
// one that is equal except for capitals, blanks and underscores. Fails on a name that no label or several labels have;
// the error lists the names. Does not check whether a voxel has the number.
[[nodiscard]] Result<std::vector<std::int32_t>> label_numbers(const Volume& volume,
                                                              const std::vector<LabelChoice>& choices);

// The choice as text: 3, portal vein. A name that could be read as a number or as several labels is in double quotes.
[[nodiscard]] std::string spelled(const LabelChoice& choice);

} // namespace ramus::volume
