// Reads and writes ramus's own tree format: JSON, versioned, lossless. A written file reads back as an equal
// VesselTree, with its branch ids, also for networks with loops and several components.
//
//   {"format": "ramus-tree", "version": 2, "units": "mm", "orientation": "RAS", "source": "liver.swc",
//    "points": [[x, y, z, radius], ...],
//    "labels": [3, ...],                 one for each point; left out when the tree has none
//    "branches": [[0, 1, 2], ...],       indices into points, from the root outward
//    "systems": [{"name": "portal vein", "colour": [61, 108, 176]}, ...], "branch_systems": [0, ...], left out when
//                                        the tree has none
//    "point_data": {"pressure": [80.5, null, ...]}, "branch_data": {"flow": [...]}, one number for each point or
//    branch,
//                                        null: unknown; left out when the tree has none
//    "roots": [0, ...],
//    "notes": [{"kind": "repaired", "topic": "zero-radii", "text": "...", "at": [x, y, z]}, ...]}
//
// The reader checks every type, index and number, and builds the tree anew from the branches.
#pragma once

#include "core/io/trees/tree_file.h"

namespace ramus::io {

// Whether a file that begins with `head` states this format.
[[nodiscard]] bool is_tree_json(std::string_view head);

[[nodiscard]] Result<ImportedTree> parse_tree_json(const TreeInput& input);

// `comments` are ignored: the format has none, and the tree's own source and notes are written.
[[nodiscard]] Result<void> write_tree_json(const tree::VesselTree& tree, const std::filesystem::path& file,
                                           const std::vector<std::string>& comments = {});

} // namespace ramus::io
