#include "core/field/separation/local_contacts.h"

#include "core/base/sort_unique.h"

#include <algorithm>

namespace ramus::field {

namespace {

// Lists the pieces of the segments that have partners anywhere, ascending.
void list_pieces(const Pieces& all, SegmentIndices list, std::vector<std::uint32_t>& pieces) {
    pieces.clear();
    for (const std::uint32_t segment : list) {
        const std::uint32_t piece = all.partnered(segment);
        if (piece != Pieces::kNone && (pieces.empty() || pieces.back() != piece)) pieces.push_back(piece);
    }
    if (pieces.empty()) return;
    sort_unique(pieces);
}

// Calls visit(partner, n) for each partner that equals pieces[n], until it returns false. Both lists are ascending.
template <class Visit>
void for_partners(std::span<const tree::Contacts::Partner> partners, const std::vector<std::uint32_t>& pieces,
                  const Visit& visit) {
    std::size_t n = 0;
    for (const tree::Contacts::Partner& partner : partners) {
        while (n < pieces.size() && pieces[n] < partner.piece) ++n;
        if (n == pieces.size()) return;
        if (pieces[n] == partner.piece && !visit(partner, n)) return;
    }
}

bool any_partner(std::span<const tree::Contacts::Partner> partners, const std::vector<std::uint32_t>& pieces) {
    bool any = false;
    for_partners(partners, pieces, [&](const tree::Contacts::Partner&, std::size_t) { return !(any = true); });
    return any;
}

} // namespace

bool any_apart(const Pieces& pieces, SegmentIndices list, std::vector<std::uint32_t>& scratch) {
    list_pieces(pieces, list, scratch);
    return std::ranges::any_of(scratch, [&](std::uint32_t piece) {
        return pieces.piercing(piece).count > 0 || any_partner(pieces.contacts().partners_of(piece), scratch);
    });
}

bool LocalContacts::enter(SegmentIndices list) {
    const tree::Contacts& contacts = all_.contacts();
    list_pieces(all_, list, pieces_);
    pairs_.clear();
    bool any_pierced = false;
    for (std::size_t n = 0; n < pieces_.size(); ++n) {
        for_partners(contacts.partners_of(pieces_[n]), pieces_, [&](const tree::Contacts::Partner& partner, auto m) {
            pairs_.push_back({n, m, partner.apart_from});
            return true;
        });
        any_pierced = any_pierced || all_.piercing(pieces_[n]).count > 0;
    }
    if (pairs_.empty() && !any_pierced) return false;
    number_segments(list);
    matrix_.assign(pieces_.size() * pieces_.size(), -1.0F);
    partner_bits_.assign(pieces_.size() * words(), 0);
    for (const auto& [a, b, apart_from] : pairs_) {
        matrix_[a * pieces_.size() + b] = apart_from;
        if (apart_from > 0.0F) partner_bits_[a * words() + b / 64] |= std::uint64_t{1} << b % 64;
    }
    return true;
}

void LocalContacts::number_segments(SegmentIndices list) {
    const auto number_of = [&](std::uint32_t piece) {
        const auto found = std::ranges::lower_bound(pieces_, piece);
        return found != pieces_.end() && *found == piece ? static_cast<int>(found - pieces_.begin()) : -1;
    };
    piece_of_.clear();
    std::uint32_t last = 0;
    for (const std::uint32_t segment : list) { // segments of a piece are consecutive
        const std::uint32_t piece = all_.of_segment(segment);
        piece_of_.push_back(!piece_of_.empty() && piece == last ? piece_of_.back() : number_of(piece));
        last = piece;
    }
}

} // namespace ramus::field
