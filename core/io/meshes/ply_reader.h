// PLY, text and binary of either byte order: vertices and polygons; anything else in the file is skipped. Every count
// in the file is checked against what the file holds before anything is done with it. (Damaged files make assimp work
// for minutes, or worse.)
#pragma once

#include "core/io/meshes/mesh_format.h"

namespace ramus::io {

[[nodiscard]] bool is_ply(std::string_view head);

// `name` is what errors say.
[[nodiscard]] Result<PolygonSoup> parse_ply(std::string_view text, const std::string& name);

} // namespace ramus::io
