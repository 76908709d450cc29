#include "core/tree/contacts/links.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace ramus::tree {

namespace {

// The least length of a link in local radii. The difference between an arc this short and its chord is negligible.
constexpr double kLinkRadii = 0.3;

double closeness_at(const Link& a, double share_a, const Link& b, double share_b) {
    const Point p = point_on(a, share_a);
    const Point q = point_on(b, share_b);
    return glm::distance(p.position, q.position) / (p.radius + q.radius);
}

} // namespace

// The axes' nearest points, then the ends of each: with tapering links an end may be closer in radii.
Approach closest_approach(const Link& a, const Link& b) {
    const glm::dvec3 u = a.b.position - a.a.position;
    const glm::dvec3 v = b.b.position - b.a.position;
    const glm::dvec3 w = a.a.position - b.a.position;
    const double uu = glm::dot(u, u), uv = glm::dot(u, v), vv = glm::dot(v, v);
    const double uw = glm::dot(u, w), vw = glm::dot(v, w);
    const double steepness = uu * vv - uv * uv;
    const double at_a = steepness > 1e-12 * uu * vv ? std::clamp((uv * vw - vv * uw) / steepness, 0.0, 1.0) : 0.5;
    const double at_b = nearest_share(point_on(a, at_a).position, b);
    Approach best;
    best.closeness = 1e300;
    const auto look = [&](double share_a, double share_b) {
        const double c = closeness_at(a, share_a, b, share_b);
        if (c < best.closeness) best = {c, share_a, share_b};
    };
    look(nearest_share(point_on(b, at_b).position, a), at_b);
    for (const double end : {0.0, 1.0}) {
        look(end, nearest_share(point_on(a, end).position, b));
        look(nearest_share(point_on(b, end).position, a), end);
    }
    return best;
}

Links::Links(const PreparedTree& prepared) : points_(prepared.tree.points) {
    const VesselTree& tree = prepared.tree;
    of_segment_.reserve(tree.segment_count());
    ends_.reserve(tree.segment_count());
    for (const Branch& branch : tree.branches) {
        std::size_t first = 0;
        double length = 0.0;
        for (std::size_t i = 1; i < branch.points.size(); ++i) {
            const std::uint32_t from = branch.points[first];
            const std::uint32_t to = branch.points[i];
            const int source = prepared.segment_source[of_segment_.size()];
            length += glm::distance(tree.points[branch.points[i - 1]].position, tree.points[to].position);
            of_segment_.push_back(static_cast<std::uint32_t>(ends_.size()));
            const double thinner = std::min(tree.points[from].radius, tree.points[to].radius);
            const bool more = i + 1 < branch.points.size() && prepared.segment_source[of_segment_.size()] == source;
            if (more && length < kLinkRadii * thinner) continue;
            ends_.push_back({from, to, source});
            first = i;
            length = 0.0;
        }
    }
    at_point_ = Grouped<std::uint32_t>(tree.points.size(), [&](const auto& put) {
        for (std::size_t n = 0; n < ends_.size(); ++n) {
            put(ends_[n].from, static_cast<std::uint32_t>(n));
            put(ends_[n].to, static_cast<std::uint32_t>(n));
        }
    });
}

} // namespace ramus::tree
