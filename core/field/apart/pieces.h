// Pieces: the stretches of vessel that others are kept apart from (core/tree/contacts/contacts.h), with their shapes.
#pragma once

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
    bool operator==(const PieceShape&) const = default;
};

class Pieces {
public:
    // Refers to the contacts, which must outlive it.
    Pieces(const tree::Contacts& contacts, const Skeleton& skeleton);

    [[nodiscard]] const tree::Contacts& contacts() const { return contacts_; }
    [[nodiscard]] std::uint32_t of_segment(std::uint32_t segment) const { return contacts_.piece_of_segment[segment]; }
    // Of a piece that has partners: nothing where its branch is not there.
    [[nodiscard]] const PieceShape* shape(std::uint32_t piece) const {
        const std::uint32_t at = shape_of_piece_.empty() ? kNone : shape_of_piece_[piece];
        return at == kNone ? nullptr : &shapes_[at];
    }
    // Whether the piece has the same partners in another state, in the same places.
    [[nodiscard]] bool same_around(std::uint32_t piece, const Pieces& before) const;
    // Whether a vessel that is there presses on the piece.
    [[nodiscard]] bool in_contact(std::uint32_t piece) const;

private:
    static constexpr std::uint32_t kNone = 0xFFFFFFFFU;
    const tree::Contacts& contacts_;
    std::vector<std::uint32_t> shape_of_piece_;
    std::vector<PieceShape> shapes_;
};

} // namespace ramus::field
