// LocalContacts: which of the segments that reach a brick are kept apart.
#pragma once

#include "core/field/brick_field.h"
#include "core/field/separation/pieces.h"

#include <cstdint>
#include <span>
#include <vector>

namespace ramus::field {

class LocalContacts {
public:
    explicit LocalContacts(const Pieces& pieces) : all_(pieces) {}

    // Whether any of the segments is kept apart from something. Only then the rest may be asked.
    bool enter(SegmentIndices list);
    [[nodiscard]] const Pieces& all() const { return all_; }

    // Of the n-th segment of the list: the number of its piece among those with partners anywhere, or -1. Bricks that
    // have a point in common agree on that, whichever partners reach them.
    [[nodiscard]] int piece(std::size_t n) const { return piece_of_[n]; }
    [[nodiscard]] int piece_count() const { return static_cast<int>(pieces_.size()); }
    // Its shape.
    [[nodiscard]] const PieceShape& shape(int piece) const {
        return *all_.shape(pieces_[static_cast<std::size_t>(piece)]);
    }
    // What presses on it, in the brick or beyond; what pierces its vessel.
    [[nodiscard]] ObstacleRange obstacles(int piece) const {
        return piece < 0 ? ObstacleRange{} : all_.obstacles_of(pieces_[static_cast<std::size_t>(piece)]);
    }
    [[nodiscard]] ObstacleRange piercing(int piece) const {
        return piece < 0 ? ObstacleRange{} : all_.piercing(pieces_[static_cast<std::size_t>(piece)]);
    }
    // Of two pieces: the closeness from which on they count as together, 0 for a near miss; -1: not apart.
    [[nodiscard]] float apart_from(int a, int b) const {
        return a < 0 || b < 0 ? -1.0F : matrix_[static_cast<std::size_t>(a * piece_count() + b)];
    }
    [[nodiscard]] bool apart(int a, int b) const { return apart_from(a, b) >= 0.0F; }
    // The pieces that one is in contact with: a bit each, in so many words.
    [[nodiscard]] std::size_t words() const { return (pieces_.size() + 63) / 64; }
    [[nodiscard]] std::span<const std::uint64_t> partners(int piece) const {
        return std::span(partner_bits_).subspan(static_cast<std::size_t>(piece) * words(), words());
    }

private:
    // Of pieces, by their numbers here.
    struct Pair {
        std::size_t first = 0, second = 0;
        float apart_from = 0.0F;
    };
    void number_segments(SegmentIndices list);

    const Pieces& all_;
    std::vector<std::uint32_t> pieces_; // of the list that have partners anywhere, ascending
    std::vector<Pair> pairs_;           // scratch
    std::vector<int> piece_of_;
    std::vector<float> matrix_;
    std::vector<std::uint64_t> partner_bits_; // words() of each piece
};

// Whether any of the segments is kept apart from something.
[[nodiscard]] bool any_apart(const Pieces& pieces, SegmentIndices list, std::vector<std::uint32_t>& scratch);

} // namespace ramus::field
