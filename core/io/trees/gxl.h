// Reads GXL as VascuSynth and OpenCCO write it (.gxl, .xml): nodes with a position, edges with a radius, directed from
// the root outward. Names of attributes may begin with a blank. The types of nodes are ignored, because both programs
// sometimes call other nodes the root; the root is the node that no edge leads to.
#pragma once

#include "core/io/trees/tree_file.h"

namespace ramus::io {

[[nodiscard]] bool is_gxl(std::string_view head);
[[nodiscard]] Result<ImportedTree> parse_gxl(const TreeInput& input);

} // namespace ramus::io
