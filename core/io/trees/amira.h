// Amira's and Avizo's SpatialGraph (.am): vertices, edges between them, points along the edges, and arrays of any of
// the three. Read as text and as binary of either byte order, plain or compressed. An array is found by the mark that
// its declaration gives it. "thickness" is a radius in Amira itself and a diameter in some other programs.
#pragma once

#include "core/io/trees/tree_file.h"

namespace ramus::io {

[[nodiscard]] bool is_amira(std::string_view head);
[[nodiscard]] Result<ImportedTree> parse_amira(const TreeInput& input);

} // namespace ramus::io
