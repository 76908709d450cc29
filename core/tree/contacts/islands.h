// Islands: connected sets of pairs of touching links that are kept apart (contacts.h has the rule): contacts, near
// misses, gaps between daughters of a fork, and folds.
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
    bool contact = false; // a contact, not a near miss
    bool parting = false; // a gap between daughters of a fork, from which a joint can be reached, or a fold
    // Contact: the closeness from which a joint can be reached, at most ContactLimits::reach. Fold:
    // ContactLimits::reach. Gap between daughters: 0.
    double apart_from = 0.0;
};

struct Islands {
    std::vector<Island> all;
};

[[nodiscard]] Islands find_islands(const Links& links, const TouchingLinks& touching, const ContactLimits& limits,
                                   const LargeAllocator<std::byte>& memory = {});

} // namespace ramus::tree
