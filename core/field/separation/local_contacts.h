// LocalContacts: the contacts among the segments that reach one brick, as a matrix of pieces.
//
// A piece is a short run of segments (core/tree/contacts/contacts.h). Pieces of the brick that have partners anywhere
// in the tree get local numbers, from 0. Every other segment has the piece -1.
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

    // Begins a brick. Returns whether any two of its segments are kept apart, or any is pierced by an obstacle. If not,
    // no other function may be called.
    bool enter(SegmentIndices list);
    [[nodiscard]] const Pieces& all() const { return all_; }

    // The local number of the piece of the n-th segment of the list, or -1. Whether it is -1 depends on the tree alone,
    // so bricks that share a point agree, whichever partners reach them.
    [[nodiscard]] int piece(std::size_t n) const { return piece_of_[n]; }
    [[nodiscard]] int piece_count() const { return static_cast<int>(pieces_.size()); }
    [[nodiscard]] const PieceShape& shape(int piece) const {
        return *all_.shape(pieces_[static_cast<std::size_t>(piece)]);
    }
    // The obstacles of a piece (Pieces::obstacles_of() and piercing()), in the brick or beyond.
    [[nodiscard]] ObstacleRange obstacles(int piece) const {
        return piece < 0 ? ObstacleRange{} : all_.obstacles_of(pieces_[static_cast<std::size_t>(piece)]);
    }
    [[nodiscard]] ObstacleRange piercing(int piece) const {
        return piece < 0 ? ObstacleRange{} : all_.piercing(pieces_[static_cast<std::size_t>(piece)]);
    }
    // The closeness from which two pieces count as together; 0 for a near miss, -1 for pieces that are not kept apart.
    [[nodiscard]] float apart_from(int a, int b) const {
        return a < 0 || b < 0 ? -1.0F : matrix_[static_cast<std::size_t>(a * piece_count() + b)];
    }
    [[nodiscard]] bool apart(int a, int b) const { return apart_from(a, b) >= 0.0F; }
    // The pieces that `piece` is in contact with, near misses excluded: a bit set of words() words.
    [[nodiscard]] std::size_t words() const { return (pieces_.size() + 63) / 64; }
    [[nodiscard]] std::span<const std::uint64_t> partners(int piece) const {
        return std::span(partner_bits_).subspan(static_cast<std::size_t>(piece) * words(), words());
    }

private:
    // Two partners, by local number.
    struct Pair {
        std::size_t first = 0, second = 0;
        float apart_from = 0.0F;
    };
    void number_segments(SegmentIndices list);

    const Pieces& all_;
    std::vector<std::uint32_t> pieces_; // by local number: the piece in Pieces, ascending
    std::vector<Pair> pairs_;           // scratch
    std::vector<int> piece_of_;
    std::vector<float> matrix_;
    std::vector<std::uint64_t> partner_bits_; // words() for each piece
};

// The return value of enter() for a list of segments. `scratch` is overwritten.
[[nodiscard]] bool any_apart(const Pieces& pieces, SegmentIndices list, std::vector<std::uint32_t>& scratch);

} // namespace ramus::field
