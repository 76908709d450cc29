#include "core/tree/contacts/gaps.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace ramus::tree {

namespace {

// The largest cosine between the way and an axis: daughters that diverge by up to twice its arcsine, 41 degrees, lie
// side by side. Tuned on straight daughters with random orientations: in meshes of the plain sum with 5 or more
// triangles around a vessel, false loops join daughters that diverge by up to 28 degrees.
constexpr double kAside = 0.35;

// Whether the way between two places is nearly perpendicular to a link's axis, or may be: it is known to within
// `spare`.
bool aside(const glm::dvec3& way, double spare, const Link& link) {
    const glm::dvec3 axis = link.b.position - link.a.position;
    const double along = std::abs(glm::dot(way, axis)), length = glm::length(axis);
    return along < (kAside * (glm::length(way) + spare) + spare) * length;
}

// A quick test: rejects neighbours along one vessel by their midpoints alone.
bool may_be_beside(const Link& a, const Link& b) {
    const glm::dvec3 way = 0.5 * (b.a.position + b.b.position) - 0.5 * (a.a.position + a.b.position);
    const double spare = 0.5 * (glm::distance(a.a.position, a.b.position) + glm::distance(b.a.position, b.b.position));
    return aside(way, spare, a) && aside(way, spare, b);
}

} // namespace

bool Gaps::between(std::uint32_t first, std::uint32_t second) {
    const Link a = links_[first];
    const Link b = links_[second];
    if (!may_be_beside(a, b)) return false;
    const Approach approach = closest_approach(a, b);
    const Point p = point_on(a, approach.share_a), q = point_on(b, approach.share_b);
    const glm::dvec3 way = q.position - p.position;
    if (!aside(way, 0.0, a) || !aside(way, 0.0, b)) return false;
    const Point middle{glm::mix(p.position, q.position, p.radius / (p.radius + q.radius)), 0.0};
    if (along_.all().empty() || along_.all().front().link != first) along_.start(first);
    return std::ranges::none_of(along_.all(),
                                [&](const auto& there) { return closer(middle, links_[there.link], 1.0); });
}

} // namespace ramus::tree
