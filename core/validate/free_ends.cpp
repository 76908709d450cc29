#include "core/validate/free_ends.h"

#include <algorithm>
#include <glm/geometric.hpp>

namespace ramus::validate {

FreeEnds::FreeEnds(const tree::VesselTree& tree) : ends_(tree.branches.size()) {
    std::vector<int> degree(tree.points.size(), 0);
    for (const tree::Branch& branch : tree.branches) ++degree[branch.points.front()], ++degree[branch.points.back()];
    for (std::size_t id = 0; id < tree.branches.size(); ++id) {
        const std::vector<std::uint32_t>& points = tree.branches[id].points;
        const auto add = [&](std::uint32_t end, std::uint32_t before) {
            const glm::dvec3 out = tree.points[end].position - tree.points[before].position;
            if (degree[end] == 1 && glm::length(out) > 0.0)
                ends_[id].push_back({tree.points[end], glm::normalize(out)});
        };
        if (points.size() < 2) continue;
        add(points.front(), points[1]);
        add(points.back(), points[points.size() - 2]);
    }
}

bool FreeEnds::beyond(int branch, const glm::dvec3& at) const {
    constexpr double kReach = 1.5; // radii: farther, it is another place of the same branch
    return std::ranges::any_of(ends_[static_cast<std::size_t>(branch)], [&](const End& end) {
        const glm::dvec3 way = at - end.point.position;
        return glm::dot(way, end.out) > 0.0 && glm::length(way) <= kReach * end.point.radius;
    });
}

} // namespace ramus::validate
