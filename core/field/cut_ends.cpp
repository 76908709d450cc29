#include "core/field/cut_ends.h"

#include <algorithm>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace ramus::field {

namespace {

// In radii. Vertices farther from the end, or from its axis, belong to another part of the vessel.
constexpr double kFarthestCap = 4.0, kWidestCap = 1.6;
constexpr double kSamePlace = 1e-4;
constexpr double kLeastAslant = 0.1; // least cosine between axis and normal: more oblique ends get no cap

} // namespace

std::vector<CutEnd> cut_ends_of(const tree::PreparedTree& prepared) {
    const tree::VesselTree& tree = prepared.tree;
    std::vector<CutEnd> ends;
    if (std::ranges::none_of(tree.notes, [](const tree::Note& note) { return note.at && note.outward; })) return ends;
    std::vector<int> degree(tree.points.size(), 0);
    for (const tree::Branch& branch : tree.branches) ++degree[branch.points.front()], ++degree[branch.points.back()];
    std::size_t first_segment = 0;
    for (const tree::Branch& branch : tree.branches) {
        const std::size_t segments = branch.points.size() - 1;
        const auto look = [&](std::uint32_t end, std::uint32_t before, std::size_t segment) {
            if (degree[end] != 1) return;
            const tree::Point& point = tree.points[end];
            const glm::dvec3 way = point.position - tree.points[before].position;
            for (const tree::Note& note : tree.notes) {
                if (!note.at || !note.outward || !(glm::dot(way, *note.outward) > kLeastAslant * glm::length(way)) ||
                    glm::distance(*note.at, point.position) > kSamePlace * point.radius)
                    continue;
                ends.push_back({point.position, *note.outward, glm::normalize(way), point.radius,
                                prepared.segment_source[segment]});
                return;
            }
        };
        look(branch.points.front(), branch.points[1], first_segment);
        look(branch.points.back(), branch.points[segments - 1], first_segment + segments - 1);
        first_segment += segments;
    }
    return ends;
}

void flatten_ends(const std::vector<CutEnd>& ends, const SurfacePoints& vertices, std::size_t count) {
    for (const CutEnd& end : ends) {
        const double cosine = glm::dot(end.along, end.outward);
        for (std::size_t n = 0; n < count; ++n) {
            if (vertices.branches[n] != end.branch) continue;
            const glm::dvec3 from_end = glm::dvec3(vertices.positions[n]) - end.at;
            const double beyond = glm::dot(from_end, end.outward) / cosine; // along the axis
            if (!(beyond > 0.0) || beyond > kFarthestCap * end.radius) continue;
            glm::dvec3 on_plane = from_end - beyond * end.along;
            if (glm::length(on_plane) > kWidestCap * end.radius / cosine) continue;
            on_plane *= 1.0 - beyond / (kFarthestCap * end.radius);
            on_plane -= glm::dot(on_plane, end.outward) * end.outward;
            vertices.positions[n] = glm::vec3(end.at + on_plane);
            vertices.normals[n] = glm::vec3(end.outward);
        }
    }
}

} // namespace ramus::field
