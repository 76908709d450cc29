// Contacts: finds the places where two stretches of vessel touch without being connected there.
//
// Input: a prepared tree (mm) and limits on the closeness of two places of its centerlines, which is their distance
// divided by the sum of their radii. Output: the list of contacts, and for each short piece of vessel its partners, the
// pieces that it is kept apart from. The result depends on centerlines and radii only, not on any surface.
//
// The rule: imagine two walkers, one on each centerline. If both can walk along the tree to a common place while their
// closeness stays below a limit, the vessels are together there. Examples are daughters of a fork near their joint, and
// the inner side of a tight bend. Otherwise the touching is a contact.
//
// A pair of links that come near each other is one state of the two walkers. Pairs from which a joint can be reached
// below `merged` are together. The other pairs form islands:
// - An island with a closeness below `merged` is a contact. If no joint can be reached from it at all, `bundled` is the
//   limit, since other vessels may be near. `apart_from` is the largest closeness on the best way to a joint.
// - An island above the limit from which no joint can be reached is a near miss. The plain sum does not merge it, but
//   the cells of a mesh may be larger than its gap.
// - Daughters of a fork may diverge so slowly that a mesh would bridge the gap between them (gaps.h). Pairs with such
//   an open gap count as near misses, too, although a joint can be reached.
// - If one of these daughters also lies so close to another branch of the same joint that the plain sum merges the two,
//   although a gap is open between their tubes, the pairs are a fold. A fold is kept apart as a contact is, and not
//   listed.
// core/field/separation/README.md explains how the field and the polygonizer use the result.
#pragma once

#include "core/base/large_array.h"
#include "core/tree/prepare.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace ramus::tree {

// One of the two vessels of a contact.
struct ContactSide {
    std::vector<int> branches; // ids in the file's tree, ascending
    int branch = kNoBranch;    // where the two are closest
    glm::dvec3 at{0.0};        // on the centerline there, mm
    double radius = 0.0;       // there, mm
    double narrowed = 0.0;     // how much of the radius the wall takes away toward the other vessel, mm
    double length = 0.0;       // of the centerlines along which the two are close, mm
};

struct Contact {
    std::array<ContactSide, 2> sides;
    double gap = 0.0;        // between the two tubes where they are closest, mm; negative: they overlap
    double closeness = 0.0;  // the least closeness
    double apart_from = 0.0; // the closeness from which the two count as together again
    [[nodiscard]] glm::dvec3 at() const { return 0.5 * (sides[0].at + sides[1].at); }
    // The axes cross, or nearly.
    [[nodiscard]] bool crossing() const { return closeness < 0.005; }
};

// How far (mm) the two ends of a straight piece of axis are moved for the decision where walls lie (spread_axes.h).
struct AxisMove {
    glm::vec3 start{0.0F}, end{0.0F};
    // The length of the largest move on the piece.
    [[nodiscard]] double most() const { return std::max(glm::length(glm::dvec3(start)), glm::length(glm::dvec3(end))); }
    // The move at a share of the piece: 0 at its start, 1 at its end.
    [[nodiscard]] glm::dvec3 at(double share) const { return glm::mix(glm::dvec3(start), glm::dvec3(end), share); }
    bool operator==(const AxisMove&) const = default;
};

struct Contacts {
    // A piece of vessel that another one is kept apart from.
    struct Partner {
        std::uint32_t piece = 0;
        float apart_from = 0.0F; // of the contact or fold; 0: a near miss
        bool parting = false;    // the two diverge at a joint nearby, toward which their surfaces meet
        bool operator==(const Partner&) const = default;
    };

    std::vector<Contact> list; // the closest first
    // Consecutive segments of the file's tree form short pieces, one for each link (links.h). The partners of a piece
    // are ascending, and the relation is symmetric.
    std::vector<std::uint32_t> piece_of_segment;
    std::vector<std::uint32_t> first_partner; // by piece: offset into `partners`, and the end
    std::vector<Partner> partners;
    std::vector<AxisMove> moves; // by piece; empty if no axis is moved

    [[nodiscard]] std::span<const Partner> partners_of(std::uint32_t piece) const {
        return std::span(partners).subspan(first_partner[piece], first_partner[piece + 1] - first_partner[piece]);
    }
    [[nodiscard]] AxisMove move_of(std::uint32_t piece) const { return moves.empty() ? AxisMove{} : moves[piece]; }
    [[nodiscard]] bool empty() const { return partners.empty(); }
};

// Limits on closeness, which follow from the kernel. They are larger for kernels that blend over longer distances.
struct ContactLimits {
    double merged = 0.0;  // two equal parallel vessels merge below this closeness
    double bundled = 0.0; // four equal parallel vessels merge below this closeness
    double reach = 0.0;   // beyond this closeness a vessel does not change the surface of the other one
    bool operator==(const ContactLimits&) const = default;
};
// The limits of the Gaussian (core/field/kernels/gaussian.h): `merged` is sqrt(1 + 1 / width), 1.0954 at width 5.
[[nodiscard]] ContactLimits limits_of_gaussian(double width);

// `memory`: for what the search keeps of pairs that come near each other, 65 bytes for each, and of boxes, 30 bytes for
// each segment.
[[nodiscard]] Contacts find_contacts(const PreparedTree& prepared, const ContactLimits& limits,
                                     const LargeAllocator<std::byte>& memory = {});

} // namespace ramus::tree
