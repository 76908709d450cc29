// The part of a box that lies behind a plane.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/vec3.hpp>

namespace ramus::organ {

// The function middle + dot(rise, p) over the unit box, p from -1/2 to 1/2.
struct Linear {
    double middle = 0.0;
    glm::dvec3 rise{0.0};
    [[nodiscard]] double at(const glm::dvec3& p) const { return middle + rise.x * p.x + rise.y * p.y + rise.z * p.z; }
};

// The position of a corner of the unit box; bit a of the number is the side along axis a.
[[nodiscard]] inline glm::dvec3 unit_corner(int corner) {
    return glm::dvec3(corner & 1, corner >> 1 & 1, corner >> 2 & 1) - 0.5;
}

// The linear function with the least squared differences from values at the eight corners.
[[nodiscard]] inline Linear linear_through(const std::array<double, 8>& values) {
    Linear fit;
    for (int corner = 0; corner < 8; ++corner) {
        const double value = values[static_cast<std::size_t>(corner)];
        fit.middle += 0.125 * value;
        fit.rise += 0.5 * value * unit_corner(corner);
    }
    return fit;
}

// The share of the unit box in which a linear function is below 0, exact up to rounding.
//
// The volume of a box's corner behind a plane: R. Scardovelli and S. Zaleski, "Analytical relations connecting linear
// interfaces and volume fractions in rectangular grids", J. Comput. Phys. 164, 2000.
[[nodiscard]] inline double share_below(const Linear& function) {
    glm::dvec3 m = glm::abs(function.rise);
    const double sum = m.x + m.y + m.z;
    if (sum <= 2.0 * std::abs(function.middle)) return function.middle > 0.0 ? 0.0 : 1.0;
    m = glm::max(m / sum, glm::dvec3(1e-5)); // so that no division loses digits
    const double whole = m.x + m.y + m.z;
    // From the corner where the function is least.
    const double level = 0.5 * whole - function.middle / sum;
    const double less = std::min(level, whole - level); // the smaller side, for its digits
    if (less <= 0.0) return level <= 0.0 ? 0.0 : 1.0;
    const auto cube = [](double x) { return x > 0.0 ? x * x * x : 0.0; };
    const double volume = (cube(less) - cube(less - m.x) - cube(less - m.y) - cube(less - m.z) +
                           cube(less - m.x - m.y) + cube(less - m.x - m.z) + cube(less - m.y - m.z)) /
                          (6.0 * m.x * m.y * m.z);
    const double share = std::clamp(volume, 0.0, 1.0);
    return less == level ? share : 1.0 - share;
}

} // namespace ramus::organ
