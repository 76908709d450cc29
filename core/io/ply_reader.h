// PLY, text and binary of either byte order: vertices and polygons, whatever else the file has is passed over. Every
// count in the file is checked against what the file holds before anything is done with it.
#pragma once

#include "core/base/error.h"

#include <cstdint>
#include <glm/vec3.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace ramus::io {

struct PolygonSoup {
    std::vector<glm::dvec3> positions;
    std::vector<std::vector<std::uint32_t>> polygons; // indices are those of positions that are there
};

// `name` is what errors say.
[[nodiscard]] Result<PolygonSoup> parse_ply(std::string_view text, const std::string& name);

} // namespace ramus::io
