#include "core/field/separation/wall.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>
#include <limits>
#include <optional>
#include <span>
#include <utility>

namespace ramus::field {

namespace {

// The depth of a point below one bound of a vessel, and the way out.
struct Depth {
    double mm = 0.0; // negative: outside
    glm::dvec3 outward{0.0};
    double cut_mm = 0.0; // for the bound of a shadow: how far the point is beyond the beginning of the shadow
};

// The depth below the vessel's own isosurface, to first order. Uses a measure of the field that is linear in the
// distance from a straight vessel's axis.
Depth depth_within(const VesselViews& views, const VesselView& view) {
    const LongVessel::Place place = views.place_of(view.value);
    const double slope = glm::length(view.gradient);
    const double steepness = slope / place.fall; // of the measure, per mm
    const double radius = views.radius(view.place);
    if (steepness > 1e-6 / radius)
        return {(views.surface_measure() - place.measure) / steepness, -view.gradient / slope};
    const double distance = views.distance(view.place);
    return {radius - distance, (views.point() - views.foot(view.place)) / std::max(distance, 1e-9 * radius)};
}

// The depth behind the vessel's side of the wall toward `other`, or `most` if that is not larger. A point belongs to
// `other` where `other` claims the point and its axis is nearer. Leaves half of the gap free.
Depth depth_beside(VesselViews& views, std::uint32_t own, std::uint32_t other, const Depth& most) {
    const double radius_own = views.radius(own), radius_other = views.radius(other);
    const double free = 0.5 * kWallRadii * std::min(radius_own, radius_other);
    const glm::dvec3 way_own = views.way_from(own), way_other = views.way_from(other);
    const double from_own = std::max(glm::length(way_own), 1e-9 * radius_own);
    const double from_other = std::max(glm::length(way_other), 1e-9 * radius_other);
    const glm::dvec3 slope = 0.5 * (way_other / from_other - way_own / from_own);
    const double steepness = std::max(glm::length(slope), 0.1);
    const Depth nearer{0.5 * (from_other - from_own) / steepness, -slope / steepness};
    if (!(nearer.mm - free < most.mm)) return most; // the surface of `other` can only increase the depth
    const Depth within_other = depth_within(views, views.view(other));
    Depth depth = -within_other.mm > nearer.mm ? Depth{-within_other.mm, -within_other.outward} : nearer;
    depth.mm -= free;
    return depth.mm < most.mm ? depth : most;
}

// Fills in the branch, dominance and local radius of a point, from the vessel's view.
void name(VesselViews& views, std::uint32_t own, WallPoint& point) {
    struct Share {
        std::int32_t branch = 0;
        double share = 0.0;
    };
    std::array<Share, 3> most{};
    const auto rank = [&](Share share) {
        for (Share& there : most)
            if (share.share > there.share) std::swap(share, there);
    };
    Share branch{views.branch(own), 0.0};
    most.fill({branch.branch, 0.0});
    double strongest = -1.0;
    const std::span<const double> left_out = views.left_out(own);
    for (const std::uint32_t n : views.seen()) {
        const double share = (1.0 - left_out[n]) * views.term(n);
        if (views.branch(n) != branch.branch) rank(branch), branch = {views.branch(n), 0.0};
        branch.share += share;
        if (share > strongest) strongest = share, point.radius = views.tree_radius(n);
    }
    rank(branch);
    point.branch = most[0].branch;
    for (std::size_t n = 0; n < 2; ++n) {
        const double over = most[n + 1].share > 0.0 ? std::log(most[0].share / most[n + 1].share) : kMostDominance;
        point.dominance.over[n] = static_cast<std::uint8_t>(std::clamp(over / kMostDominance, 0.0, 1.0) * 255.0);
        point.dominance.rivals[n] =
            most[n + 1].share > 0.0 ? static_cast<std::uint8_t>(most[n + 1].branch & 255) : std::uint8_t{0};
    }
}

// The depth before the nearest shadow on a vessel, if that is less than `below` mm.
std::optional<Depth> depth_before(VesselViews& views, std::uint32_t own, double below) {
    const Shadow shadow = views.shadow_on(own, below);
    if (!(shadow.spare < below)) return std::nullopt;
    const ShadowSide side = views.side_of(own, shadow);
    return Depth{shadow.spare, side.toward, side.beyond};
}

// The depth of the current point within the vessel of segment `own`: the least depth below its isosurface, behind its
// sides of walls, and before shadows.
Depth depth_of(VesselViews& views, std::uint32_t own) {
    Depth depth = depth_within(views, views.view(own));
    views.list_vessels();
    for (const std::uint32_t other : views.vessels()) {
        if (other == own || !views.apart(own, other)) continue;
        depth = depth_beside(views, own, other, depth);
    }
    return depth_before(views, own, depth.mm).value_or(depth);
}

// Makes `point` the current point. Returns the nearest segment of the vessel of `place`.
std::uint32_t look_from(VesselViews& views, std::uint32_t place, const glm::dvec3& point, std::uint64_t& kernels) {
    views.look(point);
    const std::uint32_t own = views.nearest_of_vessel(place);
    if (own != VesselViews::kNone) kernels += views.add_terms();
    return own;
}

// The shortest way to the line in which two bounds of a vessel cross, to first order. None if they are nearly parallel.
std::optional<glm::dvec3> way_to_crossing(const Depth& a, const Depth& b) {
    constexpr double kLeastTurn = 0.05; // the sine of the angle between them, squared
    const double aa = glm::dot(a.outward, a.outward), bb = glm::dot(b.outward, b.outward);
    const double ab = glm::dot(a.outward, b.outward), turn = aa * bb - ab * ab;
    if (!(turn > kLeastTurn * aa * bb)) return std::nullopt;
    return ((bb * a.mm - ab * b.mm) * a.outward + (aa * b.mm - ab * a.mm) * b.outward) / turn;
}

// Moves a point onto the edge of a shadow nearby, if that is no farther than a cell. Only where the shadow cuts off
// more than go_onward() restores, so that the edge is visible. The current point of `views` is near the point.
void go_to_rim(VesselViews& views, std::uint32_t place, std::uint32_t seen, double onward, std::uint64_t& kernels,
               WallPoint& point) {
    constexpr int kSteps = 3;
    constexpr double kReach = 0.6; // share of `onward`: about a cell
    const double reach = kReach * onward;
    if (const auto before = depth_before(views, seen, reach);
        !before || depth_within(views, views.view(seen)).mm + before->cut_mm < onward)
        return; // go_onward() restores all of it
    glm::dvec3 at = point.position, normal(0.0);
    for (int step = 0; step < kSteps; ++step) {
        const std::uint32_t own = look_from(views, place, at, kernels);
        if (own == VesselViews::kNone) return;
        const Depth within = depth_within(views, views.view(own));
        const auto before = depth_before(views, own, reach);
        const auto way = before ? way_to_crossing(within, *before) : std::nullopt;
        if (!way) return;
        at += *way;
        if (glm::distance(at, point.position) > reach) return;
        normal = glm::normalize(within.outward);
    }
    point.onward = at - point.position;
    point.onward_normal = normal;
}

// Sets the way from a wall point to the vessel's own surface, if that is no farther than `onward` mm, less the part of
// the shadow before the point. Returns whether it did. `depth` is the depth of the current point of `views`, which is
// near the wall point.
bool go_onward(VesselViews& views, std::uint32_t own, const Depth& depth, double onward, WallPoint& point) {
    const Depth within = depth_within(views, views.view(own));
    const double mm = within.mm - glm::dot(within.outward, point.position - views.point());
    const double outward = glm::length(within.outward);
    if (!(within.mm > depth.mm && mm > 0.0 && mm < onward - depth.cut_mm && outward > 0.0)) return false;
    point.onward = mm * within.outward;
    point.onward_normal = within.outward / outward;
    return true;
}

} // namespace

WallPoint move_to_wall(VesselViews& views, std::uint32_t place, const glm::dvec3& guess,
                       const Bounds<glm::dvec3>& bounds, double onward, std::uint64_t& kernels) {
    constexpr int kSteps = 6;
    // In radii. The depth is linear to first order, so the error after such a step is of its square. The step is
    // shorter than half the gap of a wall between equal vessels, so it does not cross a wall that begins there.
    constexpr double kShortStep = 0.006;
    const glm::dvec3 size = bounds.size();
    const double reach = 0.5 * std::max({size.x, size.y, size.z});
    const glm::dvec3 free = glm::vec3(glm::greaterThan(size, glm::dvec3(0.0))); // 0 along fixed axes
    WallPoint point;
    point.position = glm::clamp(guess, bounds.least, bounds.most);
    glm::dvec3 from = point.position; // of the last step
    for (int step = 0; step < kSteps; ++step) {
        const std::uint32_t own = look_from(views, place, point.position, kernels);
        if (own == VesselViews::kNone) {
            if (const std::uint32_t before = look_from(views, place, from, kernels); before != VesselViews::kNone)
                name(views, before, point);
            break;
        }
        const Depth depth = depth_of(views, own);
        const double outward = glm::length(depth.outward);
        if (outward > 0.0) point.normal = depth.outward / outward;
        // Along the free axes that do not lead out of the bounds, an inclined surface is farther than its depth.
        glm::dvec3 way = free * depth.outward;
        for (int axis = 0; axis < 3; ++axis) {
            const double moving = way[axis] * depth.mm;
            if ((moving < 0.0 && point.position[axis] <= bounds.least[axis]) ||
                (moving > 0.0 && point.position[axis] >= bounds.most[axis]))
                way[axis] = 0.0;
        }
        const double inclined = std::max(glm::dot(way, way), 0.1);
        const glm::dvec3 aim = point.position + way * std::clamp(depth.mm / inclined, -reach, reach);
        from = std::exchange(point.position, glm::clamp(aim, bounds.least, bounds.most));
        if (step + 1 == kSteps || glm::distance(from, point.position) < kShortStep * views.radius(own)) {
            name(views, own, point);
            if (onward > 0.0 && !go_onward(views, own, depth, onward, point))
                go_to_rim(views, place, own, onward, kernels, point);
            break;
        }
    }
    return point;
}

DrawnPoint::Place go_on_own_surface(VesselViews& views, std::uint32_t place, double near_radii, WallPoint& point,
                                    std::uint64_t& kernels) {
    constexpr int kSteps = 3;
    for (int step = 0; step < kSteps; ++step) {
        const std::uint32_t own = look_from(views, place, point.position, kernels);
        if (own == VesselViews::kNone) return DrawnPoint::Place::kWall;
        const Depth within = depth_within(views, views.view(own));
        const double outward = glm::length(within.outward);
        if (!(outward > 0.0) || (step == 0 && std::abs(within.mm) > near_radii * views.radius(own)))
            return DrawnPoint::Place::kWall;
        point.position += within.mm * within.outward;
        point.normal = within.outward / outward;
    }
    const std::uint32_t own = look_from(views, place, point.position, kernels);
    return own != VesselViews::kNone && views.is_within_another(own) ? DrawnPoint::Place::kCovered
                                                                     : DrawnPoint::Place::kOwn;
}

} // namespace ramus::field
