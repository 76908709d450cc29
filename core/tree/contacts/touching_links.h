// Pairs of links that come close, but for those that are together along the tree: all of a tree's, found with a tree of
// boxes.
#pragma once

#include "core/base/grouped.h"
#include "core/tree/contacts/links.h"

#include <cstdint>
#include <vector>

namespace ramus::tree {

class TouchingLinks {
public:
    struct Other {
        std::uint32_t link = 0; // of the higher number
        float closeness = 0.0F;
    };
    static constexpr std::uint32_t kNone = 0xFFFFFFFFU;

    // All pairs whose closeness (closest_approach()) is below `limit`. Left out are those that share a point, and most
    // of those where one can walk from the one link to the other, along the tree, and stays closer than `together` to
    // the one all the way: nearly all pairs of a tree are neighbours along a vessel.
    TouchingLinks(const Links& links, double limit, double together);

    // Pairs are numbered from 0 to size(), those of a link side by side.
    [[nodiscard]] std::size_t size() const { return others_.size(); }
    [[nodiscard]] std::uint32_t first(std::size_t link) const { return first_[link]; }
    [[nodiscard]] const Other& other(std::size_t pair) const { return others_[pair]; }
    // The pair of two links, or kNone.
    [[nodiscard]] std::uint32_t find(std::uint32_t a, std::uint32_t b) const;

private:
    std::vector<std::uint32_t> first_; // of each link's pairs with links of higher numbers, which are ascending
    std::vector<Other> others_;
};

} // namespace ramus::tree
