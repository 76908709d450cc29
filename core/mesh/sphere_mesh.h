// A ball as a closed mesh: an octahedron whose triangles are divided five times and put onto the sphere. Inscribed; no
// place of it is deeper than 0.0006 radii.
#pragma once

#include "core/mesh/triangle_mesh.h"

#include <glm/vec3.hpp>

namespace ramus::mesh {

// Positions and triangles; 8,192 of them.
[[nodiscard]] TriangleMesh sphere_mesh(const glm::dvec3& centre, double radius);

} // namespace ramus::mesh
