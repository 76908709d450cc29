// TouchingLinks: all pairs of links of a tree that come close without being neighbours along the tree. Uses a
// bounding-volume hierarchy and all threads; the result does not depend on the number of threads.
#pragma once

#include "core/base/grouped.h"
#include "core/base/large_array.h"
#include "core/tree/contacts/links.h"

#include <cstddef>
#include <cstdint>

namespace ramus::tree {

class TouchingLinks {
public:
    struct Other {
        std::uint32_t link = 0; // the link with the higher number of the pair
        float closeness = 0.0F;
    };
    static constexpr std::uint32_t kNone = 0xFFFFFFFFU;

    // Finds all pairs whose closeness (closest_approach()) is below `limit`. Leaves out pairs that share a point. Also
    // leaves out most pairs for which a walk along the tree leads from one link to the other and stays closer than
    // `together` to the first link. These neighbours along a vessel are nearly all close pairs of a tree.
    TouchingLinks(const Links& links, double limit, double together, const LargeAllocator<std::byte>& memory = {});

    // Pairs have the numbers 0 to size() - 1. Pairs with the same lower link are consecutive.
    [[nodiscard]] std::size_t size() const { return others_.all().size(); }
    [[nodiscard]] std::uint32_t first(std::size_t link) const { return others_.first(link); }
    [[nodiscard]] const Other& other(std::size_t pair) const { return others_.all()[pair]; }
    // The pair of two links, or kNone.
    [[nodiscard]] std::uint32_t find(std::uint32_t a, std::uint32_t b) const;

private:
    Grouped<Other> others_; // by lower link, ascending by the higher link
};

} // namespace ramus::tree
