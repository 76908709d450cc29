// Bounds: an axis-aligned bounding box, closed on all sides. An empty box has `least` above `most` on every axis.
#pragma once

#include <glm/common.hpp>
#include <limits>

namespace ramus {

template <class Vector> struct Bounds {
    using Number = typename Vector::value_type;
    Vector least{std::numeric_limits<Number>::max()}, most{std::numeric_limits<Number>::lowest()};

    // Grows the box around a point, a ball of radius `reach`, or another box.
    void hold(const Vector& point) {
        least = glm::min(least, point);
        most = glm::max(most, point);
    }
    void hold(const Vector& point, Number reach) {
        least = glm::min(least, point - reach);
        most = glm::max(most, point + reach);
    }
    void hold(const Bounds& other) {
        least = glm::min(least, other.least);
        most = glm::max(most, other.most);
    }
    // The intersection of two boxes. Where they do not meet, `least` is above `most` on at least one axis.
    [[nodiscard]] Bounds common(const Bounds& other) const {
        return {glm::max(least, other.least), glm::min(most, other.most)};
    }
    [[nodiscard]] Vector size() const { return most - least; }
};

} // namespace ramus
