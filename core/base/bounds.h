// Bounds: an axis-aligned bounding box, closed on all sides. An empty box has `least` above `most` on every axis.
#pragma once

#include <cmath>
#include <glm/common.hpp>
#include <glm/vec3.hpp>
#include <glm/vector_relational.hpp>
#include <limits>
#include <ranges>

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
    // Whether two boxes have a point in common.
    [[nodiscard]] bool meets(const Bounds& other) const {
        bool meet = true; // no test depends on another
        for (int axis = 0; axis < Vector::length(); ++axis) {
            meet &= least[axis] <= other.most[axis];
            meet &= other.least[axis] <= most[axis];
        }
        return meet;
    }
    [[nodiscard]] bool contains(const Bounds& other) const {
        return glm::all(glm::lessThanEqual(least, other.least)) && glm::all(glm::greaterThanEqual(most, other.most));
    }
    [[nodiscard]] bool is_empty() const { return glm::any(glm::greaterThan(least, most)); }
    [[nodiscard]] Vector size() const { return most - least; }
};

// The bounding box of points.
template <class Points> [[nodiscard]] auto box_of_points(const Points& points) {
    Bounds<std::ranges::range_value_t<Points>> box;
    for (const auto& point : points) box.hold(point);
    return box;
}
// A box in single precision that contains the given one.
[[nodiscard]] inline Bounds<glm::vec3> rounded_outward(const Bounds<glm::dvec3>& exact) {
    constexpr float kFar = std::numeric_limits<float>::max();
    Bounds<glm::vec3> box{glm::vec3(exact.least), glm::vec3(exact.most)};
    for (int axis = 0; axis < 3; ++axis) {
        box.least[axis] = std::nextafter(box.least[axis], -kFar);
        box.most[axis] = std::nextafter(box.most[axis], kFar);
    }
    return box;
}

} // namespace ramus
