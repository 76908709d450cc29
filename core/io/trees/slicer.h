// Markups of 3D Slicer (.mrk.json): curves of control points, with a measurement that gives the radius at each. Read
// from any program; curves are joined where their ends meet. Files that this program wrote say beside the curves how
// their points hang together, and come back as the same tree, as long as nobody has changed the curves.
#pragma once

#include "core/io/trees/tree_file.h"

namespace ramus::io {

[[nodiscard]] bool is_markups(std::string_view head);
[[nodiscard]] Result<ImportedTree> parse_markups(const TreeInput& input);

// A curve a branch, from the root outward, in mm and these axes, RAS or LPS (where nobody has said where the tree's
// lead, as they are), in the colour of its system, with the measurement "Radius". The member "ramus" holds roots,
// labels, systems, and which of the tree's points each curve's are. No comments.
[[nodiscard]] Result<void> write_markups(const tree::VesselTree& tree, const std::filesystem::path& file,
                                         const std::vector<std::string>& comments, const Orientation& axes);

} // namespace ramus::io
