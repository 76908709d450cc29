// Reads TubeTK's .tre files (MetaIO): a scene of tubes, each with header fields and a table of points, as text or
// binary. PointDim names the columns. A tube may name its parent tube (ParentID) and the point where it leaves it
// (ParentPoint). As in ITK, positions are multiplied by ElementSpacing and the radius by its first number, and the axes
// are LPS. Arteries and veins become systems if a file has both.
#pragma once

#include "core/io/trees/tree_file.h"

namespace ramus::io {

[[nodiscard]] bool is_tre(std::string_view head);
[[nodiscard]] Result<ImportedTree> parse_tre(const TreeInput& input);

} // namespace ramus::io
