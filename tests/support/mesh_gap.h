// How far pieces of a mesh are from each other.
#pragma once

#include "tests/support/mesh_intersections.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <limits>

namespace ramus::test {

namespace details {

inline double point_to_triangle(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    const glm::dvec3 normal = glm::cross(b - a, c - a);
    const auto within = [&](const glm::dvec3& from, const glm::dvec3& to) {
        return glm::dot(glm::cross(to - from, p - from), normal) >= 0.0;
    };
    if (glm::length(normal) > 0.0 && within(a, b) && within(b, c) && within(c, a))
        return std::abs(glm::dot(p - a, glm::normalize(normal)));
    const auto to_line = [&](const glm::dvec3& from, const glm::dvec3& to) {
        const glm::dvec3 line = to - from;
        const double share = glm::clamp(glm::dot(p - from, line) / std::max(glm::dot(line, line), 1e-300), 0.0, 1.0);
        return glm::distance(p, from + share * line);
    };
    return std::min({to_line(a, b), to_line(b, c), to_line(c, a)});
}

inline double line_to_line(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d) {
    const glm::dvec3 u = b - a, v = d - c, w = a - c;
    const double uu = glm::dot(u, u), uv = glm::dot(u, v), vv = glm::dot(v, v), uw = glm::dot(u, w),
                 vw = glm::dot(v, w);
    const double det = uu * vv - uv * uv;
    double s = det > 1e-12 * uu * vv ? glm::clamp((uv * vw - vv * uw) / det, 0.0, 1.0) : 0.0;
    const double t = glm::clamp((uv * s + vw) / std::max(vv, 1e-300), 0.0, 1.0);
    s = glm::clamp((uv * t - uw) / std::max(uu, 1e-300), 0.0, 1.0);
    return glm::distance(a + s * u, c + t * v);
}

} // namespace details

// Of two triangles that do not intersect, mm.
[[nodiscard]] inline double distance_between(const mesh::TriangleMesh& mesh, const glm::uvec3& s, const glm::uvec3& t) {
    const auto at = [&](std::uint32_t v) { return glm::dvec3(mesh.positions[v]); };
    double least = std::numeric_limits<double>::max();
    for (int i = 0; i < 3; ++i) {
        least = std::min(least, details::point_to_triangle(at(s[i]), at(t.x), at(t.y), at(t.z)));
        least = std::min(least, details::point_to_triangle(at(t[i]), at(s.x), at(s.y), at(s.z)));
        for (int j = 0; j < 3; ++j)
            least = std::min(least, details::line_to_line(at(s[i]), at(s[(i + 1) % 3]), at(t[j]), at(t[(j + 1) % 3])));
    }
    return least;
}

// Where triangles of different groups are nearest to each other.
struct Gap {
    double mm = 0.0;
    glm::uvec2 triangles{0};
};

// The least distance between triangles of different groups (a number for each vertex), where it is below `limit`, mm.
[[nodiscard]] inline Gap least_gap(const mesh::TriangleMesh& mesh, const std::vector<std::uint32_t>& group_of_vertex,
                                   double limit) {
    const TriangleFinder tree(mesh);
    tbb::enumerable_thread_specific<Gap> least(Gap{limit, {}});
    tbb::parallel_for(std::uint32_t{0}, static_cast<std::uint32_t>(mesh.triangles.size()), [&](std::uint32_t n) {
        TriangleFinder::Box box = tree.box(n);
        box.least -= limit, box.most += limit;
        const glm::uvec3& own = mesh.triangles[n];
        tree.for_each_in(box, [&](std::uint32_t other) {
            const glm::uvec3& there = mesh.triangles[other];
            if (other <= n || group_of_vertex[own.x] == group_of_vertex[there.x]) return;
            const double mm = distance_between(mesh, own, there);
            if (mm < least.local().mm) least.local() = {mm, {n, other}};
        });
    });
    Gap all{limit, {}};
    for (const Gap& some : least)
        if (some.mm < all.mm) all = some;
    return all;
}

} // namespace ramus::test
