// Reads Voreen's vessel graphs (.vvg, JSON): nodes with a radius, and edges with skeleton voxels that have distances to
// the vessel's surface. The mean distance is the radius. Voxels without one (Infinity) get it from their neighbours
// along the vessel.
#pragma once

#include "core/io/trees/tree_file.h"

namespace ramus::io {

[[nodiscard]] bool is_voreen(std::string_view head);
[[nodiscard]] Result<ImportedTree> parse_voreen(const TreeInput& input);

} // namespace ramus::io
