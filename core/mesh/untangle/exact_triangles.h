// Whether two triangles with corners in single precision meet, decided exactly: signs of determinants are found in
// double precision where that is certain, and as sums of doubles without any rounding elsewhere (Shewchuk 1997).
// Triangles contain their edges and corners, and may have no area.
#pragma once

#include <glm/vec3.hpp>
#include <span>

namespace ramus::mesh {

namespace exact {

using Corner = glm::vec3;

// The sign of det(b - a, c - a, p - a): on which side of the plane through a, b and c the point is.
[[nodiscard]] int side_of_plane(const Corner& a, const Corner& b, const Corner& c, const Corner& p);
// Seen along an axis (0 to 2): the sign of the turn from a over b to c.
[[nodiscard]] int turn(const Corner& a, const Corner& b, const Corner& c, int axis);

} // namespace exact

// Triangles of one mesh, as numbers of their corners, and where those are. Corners that two triangles share are told by
// number: such triangles meet there anyway, and what is asked is whether they meet beyond. One that is there twice
// meets itself.
[[nodiscard]] bool triangles_meet(std::span<const glm::vec3> positions, const glm::uvec3& s, const glm::uvec3& t);

} // namespace ramus::mesh
