// LocalContacts: which of the segments that reach a brick are kept apart.
#pragma once

#include "core/field/apart/pieces.h"
#include "core/field/brick_field.h"

#include <cstdint>
#include <span>
#include <vector>

namespace ramus::field {

// Of a piece toward another one.
struct PieceRelation {
    float apart_from = -1.0F; // the closeness from which on they count as together, 0 for a near miss; -1: not apart
    glm::vec3 aside{0.0F};    // how far its axis counts as moved where the wall is drawn, mm
};

// What presses on a piece, in the brick or beyond it.
struct Obstacle {
    const PieceShape* shape = nullptr;
    PieceRelation relation; // of the piece toward it; it is moved aside the other way
};

class LocalContacts {
public:
    explicit LocalContacts(const Pieces& pieces) : all_(pieces) {}

    // Whether any of the segments is kept apart from something. Only then the rest may be asked.
    bool enter(SegmentIndices list);

    // Of the n-th segment of the list: the number of its piece among those with partners here, or -1.
    [[nodiscard]] int piece(std::size_t n) const { return piece_of_[n]; }
    [[nodiscard]] int piece_count() const { return static_cast<int>(pieces_.size()); }
    // Of two pieces, the first toward the second.
    [[nodiscard]] const PieceRelation& relation(int a, int b) const {
        return a < 0 || b < 0 ? kNone : matrix_[static_cast<std::size_t>(a * piece_count() + b)];
    }
    [[nodiscard]] std::span<const Obstacle> obstacles(int piece) const {
        if (piece < 0) return {};
        const auto p = static_cast<std::size_t>(piece);
        return std::span(obstacles_).subspan(first_obstacle_[p], first_obstacle_[p + 1] - first_obstacle_[p]);
    }
    // The pieces that one is in contact with: a bit each, in so many words.
    [[nodiscard]] std::size_t words() const { return (pieces_.size() + 63) / 64; }
    [[nodiscard]] std::span<const std::uint64_t> partners(int piece) const {
        return std::span(partner_bits_).subspan(static_cast<std::size_t>(piece) * words(), words());
    }
    [[nodiscard]] bool apart(int a, int b) const { return relation(a, b).apart_from >= 0.0F; }

private:
    const Pieces& all_;
    std::vector<std::uint32_t> pieces_; // of the list that have partners in it or obstacles, ascending
    std::vector<std::uint32_t> listed_; // scratch: all of the list that have partners anywhere
    std::vector<int> piece_of_;
    std::vector<PieceRelation> matrix_;
    std::vector<std::uint64_t> partner_bits_; // words() of each piece
    std::vector<std::size_t> first_obstacle_; // by piece, and one past the last
    std::vector<Obstacle> obstacles_;
    static constexpr PieceRelation kNone{};
};

// Whether any of the segments is kept apart from something.
[[nodiscard]] bool any_apart(const Pieces& pieces, SegmentIndices list, std::vector<std::uint32_t>& scratch);

} // namespace ramus::field
