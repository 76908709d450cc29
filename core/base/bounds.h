// Bounds: an axis-aligned box around what it was given; around nothing, its least corner is above its greatest.
#pragma once

#include <glm/common.hpp>
#include <limits>

namespace ramus {

template <class Vector> struct Bounds {
    using Number = typename Vector::value_type;
    Vector least{std::numeric_limits<Number>::max()}, most{std::numeric_limits<Number>::lowest()};

    void hold(const Vector& point, Number reach = Number(0)) {
        least = glm::min(least, point - reach);
        most = glm::max(most, point + reach);
    }
    [[nodiscard]] Vector size() const { return most - least; }
};

} // namespace ramus
