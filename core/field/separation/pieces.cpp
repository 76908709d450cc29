#include "core/field/separation/pieces.h"

#include "core/tree/contacts/links.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <utility>

namespace ramus::field {

namespace {

// A lower bound of the distance of an obstacle's axis from a vessel's moved axis.
double least_distance(const PieceShape& obstacle, const PieceShape& vessel) {
    const auto link = [](const glm::dvec3& start, const glm::dvec3& end) {
        return tree::Link{0, 0, {start, 0.5}, {end, 0.5}, 0}; // radii of 0.5 make the closeness a distance
    };
    const auto axis_of = [&](const PieceShape& shape) { return link(shape.start, shape.end); };
    return tree::closest_approach(axis_of(obstacle), axis_of(vessel)).closeness - vessel.move.most();
}

// The shadow of an obstacle on a vessel: none, a shadow, or the shadow of a piercing obstacle.
enum class Shade : std::uint8_t { kNone, kCasts, kPierces };

// A vessel claims points within claim_radii of its axis. A point in shadow is within the obstacle's radius R of a way
// through the obstacle's axis. Points in the obstacle's tube belong to the obstacle, whose axis is nearer. So a shadow
// matters only if the vessel reaches farther than the tube. A point that the support of the obstacle does not reach
// lies farther along the way, by sqrt(support_radii^2 - 1) R.
Shade shade_of(const PieceShape& obstacle, const PieceShape& vessel, double distance, const Kernel& kernel) {
    constexpr double kSlack = 0.1; // radii, since vessel and obstacle may be bent
    const double r = std::max(vessel.start_radius, vessel.end_radius);
    const double thin = std::min(obstacle.start_radius, obstacle.end_radius);
    const double thick = std::max(obstacle.start_radius, obstacle.end_radius);
    const double reach = (kernel.claim_radii + kSlack) * r + vessel.move.most();
    if (distance >= std::hypot(reach, thick)) return Shade::kNone;
    const double beyond = reach - std::sqrt(kernel.support_radii * kernel.support_radii - 1.0) * thin;
    return beyond > 0.0 && distance < std::hypot(beyond, thick) ? Shade::kPierces : Shade::kCasts;
}

} // namespace

Pieces::Pieces(const tree::Contacts& contacts, const Skeleton& skeleton, const Kernel& kernel) : contacts_(contacts) {
    if (contacts_.empty()) return;
    for (const std::uint32_t piece : contacts_.piece_of_segment)
        partnered_.push_back(contacts_.partners_of(piece).empty() ? kNone : piece);
    shape_of_piece_.assign(contacts_.first_partner.size() - 1, kNone);
    for (const std::uint32_t segment : skeleton.present()) { // segments of a piece are consecutive
        const std::uint32_t piece = of_segment(segment);
        if (contacts_.partners_of(piece).empty()) continue;
        const FieldSegment& s = skeleton.segments()[segment];
        const glm::dvec3 start(s.ax, s.ay, s.az);
        if (shape_of_piece_[piece] == kNone) {
            shape_of_piece_[piece] = static_cast<std::uint32_t>(shapes_.size());
            shapes_.push_back({start, {}, static_cast<double>(s.radius), 0.0, contacts_.move_of(piece)});
            piece_of_shape_.push_back(piece);
        }
        PieceShape& shape = shapes_[shape_of_piece_[piece]];
        shape.end = start + static_cast<double>(s.length) * glm::dvec3(s.ux, s.uy, s.uz);
        shape.end_radius = static_cast<double>(s.end_radius());
    }
    list_obstacles(kernel);
}

void Pieces::put_obstacle(std::size_t at, const tree::Contacts::Partner& partner, double least_distance) {
    const PieceShape& shape = *this->shape(partner.piece);
    const auto put = [&](std::size_t row, const glm::dvec3& v) {
        for (int axis = 0; axis < 3; ++axis) obstacles_.row(row + static_cast<std::size_t>(axis))[at] = v[axis];
    };
    const double length = glm::distance(shape.start, shape.end);
    put(kStartX, shape.start);
    if (length > 0.0) put(kAlongX, (shape.end - shape.start) / length);
    put(kMoveStartX, shape.move.start);
    put(kMoveEndX, shape.move.end);
    obstacles_.row(kMostMove)[at] = shape.move.most();
    obstacles_.row(kAxisLength)[at] = length;
    obstacles_.row(kAxisRadius)[at] = shape.start_radius;
    obstacles_.row(kAxisSlope)[at] = length > 0.0 ? (shape.end_radius - shape.start_radius) / length : 0.0;
    obstacles_.row(kApartFrom)[at] = static_cast<double>(partner.apart_from);
    obstacles_.row(kLeastDistance)[at] = least_distance;
}

void Pieces::list_obstacles(const Kernel& kernel) {
    using Partner = tree::Contacts::Partner;
    struct Obstacle {
        const Partner* partner;
        double distance; // a lower bound, mm
    };
    std::vector<std::vector<Obstacle>> pierce(shapes_.size()), cast(shapes_.size());
    std::size_t total = 0;
    for (std::size_t n = 0; n < shapes_.size(); ++n) {
        for (const Partner& partner : contacts_.partners_of(piece_of_shape_[n])) {
            const PieceShape* const other = shape(partner.piece);
            if (!(partner.apart_from > 0.0F) || other == nullptr) continue;
            const double distance = least_distance(*other, shapes_[n]);
            const Shade shade = shade_of(*other, shapes_[n], distance, kernel);
            if (shade != Shade::kNone) (shade == Shade::kPierces ? pierce : cast)[n].push_back({&partner, distance});
        }
        const std::size_t first = ObstacleRows::padded(pierce[n].size());
        ranges_.push_back({{total, first + cast[n].size()}, {total, pierce[n].size()}});
        total += first + ObstacleRows::padded(cast[n].size());
    }
    obstacles_.resize(total);
    for (std::size_t n = 0; n < shapes_.size(); ++n) {
        const std::size_t first = ranges_[n].all.first;
        for (const auto& [list, begin] :
             {std::pair(&pierce[n], first), std::pair(&cast[n], first + ObstacleRows::padded(pierce[n].size()))})
            for (std::size_t k = 0; k < list->size(); ++k)
                put_obstacle(begin + k, *(*list)[k].partner, (*list)[k].distance);
    }
}

bool Pieces::same_around(std::uint32_t piece, const Pieces& before) const {
    const auto same_shape = [&](std::uint32_t other) {
        const PieceShape* now = shape(other);
        const PieceShape* then = before.shape(other);
        return now == nullptr || then == nullptr ? now == then : *now == *then;
    };
    const auto partners = contacts_.partners_of(piece);
    if (!std::ranges::equal(partners, before.contacts_.partners_of(piece)) || !same_shape(piece)) return false;
    return std::ranges::all_of(partners, [&](const auto& partner) { return same_shape(partner.piece); });
}

} // namespace ramus::field
