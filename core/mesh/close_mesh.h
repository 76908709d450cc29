// From the loose triangles of a file to a surface with an inside: vertices at one position become one, all triangles
// are turned the same way round, and every edge must then have exactly two triangles.
#pragma once

#include "core/base/error.h"
#include "core/mesh/triangle_mesh.h"

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <vector>

namespace ramus::mesh {

// Keeps positions and triangles of `loose`, without the triangles that two or three corners at one position have made a
// line, and gives unit normals per vertex. A part that was turned the same way round already keeps its turn (a hole in
// a solid is a shell turned inward), unless the whole mesh would be inside out; another part is turned outward. `where`
// is what errors name. Fails when nothing is left, when an edge has another number of triangles than two (the message
// says how many, and where the first is), and on a surface with one side only.
[[nodiscard]] Result<TriangleMesh> closed_mesh(TriangleMesh loose, const std::string& where);

// The same of a surface that is only looked at: one with holes, or whose edges have more triangles than two, stays as
// it is but for the welding and the normals. Fails when nothing is left.
[[nodiscard]] Result<TriangleMesh> tidy_mesh(TriangleMesh loose, const std::string& where);

// Fails unless every edge has two triangles, as closed_mesh() does, of a mesh whose vertices are welded already.
[[nodiscard]] Result<void> check_closed(const TriangleMesh& mesh, const std::string& where);

// A flat polygon cut into triangles, dents included.
//
// Triples of indices into `corners`, turned as the polygon is; two fewer triangles than corners, whose edges inside the
// polygon are shared by two each. A polygon that is not flat, or crosses itself, is cut somehow. Time grows with the
// square of the corners, so from a thousand on it is cut as a fan.
[[nodiscard]] std::vector<glm::uvec3> cut_polygon(std::span<const glm::dvec3> corners);

} // namespace ramus::mesh
