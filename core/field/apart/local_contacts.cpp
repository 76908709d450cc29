#include "core/field/apart/local_contacts.h"

#include <algorithm>

namespace ramus::field {

namespace {

// Pieces of the segments that have partners anywhere, ascending.
void list_pieces(const tree::Contacts& contacts, SegmentIndices list, std::vector<std::uint32_t>& pieces) {
    pieces.clear();
    for (const std::uint32_t segment : list) {
        const std::uint32_t piece = contacts.piece_of_segment[segment];
        if (contacts.first_partner[piece] == contacts.first_partner[piece + 1]) continue;
        if (pieces.empty() || pieces.back() != piece) pieces.push_back(piece);
    }
    std::ranges::sort(pieces);
    pieces.erase(std::unique(pieces.begin(), pieces.end()), pieces.end());
}

// Both are ascending, and the pieces are fewer.
bool any_partner(std::span<const tree::Contacts::Partner> partners, const std::vector<std::uint32_t>& pieces) {
    auto next = pieces.begin();
    for (const tree::Contacts::Partner& partner : partners) {
        while (next != pieces.end() && *next < partner.piece) ++next;
        if (next == pieces.end()) return false;
        if (*next == partner.piece) return true;
    }
    return false;
}

} // namespace

bool any_apart(const Pieces& pieces, SegmentIndices list, std::vector<std::uint32_t>& scratch) {
    list_pieces(pieces.contacts(), list, scratch);
    return std::ranges::any_of(scratch, [&](std::uint32_t piece) {
        return pieces.piercing(piece).count > 0 || any_partner(pieces.contacts().partners_of(piece), scratch);
    });
}

bool LocalContacts::enter(SegmentIndices list) {
    const tree::Contacts& contacts = all_.contacts();
    list_pieces(contacts, list, listed_);
    pieces_.clear();
    for (const std::uint32_t piece : listed_)
        if (all_.piercing(piece).count > 0 || any_partner(contacts.partners_of(piece), listed_))
            pieces_.push_back(piece);
    if (pieces_.empty()) return false;
    const auto number_of = [&](std::uint32_t piece) {
        const auto found = std::ranges::lower_bound(pieces_, piece);
        return found != pieces_.end() && *found == piece ? static_cast<int>(found - pieces_.begin()) : -1;
    };
    piece_of_.clear();
    std::uint32_t last = 0;
    for (const std::uint32_t segment : list) { // those of a piece follow each other
        const std::uint32_t piece = all_.of_segment(segment);
        piece_of_.push_back(!piece_of_.empty() && piece == last ? piece_of_.back() : number_of(piece));
        last = piece;
    }
    matrix_.assign(pieces_.size() * pieces_.size(), -1.0F);
    partner_bits_.assign(pieces_.size() * words(), 0);
    for (std::size_t a = 0; a < pieces_.size(); ++a)
        for (const tree::Contacts::Partner& partner : contacts.partners_of(pieces_[a])) {
            const int b = number_of(partner.piece);
            if (b < 0) continue;
            const auto other = static_cast<std::size_t>(b);
            matrix_[a * pieces_.size() + other] = partner.apart_from;
            if (partner.apart_from > 0.0F) partner_bits_[a * words() + other / 64] |= std::uint64_t{1} << other % 64;
        }
    return true;
}

} // namespace ramus::field
