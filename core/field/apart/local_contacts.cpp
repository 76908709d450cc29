#include "core/field/apart/local_contacts.h"

#include <algorithm>

namespace ramus::field {

namespace {

// Pieces of the segments that have partners anywhere, ascending.
void list_pieces(const Pieces& all, SegmentIndices list, std::vector<std::uint32_t>& pieces) {
    pieces.clear();
    for (const std::uint32_t segment : list) {
        const std::uint32_t piece = all.partnered(segment);
        if (piece != Pieces::kNone && (pieces.empty() || pieces.back() != piece)) pieces.push_back(piece);
    }
    if (pieces.empty()) return;
    std::ranges::sort(pieces);
    pieces.erase(std::unique(pieces.begin(), pieces.end()), pieces.end());
}

// Calls visit(partner, n) for the partners that are the n-th of some pieces. Both are ascending.
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
    list_pieces(all_, list, listed_);
    pieces_.clear(), pairs_.clear();
    number_.assign(listed_.size(), -1);
    for (std::size_t n = 0; n < listed_.size(); ++n) {
        const std::size_t before = pairs_.size();
        for_partners(contacts.partners_of(listed_[n]), listed_, [&](const tree::Contacts::Partner& partner, auto m) {
            pairs_.push_back({n, m, partner.apart_from});
            return true;
        });
        if (pairs_.size() == before && all_.piercing(listed_[n]).count == 0) continue;
        number_[n] = piece_count();
        pieces_.push_back(listed_[n]);
    }
    if (pieces_.empty()) return false;
    number_segments(list);
    matrix_.assign(pieces_.size() * pieces_.size(), -1.0F);
    partner_bits_.assign(pieces_.size() * words(), 0);
    for (const Pair& pair : pairs_) {
        if (number_[pair.first] < 0 || number_[pair.second] < 0) continue;
        const auto a = static_cast<std::size_t>(number_[pair.first]),
                   b = static_cast<std::size_t>(number_[pair.second]);
        matrix_[a * pieces_.size() + b] = pair.apart_from;
        if (pair.apart_from > 0.0F) partner_bits_[a * words() + b / 64] |= std::uint64_t{1} << b % 64;
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
    for (const std::uint32_t segment : list) { // those of a piece follow each other
        const std::uint32_t piece = all_.of_segment(segment);
        piece_of_.push_back(!piece_of_.empty() && piece == last ? piece_of_.back() : number_of(piece));
        last = piece;
    }
}

} // namespace ramus::field
