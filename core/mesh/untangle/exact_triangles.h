// Exact intersection tests of two triangles with corners in single precision. Signs of determinants are computed in
// double precision with an error bound; if that is not certain, exactly as sums of doubles (Shewchuk 1997). Triangles
// include their edges and corners, and may be degenerate.
#pragma once

#include <cmath>
#include <glm/vec3.hpp>
#include <limits>
#include <span>

namespace ramus::mesh {

namespace exact {

using Corner = glm::vec3;

constexpr double kRounding = 0.5 * std::numeric_limits<double>::epsilon();

// The plane through three points, for several queries of the side of a point.
class Plane {
public:
    Plane() = default;
    Plane(const Corner& a, const Corner& b, const Corner& c) : a_(a), b_(b), c_(c) {
        const glm::dvec3 u = glm::dvec3(b) - glm::dvec3(a);
        const glm::dvec3 v = glm::dvec3(c) - glm::dvec3(a);
        for (int i = 0; i < 3; ++i) {
            const double left = u[(i + 1) % 3] * v[(i + 2) % 3], right = u[(i + 2) % 3] * v[(i + 1) % 3];
            normal_[i] = left - right;
            most_[i] = std::abs(left) + std::abs(right);
        }
    }
    // side_of_plane(), or 0 if double precision does not decide.
    [[nodiscard]] int sure_side(const Corner& p) const {
        const glm::dvec3 w = glm::dvec3(p) - glm::dvec3(a_);
        const double det = w.x * normal_.x + w.y * normal_.y + w.z * normal_.z;
        const double most = std::abs(w.x) * most_.x + std::abs(w.y) * most_.y + std::abs(w.z) * most_.z;
        const double error = (7.0 + 56.0 * kRounding) * kRounding * most; // Shewchuk 1997, the first bound of orient3d
        return det > error ? 1 : det < -error ? -1 : 0;
    }
    // side_of_plane().
    [[nodiscard]] int side(const Corner& p) const {
        const int sure = sure_side(p);
        return sure != 0 ? sure : exact_side(p);
    }

private:
    [[nodiscard]] int exact_side(const Corner& p) const;
    Corner a_{0.0F}, b_{0.0F}, c_{0.0F};
    glm::dvec3 normal_{0.0}, most_{0.0}; // most_: sums of the absolute values of the products in normal_
};

// The sign of det(b - a, c - a, p - a): the side of the plane through a, b and c on which p lies.
[[nodiscard]] int side_of_plane(const Corner& a, const Corner& b, const Corner& c, const Corner& p);
// The orientation of a, b, c, projected along an axis (0 to 2): the sign of the turn from a over b to c.
[[nodiscard]] int turn(const Corner& a, const Corner& b, const Corner& c, int axis);

} // namespace exact

// Whether two triangles of one mesh intersect beyond their common corners. Corners are common if they have the same
// index. Two triangles with the same three corners intersect.
[[nodiscard]] bool triangles_meet(std::span<const glm::vec3> positions, const glm::uvec3& s, const glm::uvec3& t);
// A quick test that rules out triangles_meet(): the corners of `t` that the two do not share are certainly on one side
// of the plane of `s`.
[[nodiscard]] bool surely_beside(std::span<const glm::vec3> positions, const exact::Plane& plane, const glm::uvec3& s,
                                 const glm::uvec3& t);

} // namespace ramus::mesh
