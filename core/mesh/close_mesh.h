// Turns the triangle soup of a file into a closed, oriented surface: welds vertices at one position, orients all
// triangles consistently, and checks that every edge has exactly two triangles.
#pragma once

#include "core/base/error.h"
#include "core/mesh/triangle_mesh.h"

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <vector>

namespace ramus::mesh {

// Welds the vertices of `loose`, removes triangles with two or three equal corners, and computes unit normals per
// vertex. A part that is consistently oriented keeps its orientation (a cavity is a shell that faces inward), unless
// the whole mesh would be inside out; other parts are oriented outward. `where` names the mesh in errors. Fails if no
// triangle is left, if an edge has a number of triangles other than two (the message gives the number of such edges and
// the position of the first), and if the surface is not orientable.
[[nodiscard]] Result<TriangleMesh> closed_mesh(TriangleMesh loose, const std::string& where);

// The same for a surface that is only displayed: a surface with holes or non-manifold edges is welded and gets normals,
// and is not changed otherwise. Fails if no triangle is left.
[[nodiscard]] Result<TriangleMesh> tidy_mesh(TriangleMesh loose, const std::string& where);

// Fails unless every edge of a welded mesh has exactly two triangles.
[[nodiscard]] Result<void> check_closed(const TriangleMesh& mesh, const std::string& where);

// Triangulates a planar polygon, convex or not.
//
// Returns triples of indices into `corners`, with the orientation of the polygon: corners - 2 triangles, and each edge
// inside the polygon is shared by two of them. For a polygon that is not planar, or intersects itself, the result is a
// valid list of triangles of unspecified shape. Takes quadratic time, so polygons of a thousand corners or more become
// fans.
[[nodiscard]] std::vector<glm::uvec3> cut_polygon(std::span<const glm::dvec3> corners);

} // namespace ramus::mesh
