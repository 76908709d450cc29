// A flat polygon cut into triangles, dents included.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace ramus::mesh {

// Triples of indices into `corners`, turned as the polygon is; two fewer triangles than corners, whose edges inside the
// polygon are shared by two each. A polygon that is not flat, or crosses itself, is cut somehow. Time grows with the
// square of the corners, so from a thousand on it is cut as a fan.
[[nodiscard]] std::vector<glm::uvec3> cut_polygon(std::span<const glm::dvec3> corners);

} // namespace ramus::mesh
