// VesselViews::find_zone(): the cells of a brick in which vessels can affect each other.
#include "core/field/separation/vessel_views.h"

#include <algorithm>
#include <cmath>
#include <glm/vector_relational.hpp>
#include <utility>

namespace ramus::field {

namespace {

// In cells: a point this near to a shadow may have to be moved away from it.
constexpr double kBesideCells = 1.5;

// A box (mm) around the shadow that obstacle `n` casts, with a margin `around`. `way` is the longest way out of the
// vessel that may be in shadow. A way in shadow passes the obstacle's axis within the obstacle's radius.
Bounds<glm::dvec3> box_behind(const ObstacleRows& obstacles, std::size_t n, double way, double around) {
    const auto number = [&](std::size_t row) { return obstacles.row(row)[n]; };
    const auto vector = [&](std::size_t row) { return glm::dvec3(number(row), number(row + 1), number(row + 2)); };
    const double length = number(kAxisLength), radius = number(kAxisRadius);
    const double lateral = std::max(radius, radius + number(kAxisSlope) * length) + 2.0 * around;
    const double nearest = number(kLeastDistance);
    const double begin = nearest > lateral ? std::sqrt(nearest * nearest - lateral * lateral) : 0.0;
    const double behind = std::max(way - begin, around);
    const double reach = std::sqrt(behind * behind + lateral * lateral);
    const glm::dvec3 start = vector(kStartX), end = start + length * vector(kAlongX);
    Bounds<glm::dvec3> box;
    box.hold(start, reach), box.hold(end, reach);
    return box;
}

// Whether the distance of two boxes along each axis is at most `near`. Rejects most pairs before their cells are found.
bool meet(const Bounds<glm::dvec3>& a, const Bounds<glm::dvec3>& b, double near) {
    return glm::all(glm::lessThanEqual(a.least, b.most + near)) && glm::all(glm::lessThanEqual(b.least, a.most + near));
}

} // namespace

// The zone contains the points near both vessels of a contact, the points that both vessels of a near miss may claim
// (with a margin of a cell), and the points in or next to the shadow of an obstacle.
void VesselViews::find_zone(const GridAxes& axes) {
    zone_.begin(axes);
    const double cell = axes.x[1] - axes.x[0];
    const Bounds<glm::dvec3> around = zone_.box();
    beside_mm_ = kBesideCells * cell;
    reach_.assign(static_cast<std::size_t>(contacts_.piece_count()), {});
    for (std::uint32_t n = 0; n < list_.size(); ++n) {
        if (piece(n) < 0) continue;
        PieceReach& reach = reach_[static_cast<std::size_t>(piece(n))];
        const FieldSegment& s = segments_[list_[n]];
        const glm::dvec3 start(s.ax, s.ay, s.az), along(s.ux, s.uy, s.uz);
        for (const auto& [end, r] :
             {std::pair(start, s.radius), std::pair(start + static_cast<double>(s.length) * along, s.end_radius())}) {
            const auto radius = static_cast<double>(r);
            const double claims = kernel_.claim_radii * radius + cell;
            reach.claims.hold(end, claims);
            reach.near.hold(end, std::max(claims, reach_radii_ * radius));
            reach.radius = std::max(reach.radius, radius);
        }
    }
    for (PieceReach& reach : reach_)
        reach.near_cells = zone_.cells_of(reach.near), reach.claimed_cells = zone_.cells_of(reach.claims);
    for (int a = 0; a < contacts_.piece_count(); ++a) {
        const PieceReach& own = reach_[static_cast<std::size_t>(a)];
        for (int b = 0; b < a; ++b) {
            const PieceReach& other = reach_[static_cast<std::size_t>(b)];
            if (const float from = contacts_.apart_from(a, b); from > 0.0F)
                zone_.add(own.near_cells.common(other.near_cells));
            else if (from == 0.0F)
                zone_.add(own.claimed_cells.common(other.claimed_cells));
        }
    }
    for (int a = 0; a < contacts_.piece_count(); ++a) {
        const PieceReach& own = reach_[static_cast<std::size_t>(a)];
        if (zone_.has_all(own.claimed_cells)) continue; // holds for most pieces with obstacles
        const double way = (kernel_.claim_radii + 0.1) * own.radius + contacts_.shape(a).move.most();
        const ObstacleRange range = contacts_.piercing(a);
        const Bounds<glm::dvec3> claimed = own.claims.common(around);
        for (std::size_t n = range.first; n < range.first + range.count; ++n) {
            const Bounds<glm::dvec3> behind = box_behind(contacts_.all().obstacles(), n, way, beside_mm_);
            if (!meet(claimed, behind, 2.0 * cell)) continue;
            zone_.add(own.claimed_cells.common(zone_.cells_of(behind)));
            if (zone_.has_all(own.claimed_cells)) break;
        }
    }
}

} // namespace ramus::field
