// Where a straight piece is nearest to a point, in two dimensions and in three.
#pragma once

#include <algorithm>
#include <glm/geometric.hpp>

namespace ramus {

// The share of the way along a line at which it is nearest to a point `from` its start; 0 where it has no length.
template <class Vector> [[nodiscard]] auto share_along(const Vector& from, const Vector& line) {
    using Number = typename Vector::value_type;
    const Number squared = glm::dot(line, line);
    return squared > Number(0) ? std::clamp(glm::dot(from, line) / squared, Number(0), Number(1)) : Number(0);
}

template <class Vector> [[nodiscard]] auto distance_to_line(const Vector& p, const Vector& a, const Vector& b) {
    return glm::distance(p, a + share_along(p - a, b - a) * (b - a));
}

} // namespace ramus
