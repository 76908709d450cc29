// LabelChoice: a label of a mask as a person chooses it, by its number or by its name: 3, "portal vein". Which number a
// name stands for only the mask can say.
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

// The number of each choice, in the order of the choices. A name is one of `volume.label_names`: exactly, or else the
// only one that differs in capitals, blanks and underscores alone. Fails on a name that no label or several labels
// have; the error lists the names there are. Whether a voxel has a number is not checked.
[[nodiscard]] Result<std::vector<std::int32_t>> label_numbers(const Volume& volume,
                                                              const std::vector<LabelChoice>& choices);

// "3", "portal vein"; a name that could be mistaken, for a number or for several labels, in double quotes.
[[nodiscard]] std::string spelled(const LabelChoice& choice);

} // namespace ramus::volume
