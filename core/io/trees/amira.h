// Reads SpatialGraph files of Amira and Avizo (.am): vertices, edges between them, points along the edges, and arrays
// of any of the three; as text or as binary of either byte order, plain or compressed. The width "thickness" is a
// radius in Amira and a diameter in some other programs; it is taken as a radius, with a note.
#pragma once

#include "core/io/trees/tree_file.h"

namespace ramus::io {

[[nodiscard]] bool is_amira(std::string_view head);
[[nodiscard]] Result<ImportedTree> parse_amira(const TreeInput& input);

} // namespace ramus::io
