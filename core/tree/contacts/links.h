// Links: a tree's centerlines in pieces that are short beside the vessel's radius but no shorter than it takes, so that
// the number of pairs that touch does not grow with how densely a file samples its vessels.
#pragma once

#include "core/base/grouped.h"
#include "core/base/lines.h"
#include "core/tree/prepare.h"

#include <algorithm>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace ramus::tree {

// A straight piece with linear radius between two points of the tree.
struct Link {
    std::uint32_t from = 0, to = 0; // points
    Point a, b;
    int branch = 0; // id in the file's tree
};

using ramus::share_along;

// A place on a link, 0 at its start and 1 at its end.
[[nodiscard]] inline Point point_on(const Link& link, double share) {
    return {glm::mix(link.a.position, link.b.position, share), link.a.radius + share * (link.b.radius - link.a.radius)};
}
// The one that is nearest to `position`.
[[nodiscard]] inline double nearest_share(const glm::dvec3& position, const Link& link) {
    return share_along(position - link.a.position, link.b.position - link.a.position);
}

// Where two links come closest, and how close: axis distance over the sum of the radii there.
struct Approach {
    double closeness = 0.0;
    double share_a = 0.0, share_b = 0.0; // along each
};
[[nodiscard]] Approach closest_approach(const Link& a, const Link& b);
// Of a point of the tree and a link.
[[nodiscard]] inline double closeness(const Point& point, const Link& link) {
    const Point foot = point_on(link, nearest_share(point.position, link));
    return glm::distance(point.position, foot.position) / (point.radius + foot.radius);
}
// Whether that is below `limit`, but for rounding: without a root and a division.
[[nodiscard]] inline bool closer(const Point& point, const Link& link, double limit) {
    const Point foot = point_on(link, nearest_share(point.position, link));
    const glm::dvec3 between = point.position - foot.position;
    const double most = limit * (point.radius + foot.radius);
    return glm::dot(between, between) < most * most;
}

class Links {
public:
    explicit Links(const PreparedTree& prepared);

    [[nodiscard]] const std::vector<Link>& all() const { return links_; }
    [[nodiscard]] const Link& operator[](std::size_t n) const { return links_[n]; }
    // That begin or end at a point of the tree.
    [[nodiscard]] std::span<const std::uint32_t> at(std::uint32_t point) const { return at_point_.of(point); }
    // The link that each segment of the prepared tree is part of (branches in order, segments along each).
    [[nodiscard]] const std::vector<std::uint32_t>& of_segment() const { return of_segment_; }
    [[nodiscard]] bool joined(std::size_t a, std::size_t b) const {
        const Link& p = links_[a];
        const Link& q = links_[b];
        return p.from == q.from || p.from == q.to || p.to == q.from || p.to == q.to;
    }

private:
    std::vector<Link> links_;
    std::vector<std::uint32_t> of_segment_;
    Grouped<std::uint32_t> at_point_;
};

} // namespace ramus::tree
