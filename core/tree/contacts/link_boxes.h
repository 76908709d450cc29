// Boxes around links as far as they may touch others: the links in Morton order, eight to a leaf, eight boxes to one of
// the next level. Boxes are in single precision and a little too large.
#pragma once

#include "core/base/bounds.h"
#include "core/tree/contacts/links.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace ramus::tree {

class LinkBoxes {
public:
    static constexpr std::size_t kFan = 8;

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
    using Box = Bounds<glm::vec3>;
    // Side by side, so that they are tested by vectors.
    struct Eight {
        std::array<std::array<float, kFan>, 3> least, most;

        Eight();
        void set(std::size_t n, const Box& box);
        [[nodiscard]] Box box(std::size_t n) const;
        [[nodiscard]] Box around() const;
        [[nodiscard]] unsigned meeting(const Box& box) const;
    };

    void sort_by_place(const std::vector<Box>& boxes);
    void descend(std::size_t level, std::size_t n, std::size_t leaf, const Box& box,
                 std::vector<std::uint32_t>& beside) const;

    std::vector<std::uint32_t> order_;       // links in Morton order
    std::vector<std::vector<Eight>> levels_; // the first: of links; the last: one
};

} // namespace ramus::tree
