// Gaps: where two stretches of vessel run side by side with nothing between them, though a joint is near: the daughters
// of a fork that part at an acute angle. The gap opens so slowly that a mesh's cells are larger for a while.
#pragma once

#include "core/tree/contacts/along_tree.h"
#include "core/tree/contacts/links.h"

#include <cstdint>

namespace ramus::tree {

class Gaps {
public:
    // Links are looked at that come closer than `limit`.
    Gaps(const Links& links, double limit) : links_(links), along_(links, limit) {}

    // Whether the shortest way from the one link's axis to the other's leaves both to the side, and its middle is in no
    // vessel by which the tree leads from the one to the other. Fastest when asked of one `first` after the other.
    [[nodiscard]] bool between(std::uint32_t first, std::uint32_t second);

private:
    const Links& links_;
    AlongTree along_;
};

} // namespace ramus::tree
