// Assigns the labels of a mask to the systems of a tree.
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

// One system of a tree: the labels or the isovalue that select its part of the mask, and its name and colour.
struct SystemMask {
    std::vector<LabelChoice> labels;                     // empty: all voxels inside
    std::string name = {};                               // empty for a single system without a name in the file
    std::optional<double> isovalue{};                    // of a scan: voxels of at least this value are inside
    std::optional<std::array<std::uint8_t, 3>> colour{}; // sRGB, from the file
};

// The labels of each system. Empty: each label is a system of its own. None: all labels are one system.
using LabelGroups = std::optional<std::vector<std::vector<LabelChoice>>>;

// The systems for `groups`. A volume of fractions has one system. Systems overlap where labels overlap. Fails on a
// label without a voxel, on a label in two groups, on an empty mask, and if the volume looks like a scan.
[[nodiscard]] Result<std::vector<SystemMask>> systems_of(const Volume& volume, const LabelGroups& groups);

} // namespace ramus::volume
