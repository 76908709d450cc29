// Gaps: detects an open gap between two links near a joint, as between the daughters of a fork that diverge at an acute
// angle. There the cells of a mesh are larger than the gap for a while.
#pragma once

#include "core/tree/contacts/along_tree.h"
#include "core/tree/contacts/links.h"

#include <cstdint>

namespace ramus::tree {

class Gaps {
public:
    // `limit`: vessel between two links is searched along the tree from the first link, as far as AlongTree with this
    // limit goes.
    Gaps(const Links& links, double limit) : links_(links), along_(links, limit) {}

    // Whether the two links lie side by side (the shortest way between their axes is nearly perpendicular to both) and
    // the middle of that way is outside of all vessel that lies along the tree near `first`. Fast for consecutive calls
    // with the same `first`.
    [[nodiscard]] bool between(std::uint32_t first, std::uint32_t second);

private:
    const Links& links_;
    AlongTree along_;
};

} // namespace ramus::tree
