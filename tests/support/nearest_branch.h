// The branch that supplies a place, by a search through all segments and all tips in double precision.
#pragma once

#include "core/organ/supply.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <vector>

namespace ramus::test {

inline double to_segment(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b) {
    const double length = glm::distance(a, b);
    const glm::dvec3 unit = (b - a) / length;
    const double along = glm::dot(p - a, unit);
    if (along <= 0.0) return glm::distance(p, a);
    if (along >= length) return glm::distance(p, b);
    return glm::length(glm::cross(p - a, unit));
}

// The least of |p - q| - times r(q) over the points q of a segment, by golden section: the function is convex.
inline double to_wall(const glm::dvec3& p, const tree::Point& a, const tree::Point& b, double times) {
    const auto value = [&](double t) {
        return glm::distance(p, glm::mix(a.position, b.position, t)) - times * std::lerp(a.radius, b.radius, t);
    };
    double low = 0.0, high = 1.0;
    for (int n = 0; n < 60; ++n) {
        const double first = low + 0.381966 * (high - low), second = high - 0.381966 * (high - low);
        if (value(first) < value(second))
            high = second;
        else
            low = first;
    }
    return std::min({value(0.5 * (low + high)), value(0.0), value(1.0)});
}

// The nearest branch, its value, and the least value of the other branches.
struct NearestBranch {
    std::int32_t branch = -1;
    double value = HUGE_VAL, next = HUGE_VAL;

    void offer(std::int32_t id, double offered) {
        if (id == branch) {
            value = std::min(value, offered);
        } else if (offered < value) {
            next = value;
            value = offered;
            branch = id;
        } else {
            next = std::min(next, offered);
        }
    }
};

// `inside`: points_in(); `ends`: measure::free_ends().
inline NearestBranch nearest_branch(const tree::VesselTree& tree, const std::vector<std::uint8_t>& inside,
                                    const std::vector<char>& ends, const organ::SupplyOptions& options,
                                    const glm::dvec3& p) {
    using organ::Rule;
    const double times = options.rule == Rule::kAxis ? 0.0 : options.rule == Rule::kWall ? 1.0 : -options.axis_back;
    NearestBranch nearest;
    for (std::size_t id = 0; id < tree.branches.size(); ++id) {
        const auto branch = static_cast<std::int32_t>(id);
        const auto& points = tree.branches[id].points;
        for (std::size_t n = 1; n < points.size(); ++n) {
            const tree::Point &a = tree.points[points[n - 1]], &b = tree.points[points[n]];
            if (inside[points[n - 1]] == 0 && inside[points[n]] == 0) continue;
            const double away = to_segment(p, a.position, b.position);
            // No point of the segment has a lower value than this.
            if (away - std::max(times * a.radius, times * b.radius) > nearest.next) continue;
            nearest.offer(branch, times == 0.0 ? away : to_wall(p, a, b, times));
        }
        const tree::Point& end = tree.points[points.back()];
        if (options.rule == Rule::kTips && ends[id] != 0 && inside[points.back()] != 0)
            nearest.offer(branch, glm::distance(p, end.position) - options.tip_reach * end.radius);
    }
    return nearest;
}

} // namespace ramus::test
