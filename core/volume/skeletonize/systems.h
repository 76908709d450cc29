// Which labels of a mask become which systems of a tree.
#pragma once

#include "core/base/error.h"
#include "core/volume/label_choice.h"
#include "core/volume/volume.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace ramus::volume {

// One system of a tree: the part of a mask that it is made of, and how it is called.
struct SystemMask {
    std::vector<LabelChoice> labels;                     // empty: everything that is inside
    std::string name = {};                               // empty where it is the only one and the file does not name it
    std::optional<double> isovalue{};                    // of a scan: what is at least that is inside
    std::optional<std::array<std::uint8_t, 3>> colour{}; // sRGB, as the file has it
};

// Labels of each system; without any, each label is a system of its own. None: all labels are one system.
using LabelGroups = std::optional<std::vector<std::vector<LabelChoice>>>;

// A volume of fractions has but one system. Systems may overlap where labels do. Fails on a label that is not there, on
// one that is in two groups, and when the volume looks like a scan.
[[nodiscard]] Result<std::vector<SystemMask>> systems_of(const Volume& volume, const LabelGroups& groups);

} // namespace ramus::volume
