#include "core/mesh/cut_polygon.h"

#include <glm/geometric.hpp>
#include <numeric>

namespace ramus::mesh {

std::vector<glm::uvec3> cut_polygon(std::span<const glm::dvec3> corners) {
    constexpr std::size_t kMostCorners = 1000;
    std::vector<glm::uvec3> triangles;
    if (corners.size() > kMostCorners) {
        for (std::uint32_t i = 1; i + 1 < corners.size(); ++i) triangles.emplace_back(0, i, i + 1);
        return triangles;
    }
    std::vector<std::uint32_t> left(corners.size());
    std::iota(left.begin(), left.end(), 0U);
    glm::dvec3 normal(0.0);
    for (std::size_t i = 0; i < corners.size(); ++i)
        normal += glm::cross(corners[i] - corners[0], corners[(i + 1) % corners.size()] - corners[0]);
    const auto turn = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        return glm::dot(glm::cross(corners[b] - corners[a], corners[c] - corners[a]), normal);
    };
    // An ear: a corner that juts out and whose triangle holds no other corner.
    const auto is_ear = [&](std::size_t i) {
        const std::size_t n = left.size();
        const std::uint32_t a = left[(i + n - 1) % n], b = left[i], c = left[(i + 1) % n];
        if (turn(a, b, c) <= 0.0) return false;
        for (const std::uint32_t p : left)
            if (p != a && p != b && p != c && turn(a, b, p) >= 0.0 && turn(b, c, p) >= 0.0 && turn(c, a, p) >= 0.0)
                return false;
        return true;
    };
    while (left.size() >= 3) {
        const std::size_t n = left.size();
        std::size_t ear = 1; // a fan, where there is no better
        if (n > 3)
            for (std::size_t i = 0; i < n; ++i)
                if (is_ear((i + 1) % n)) {
                    ear = (i + 1) % n;
                    break;
                }
        triangles.emplace_back(left[(ear + n - 1) % n], left[ear], left[(ear + 1) % n]);
        left.erase(left.begin() + static_cast<std::ptrdiff_t>(ear));
    }
    return triangles;
}

} // namespace ramus::mesh
