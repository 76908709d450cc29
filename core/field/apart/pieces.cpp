#include "core/field/apart/pieces.h"

#include <algorithm>
#include <glm/geometric.hpp>

namespace ramus::field {

Pieces::Pieces(const tree::Contacts& contacts, const Skeleton& skeleton) : contacts_(contacts) {
    if (contacts_.empty()) return;
    shape_of_piece_.assign(contacts_.first_partner.size() - 1, kNone);
    for (const std::uint32_t segment : skeleton.present()) { // those of a piece follow each other
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
    list_obstacles();
}

void Pieces::list_obstacles() {
    const auto presses = [&](const tree::Contacts::Partner& partner) {
        return partner.apart_from > 0.0F && shape(partner.piece) != nullptr;
    };
    std::size_t total = 0;
    for (const std::uint32_t piece : piece_of_shape_) {
        const auto count = static_cast<std::size_t>(std::ranges::count_if(contacts_.partners_of(piece), presses));
        ranges_.push_back({total, count});
        total += ObstacleRows::padded(count);
    }
    obstacles_.resize(total);
    for (std::size_t n = 0; n < ranges_.size(); ++n) {
        std::size_t at = ranges_[n].first;
        for (const tree::Contacts::Partner& partner : contacts_.partners_of(piece_of_shape_[n])) {
            if (!presses(partner)) continue;
            const auto put = [&](std::size_t row, const glm::dvec3& v) {
                for (int axis = 0; axis < 3; ++axis) obstacles_.row(row + static_cast<std::size_t>(axis))[at] = v[axis];
            };
            const PieceShape& s = *shape(partner.piece);
            const double length = glm::distance(s.start, s.end);
            put(kStartX, s.start);
            if (length > 0.0) put(kAlongX, (s.end - s.start) / length);
            put(kMoveStartX, s.move.start);
            put(kMoveEndX, s.move.end);
            obstacles_.row(kAxisLength)[at] = length;
            obstacles_.row(kAxisRadius)[at] = s.start_radius;
            obstacles_.row(kAxisSlope)[at] = length > 0.0 ? (s.end_radius - s.start_radius) / length : 0.0;
            obstacles_.row(kApartFrom)[at++] = static_cast<double>(partner.apart_from);
        }
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
