// The nearest point of a line segment to a point, in two and three dimensions.
#pragma once

#include <algorithm>
#include <glm/geometric.hpp>

namespace ramus {

// The parameter, in [0, 1], of the nearest point on a segment. `line`: from its start to its end. `from`: from its
// start to the query point. 0 for a segment of length 0.
template <class Vector> [[nodiscard]] auto share_along(const Vector& from, const Vector& line) {
    using Number = typename Vector::value_type;
    const Number squared = glm::dot(line, line);
    return squared > Number(0) ? std::clamp(glm::dot(from, line) / squared, Number(0), Number(1)) : Number(0);
}

// The point of the segment ab that is nearest to p.
template <class Vector> [[nodiscard]] Vector nearest_on_line(const Vector& p, const Vector& a, const Vector& b) {
    return a + share_along(p - a, b - a) * (b - a);
}
template <class Vector> [[nodiscard]] auto distance_to_line(const Vector& p, const Vector& a, const Vector& b) {
    return glm::distance(p, nearest_on_line(p, a, b));
}

} // namespace ramus
