// LinkBoxes: a bounding-volume hierarchy over links, to find pairs that may touch. Links are sorted in Morton order,
// eight to a leaf; every node has eight children. Boxes contain the tubes of the links, enlarged by the limit of
// closeness. They are in single precision and rounded outward.
#pragma once

#include "core/base/eight_boxes.h"
#include "core/tree/contacts/links.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace ramus::tree {

class LinkBoxes {
public:
    static constexpr std::size_t kFan = EightBoxes::kCount;

    // Two links touch if their closeness is below `limit`.
    LinkBoxes(const Links& links, double limit);

    [[nodiscard]] std::size_t leaves() const { return levels_.front().size(); }
    // Leaf n holds the places kFan * n to kFan * n + kFan - 1, as far as they are below size().
    [[nodiscard]] std::size_t size() const { return order_.size(); }
    [[nodiscard]] std::uint32_t link(std::size_t place) const { return order_[place]; }
    // Lists the leaves with a number >= `leaf` whose boxes intersect the box of `leaf`, itself included, ascending.
    void find_beside(std::size_t leaf, std::vector<std::uint32_t>& beside) const;
    // One bit for each link of a leaf: whether its box intersects the box of the link at `place`.
    [[nodiscard]] unsigned meeting(std::size_t leaf, std::size_t place) const {
        return levels_.front()[leaf].meeting(levels_.front()[place / kFan].box(place % kFan));
    }

private:
    using Box = EightBoxes::Box;

    void sort_by_place(const std::vector<Box>& boxes);
    void descend(std::size_t level, std::size_t n, std::size_t leaf, const Box& box,
                 std::vector<std::uint32_t>& beside) const;

    std::vector<std::uint32_t> order_;            // links in Morton order
    std::vector<std::vector<EightBoxes>> levels_; // from the boxes of links to the single top node
};

} // namespace ramus::tree
