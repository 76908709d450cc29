#include "app/assets/ring.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

namespace ramus::app {

std::vector<glm::dvec3> ring_around(const glm::dvec3& centre, const glm::dvec3& axis, double radius_mm) {
    const glm::dvec3 other = std::abs(axis.z) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0);
    const glm::dvec3 u = glm::normalize(glm::cross(axis, other)), v = glm::cross(axis, u);
    constexpr int kSteps = 72;
    std::vector<glm::dvec3> points;
    for (int i = 0; i <= kSteps; ++i) {
        const double angle = glm::two_pi<double>() * (i % kSteps) / kSteps;
        points.push_back(centre + radius_mm * (std::cos(angle) * u + std::sin(angle) * v));
    }
    return points;
}

} // namespace ramus::app
