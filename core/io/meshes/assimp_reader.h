// Meshes read by the assimp library, which is told the format, in a process of its own: damaged files make it crash.
// It sees these bytes and no file.
#pragma once

#include "core/io/meshes/mesh_file.h"

namespace ramus::io {

// `extension` without its dot, as the library calls the format. Positions are where the nodes of the file's scene place
// them. Fails on damaged files.
[[nodiscard]] Result<PolygonSoup> parse_with_assimp(std::string_view text, const std::string& extension,
                                                    const std::string& name);

} // namespace ramus::io
