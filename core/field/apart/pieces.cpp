#include "core/field/apart/pieces.h"

#include <algorithm>

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
            shapes_.push_back({start, {}, static_cast<double>(s.radius), 0.0});
        }
        PieceShape& shape = shapes_[shape_of_piece_[piece]];
        shape.end = start + static_cast<double>(s.length) * glm::dvec3(s.ux, s.uy, s.uz);
        shape.end_radius = static_cast<double>(s.end_radius());
    }
}

bool Pieces::same_around(std::uint32_t piece, const Pieces& before) const {
    const auto partners = contacts_.partners_of(piece);
    if (!std::ranges::equal(partners, before.contacts_.partners_of(piece))) return false;
    return std::ranges::all_of(partners, [&](const tree::Contacts::Partner& partner) {
        const PieceShape* now = shape(partner.piece);
        const PieceShape* then = before.shape(partner.piece);
        return now == nullptr || then == nullptr ? now == then : *now == *then;
    });
}

bool Pieces::in_contact(std::uint32_t piece) const {
    return std::ranges::any_of(contacts_.partners_of(piece), [&](const tree::Contacts::Partner& partner) {
        return partner.apart_from > 0.0F && shape(partner.piece) != nullptr;
    });
}

} // namespace ramus::field
