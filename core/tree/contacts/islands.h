// Islands: pairs of links that touch and from which no joint can be reached without coming apart, and those with an
// open gap between them (contacts.h).
#pragma once

#include "core/tree/contacts/contacts.h"
#include "core/tree/contacts/links.h"
#include "core/tree/contacts/touching_links.h"

#include <array>
#include <cstdint>
#include <vector>

namespace ramus::tree {

// A link of the one vessel and one of the other.
struct OrientedPair {
    std::array<std::uint32_t, 2> link{};
};

struct Island {
    std::vector<OrientedPair> pairs;
    bool contact = false; // else a near miss
    bool parting = false; // a near miss from which a joint can be reached, or a fold
    // Of a contact: the closeness from which on a joint can be reached, the limit of reach at most. Of a fold the limit
    // of reach, of other partings 0.
    double apart_from = 0.0;
};

struct Islands {
    std::vector<Island> all;
};

[[nodiscard]] Islands find_islands(const Links& links, const TouchingLinks& touching, const ContactLimits& limits);

} // namespace ramus::tree
