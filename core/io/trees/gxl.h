// GXL as VascuSynth and OpenCCO write it (.gxl, .xml): nodes with a position, edges with a radius, from the root
// outward. Names of attributes may begin with a blank. The types of nodes are not believed, for both programs call
// other nodes the root at times: the root is where no edge leads to.
#pragma once

#include "core/io/trees/tree_file.h"

namespace ramus::io {

[[nodiscard]] bool is_gxl(std::string_view head);
[[nodiscard]] Result<ImportedTree> parse_gxl(const TreeInput& input);

} // namespace ramus::io
