// Bounds: an axis-aligned box around what it was given; around nothing, its least corner is above its greatest.
#pragma once

#include <glm/common.hpp>
#include <limits>

namespace ramus {

template <class Vector> struct Bounds {
    using Number = typename Vector::value_type;
    Vector least{std::numeric_limits<Number>::max()}, most{std::numeric_limits<Number>::lowest()};

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
    // What two boxes share; where they do not meet, its least corner is above its greatest along some axis.
    [[nodiscard]] Bounds common(const Bounds& other) const {
        return {glm::max(least, other.least), glm::min(most, other.most)};
    }
    [[nodiscard]] Vector size() const { return most - least; }
};

} // namespace ramus
