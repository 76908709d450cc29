// Boxes around links as far as they may touch others: the links in Morton order, eight to a leaf, eight boxes to one of
// the next level. Boxes are in single precision and a little too large.
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

    // Links touch where their closeness is below `limit`.
    LinkBoxes(const Links& links, double limit);

    [[nodiscard]] std::size_t leaves() const { return levels_.front().size(); }
    // The links of a leaf are at the places from kFan * leaf on, and so many.
    [[nodiscard]] std::size_t size() const { return order_.size(); }
    [[nodiscard]] std::uint32_t link(std::size_t place) const { return order_[place]; }
    // The leaves from `leaf` on whose boxes meet its box, itself too, ascending.
    void find_beside(std::size_t leaf, std::vector<std::uint32_t>& beside) const;
    // Which links of a leaf have a box that meets that of the link at `place`: a bit each.
    [[nodiscard]] unsigned meeting(std::size_t leaf, std::size_t place) const {
        return levels_.front()[leaf].meeting(levels_.front()[place / kFan].box(place % kFan));
    }

private:
    using Box = EightBoxes::Box;

    void sort_by_place(const std::vector<Box>& boxes);
    void descend(std::size_t level, std::size_t n, std::size_t leaf, const Box& box,
                 std::vector<std::uint32_t>& beside) const;

    std::vector<std::uint32_t> order_;            // links in Morton order
    std::vector<std::vector<EightBoxes>> levels_; // the first: of links; the last: one
};

} // namespace ramus::tree
