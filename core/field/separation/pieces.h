// Pieces: the short stretches of vessel that have partners (core/tree/contacts/contacts.h), with their shapes and the
// obstacles that cast shadows on them. Lengths are in mm.
#pragma once

#include "core/field/kernel.h"
#include "core/field/separation/axes.h"
#include "core/field/skeleton.h"
#include "core/tree/contacts/contacts.h"

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace ramus::field {

// A straight piece of vessel with linear radius, mm.
struct PieceShape {
    glm::dvec3 start{0.0}, end{0.0};
    double start_radius = 0.0, end_radius = 0.0;
    tree::AxisMove move; // of its axis where walls are drawn
    bool operator==(const PieceShape&) const = default;
};

class Pieces {
public:
    static constexpr std::uint32_t kNone = 0xFFFFFFFFU;

    // Keeps a reference to `contacts`, which must outlive this object.
    Pieces(const tree::Contacts& contacts, const Skeleton& skeleton, const Kernel& kernel);

    [[nodiscard]] const tree::Contacts& contacts() const { return contacts_; }
    [[nodiscard]] std::uint32_t of_segment(std::uint32_t segment) const { return contacts_.piece_of_segment[segment]; }
    // The segment's piece if it has partners, else kNone.
    [[nodiscard]] std::uint32_t partnered(std::uint32_t segment) const { return partnered_[segment]; }
    // The shape of a piece with partners; null for other pieces, and where the branch is hidden.
    [[nodiscard]] const PieceShape* shape(std::uint32_t piece) const {
        const std::uint32_t at = shape_of_piece_.empty() ? kNone : shape_of_piece_[piece];
        return at == kNone ? nullptr : &shapes_[at];
    }
    // The obstacles of a piece: partners in contact that may cast a shadow on it. An obstacle is piercing if it is so
    // thin and so near to the piece's axis that the vessel may continue behind it, beyond the support of the obstacle.
    [[nodiscard]] const ObstacleRows& obstacles() const { return obstacles_; }
    [[nodiscard]] ObstacleRange obstacles_of(std::uint32_t piece) const { return ranges_of(piece).all; }
    [[nodiscard]] ObstacleRange piercing(std::uint32_t piece) const { return ranges_of(piece).piercing; }
    // Whether the piece has the same shape and the same partners with the same shapes as in an earlier state.
    [[nodiscard]] bool same_around(std::uint32_t piece, const Pieces& before) const;

private:
    struct Ranges {
        ObstacleRange all, piercing; // piercing obstacles come first
    };
    [[nodiscard]] Ranges ranges_of(std::uint32_t piece) const {
        const std::uint32_t at = shape_of_piece_.empty() ? kNone : shape_of_piece_[piece];
        return at == kNone ? Ranges{} : ranges_[at];
    }
    void list_obstacles(const Kernel& kernel);
    void put_obstacle(std::size_t at, const tree::Contacts::Partner& partner, double least_distance);

    const tree::Contacts& contacts_;
    std::vector<std::uint32_t> partnered_; // by segment
    std::vector<std::uint32_t> shape_of_piece_;
    std::vector<PieceShape> shapes_;
    std::vector<std::uint32_t> piece_of_shape_;
    std::vector<Ranges> ranges_; // by shape
    ObstacleRows obstacles_;
};

} // namespace ramus::field
