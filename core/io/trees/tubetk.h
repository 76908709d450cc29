// TubeTK's .tre (MetaIO): a scene of tubes, each with a header of names and values and a table of points, as text or
// binary. PointDim names the columns. A tube may name the tube that it leaves from (ParentID) and the point there
// (ParentPoint). Positions are multiplied by ElementSpacing and the radius by its first number, as ITK does; axes are
// those of ITK, left, posterior, superior. Arteries and veins are systems where a file has both.
#pragma once

#include "core/io/trees/tree_file.h"

namespace ramus::io {

[[nodiscard]] bool is_tre(std::string_view head);
[[nodiscard]] Result<ImportedTree> parse_tre(const TreeInput& input);

} // namespace ramus::io
