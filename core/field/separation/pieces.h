// Pieces: the stretches of vessel that others are kept apart from (core/tree/contacts/contacts.h), with their shapes
// and what presses on them.
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
    tree::AxisMove move; // as its axis counts where walls are drawn
    bool operator==(const PieceShape&) const = default;
};

class Pieces {
public:
    static constexpr std::uint32_t kNone = 0xFFFFFFFFU;

    // Refers to the contacts, which must outlive it.
    Pieces(const tree::Contacts& contacts, const Skeleton& skeleton, const Kernel& kernel);

    [[nodiscard]] const tree::Contacts& contacts() const { return contacts_; }
    [[nodiscard]] std::uint32_t of_segment(std::uint32_t segment) const { return contacts_.piece_of_segment[segment]; }
    // The same where the piece has partners, or kNone.
    [[nodiscard]] std::uint32_t partnered(std::uint32_t segment) const { return partnered_[segment]; }
    // Of a piece that has partners: nothing where its branch is not there.
    [[nodiscard]] const PieceShape* shape(std::uint32_t piece) const {
        const std::uint32_t at = shape_of_piece_.empty() ? kNone : shape_of_piece_[piece];
        return at == kNone ? nullptr : &shapes_[at];
    }
    // What may cut off places of a piece that is there; and of this what pierces its vessel: so thin and so near to the
    // axis that there may be places of the vessel behind it which it does not reach itself.
    [[nodiscard]] const ObstacleRows& obstacles() const { return obstacles_; }
    [[nodiscard]] ObstacleRange obstacles_of(std::uint32_t piece) const { return ranges_of(piece).all; }
    [[nodiscard]] ObstacleRange piercing(std::uint32_t piece) const { return ranges_of(piece).piercing; }
    // Whether the piece has the same partners in another state, in the same places.
    [[nodiscard]] bool same_around(std::uint32_t piece, const Pieces& before) const;

private:
    struct Ranges {
        ObstacleRange all, piercing; // the piercing ones come first
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
