// Links: the centerlines of a tree as short straight pieces, about 0.3 radii long or one segment, if that is longer.
// So the number of pairs of links that touch does not grow with the density of the file's points. Lengths are in mm.
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

// The point at a share of a link: 0 at its start, 1 at its end. The radius is interpolated linearly.
[[nodiscard]] inline Point point_on(const Link& link, double share) {
    return {glm::mix(link.a.position, link.b.position, share), link.a.radius + share * (link.b.radius - link.a.radius)};
}
// The share of the point of the link that is nearest to `position`.
[[nodiscard]] inline double nearest_share(const glm::dvec3& position, const Link& link) {
    return share_along(position - link.a.position, link.b.position - link.a.position);
}

// The least closeness of two links, which is the distance of two places divided by the sum of their radii, and where it
// is. Exact for constant radii; an approximation for tapering links.
struct Approach {
    double closeness = 0.0;
    double share_a = 0.0, share_b = 0.0; // of the place on each link
};
[[nodiscard]] Approach closest_approach(const Link& a, const Link& b);
// The closeness of a point of the tree and the nearest point of a link.
[[nodiscard]] inline double closeness(const Point& point, const Link& link) {
    const Point foot = point_on(link, nearest_share(point.position, link));
    return glm::distance(point.position, foot.position) / (point.radius + foot.radius);
}
// closeness() < limit, up to rounding, without a square root and a division.
[[nodiscard]] inline bool closer(const Point& point, const Link& link, double limit) {
    const Point foot = point_on(link, nearest_share(point.position, link));
    const glm::dvec3 between = point.position - foot.position;
    const double most = limit * (point.radius + foot.radius);
    return glm::dot(between, between) < most * most;
}

class Links {
public:
    // Keeps a reference to the points, which must stay where they are.
    explicit Links(const PreparedTree& prepared);
    explicit Links(PreparedTree&&) = delete;

    [[nodiscard]] std::size_t size() const { return ends_.size(); }
    [[nodiscard]] Link operator[](std::size_t n) const {
        const Ends& of = ends_[n];
        return {of.from, of.to, points_[of.from], points_[of.to], of.branch};
    }
    // The links that begin or end at a point of the tree.
    [[nodiscard]] std::span<const std::uint32_t> at(std::uint32_t point) const { return at_point_.of(point); }
    // By segment of the prepared tree (branches in order, segments along each): the link that contains it.
    [[nodiscard]] const std::vector<std::uint32_t>& of_segment() const { return of_segment_; }
    // Whether two links share a point of the tree.
    [[nodiscard]] bool joined(std::size_t a, std::size_t b) const {
        const Ends& p = ends_[a];
        const Ends& q = ends_[b];
        return p.from == q.from || p.from == q.to || p.to == q.from || p.to == q.to;
    }

private:
    struct Ends {
        std::uint32_t from, to;
        int branch;
    };
    std::span<const Point> points_; // of the tree
    std::vector<Ends> ends_;
    std::vector<std::uint32_t> of_segment_;
    Grouped<std::uint32_t> at_point_;
};

} // namespace ramus::tree
