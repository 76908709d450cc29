// Reads and writes markups of 3D Slicer (.mrk.json): curves of control points, with a measurement for the radius at
// each. Curves are joined where their ends meet. Files written by ramus also store how the points are connected, and
// read back as the same tree if nobody has changed the curves.
#pragma once

#include "core/io/trees/tree_file.h"

namespace ramus::io {

[[nodiscard]] bool is_markups(std::string_view head);
[[nodiscard]] Result<ImportedTree> parse_markups(const TreeInput& input);

// Writes each branch as a curve from the root outward, in mm and in `axes` (RAS or LPS), in the colour of its system,
// with the measurement "Radius". If the tree's axes are unknown, positions are written unchanged. The member "ramus"
// holds roots, labels, systems, and the index of each control point in the tree. Comments are not written.
[[nodiscard]] Result<void> write_markups(const tree::VesselTree& tree, const std::filesystem::path& file,
                                         const std::vector<std::string>& comments, const Orientation& axes);

} // namespace ramus::io
