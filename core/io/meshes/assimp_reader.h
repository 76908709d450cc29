// Reads meshes with the assimp library, in a separate process (core/base/own_process.h), because damaged files can
// crash the library. The library sees only the given bytes and opens no files.
#pragma once

#include "core/io/meshes/mesh_file.h"

namespace ramus::io {

// `extension`: the library's name of the format, without a dot. Positions include the transforms of the nodes in the
// file's scene. Fails on damaged files.
[[nodiscard]] Result<PolygonSoup> parse_with_assimp(std::string_view text, const std::string& extension,
                                                    const std::string& name);

} // namespace ramus::io
