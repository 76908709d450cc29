// Contacts: where two stretches of vessel press on each other without being connected there.
//
// Think of two walkers on the centerlines, each at a place of its own. The tubes touch where the closeness of the two
// places, axis distance over the sum of the radii, is below a limit. Where the walkers can get from there to one and
// the same place without ever being apart, the vessels are together: daughters of a fork near their joint, the inner
// side of a tight bend. Where they cannot, the touching is a contact.
//
// All pairs of links that come near each other are the places of such a pair of walkers. Those from which a joint can
// be reached below the limit at which a plain sum of kernels merges are left alone. What remains falls into islands. An
// island that goes below that limit itself is a contact (or below that of four vessels, where no joint can be reached
// at all: others may be near); how far apart the walkers have to be to get from it to a joint says from which closeness
// on the vessels count as together again. An island that stays above the limit, and from which no joint can be reached,
// is a near miss: nothing merges there, but cells of a mesh may be larger than the gap. So is, where a joint can be
// reached, what stays above the limit and lies side by side with an open gap between (gaps.h): daughters of a fork part
// without ever coming close again, but so slowly that a mesh would bridge the gap here and there. If one of
// these vessels also lies against another branch of the same joint, so close that a plain sum merges the two though a
// gap is open between their tubes, it is a fold: kept apart as a contact is, and not listed.
#pragma once

#include "core/tree/prepare.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace ramus::tree {

class Links;

// One of the two vessels of a contact.
struct ContactSide {
    std::vector<int> branches; // ids in the file's tree, ascending
    int branch = kNoBranch;    // where the two are closest
    glm::dvec3 at{0.0};        // on the centerline there, mm
    double radius = 0.0;       // there, mm
    double narrowed = 0.0;     // how much less of it is left toward the other vessel, mm
    double length = 0.0;       // of the centerlines along which the two are close, mm
};

struct Contact {
    std::array<ContactSide, 2> sides;
    double gap = 0.0;        // between the two tubes where they are closest, mm; negative: they overlap
    double closeness = 0.0;  // axis distance over the sum of the radii, there
    double apart_from = 0.0; // the closeness from which on the two count as together again
    [[nodiscard]] glm::dvec3 at() const { return 0.5 * (sides[0].at + sides[1].at); }
    // The axes cross, or nearly.
    [[nodiscard]] bool crossing() const { return closeness < 0.005; }
};

// How far the ends of a straight piece of axis count as moved, where walls are drawn, mm.
struct AxisMove {
    glm::vec3 start{0.0F}, end{0.0F};
    // The longest anywhere on the piece.
    [[nodiscard]] double most() const { return std::max(glm::length(glm::dvec3(start)), glm::length(glm::dvec3(end))); }
    // So far along the piece, 0 at its start and 1 at its end.
    [[nodiscard]] glm::dvec3 at(double share) const { return glm::mix(glm::dvec3(start), glm::dvec3(end), share); }
    bool operator==(const AxisMove&) const = default;
};

struct Contacts {
    // A piece of vessel that another one is kept apart from.
    struct Partner {
        std::uint32_t piece = 0;
        float apart_from = 0.0F; // of the contact or fold; 0: a near miss
        bool parting = false;    // of two that part at a joint nearby: toward it their surfaces meet
        bool operator==(const Partner&) const = default;
    };

    std::vector<Contact> list; // the closest first
    // Segments of the file's tree are taken together to short pieces. Partners of each, ascending; symmetric.
    std::vector<std::uint32_t> piece_of_segment;
    std::vector<std::uint32_t> first_partner; // by piece, and one past the last
    std::vector<Partner> partners;
    std::vector<AxisMove> moves; // by piece; empty where all axes count as they are

    [[nodiscard]] std::span<const Partner> partners_of(std::uint32_t piece) const {
        return std::span(partners).subspan(first_partner[piece], first_partner[piece + 1] - first_partner[piece]);
    }
    [[nodiscard]] AxisMove move_of(std::uint32_t piece) const { return moves.empty() ? AxisMove{} : moves[piece]; }
    [[nodiscard]] bool empty() const { return partners.empty(); }
};

// Closenesses that depend on the kernel: the higher, the farther it blends.
struct ContactLimits {
    double merged = 0.0;  // two equal parallel vessels merge below this
    double bundled = 0.0; // four of them
    double reach = 0.0;   // beyond, one changes nothing at the other's surface
    bool operator==(const ContactLimits&) const = default;
};
// Of the Gaussian (core/field/kernels/gaussian.h): sqrt(1 + 1 / width) and so on, 1.0954 at width 5.
[[nodiscard]] ContactLimits limits_of_gaussian(double width);

[[nodiscard]] Contacts find_contacts(const PreparedTree& prepared, const ContactLimits& limits);
// The same with the links of that tree, which depend on no limits.
[[nodiscard]] Contacts find_contacts(const PreparedTree& prepared, const Links& links, const ContactLimits& limits);

} // namespace ramus::tree
