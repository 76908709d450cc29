// LinkBoxes: a bounding-volume hierarchy over links, to find pairs that may touch. Links are sorted in Morton order,
// eight to a leaf; every node has eight children. Boxes contain the tubes of the links, enlarged by the limit of
// closeness. They are in single precision and rounded outward.
#pragma once

#include "core/base/box_tree.h"
#include "core/tree/contacts/links.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace ramus::tree {

class LinkBoxes {
public:
    static constexpr std::size_t kFan = EightBoxes::kCount;

    // Two links touch if their closeness is below `limit`.
    LinkBoxes(const Links& links, double limit, const LargeAllocator<std::byte>& memory = {});

    [[nodiscard]] std::size_t leaves() const { return tree_.levels().front().size(); }
    // Leaf n holds the places kFan * n to kFan * n + kFan - 1, as far as they are below size().
    [[nodiscard]] std::size_t size() const { return order_.size(); }
    [[nodiscard]] std::uint32_t link(std::size_t place) const { return order_[place]; }
    // Lists the leaves with a number >= `leaf` whose boxes intersect the box of `leaf`, itself included, ascending.
    void find_beside(std::size_t leaf, std::vector<std::uint32_t>& beside) const;
    // One bit for each link of a leaf: whether its box intersects the box of the link at `place`.
    [[nodiscard]] unsigned meeting(std::size_t leaf, std::size_t place) const {
        return tree_.levels().front()[leaf].meeting(tree_.box(place));
    }

private:
    LargeArray<std::uint32_t> order_; // links in Morton order
    BoxTree tree_;
};

} // namespace ramus::tree
