// From the loose triangles of a file to a surface with an inside: vertices at one position become one, all triangles
// are turned the same way round, and every edge must then have exactly two triangles.
#pragma once

#include "core/base/error.h"
#include "core/mesh/triangle_mesh.h"

#include <string>

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

} // namespace ramus::mesh
