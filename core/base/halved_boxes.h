// HalvedBoxes: a binary bounding-volume hierarchy over numbered things in any order. Each node is split at the median
// along the longest side of its box. For things that are already in spatial order, BoxTree (box_tree.h) is faster.
#pragma once

#include "core/base/bounds.h"

#include <algorithm>
#include <cstdint>
#include <glm/vec3.hpp>
#include <numeric>
#include <vector>

namespace ramus {

struct BoxNode {
    Bounds<glm::dvec3> box;
    std::uint32_t first =
        0; // leaf: index of its first thing in `order`; else its second child. The first child is next
    std::uint32_t count = 0; // things of a leaf; 0: not a leaf
};

struct HalvedBoxes {
    std::vector<BoxNode> nodes;       // the top node first; empty: there are no things
    std::vector<std::uint32_t> order; // the numbers of the things, leaf by leaf
};

// Builds the hierarchy of `count` things. hold(box, thing) grows a box around a thing. middle(thing, axis) is the key
// of the median split, as a rule the coordinate of the thing's centre.
template <class Hold, class Middle>
HalvedBoxes halved_boxes(std::uint32_t count, const Hold& hold, const Middle& middle) {
    constexpr std::uint32_t kLeaf = 4; // tuned on triangles: 1 and 2 are no quicker
    struct Part {
        std::uint32_t first, count;
        std::int64_t second_of; // the node whose second child this is; -1: a first child
    };
    HalvedBoxes tree;
    tree.order.resize(count);
    std::iota(tree.order.begin(), tree.order.end(), 0U);
    std::vector<Part> open;
    if (count > 0) open.push_back({0, count, -1});
    while (!open.empty()) {
        const Part part = open.back();
        open.pop_back();
        if (part.second_of >= 0)
            tree.nodes[static_cast<std::size_t>(part.second_of)].first = static_cast<std::uint32_t>(tree.nodes.size());
        const bool leaf = part.count <= kLeaf;
        BoxNode node{{}, part.first, leaf ? part.count : 0};
        const auto begin = tree.order.begin() + part.first, end = begin + part.count;
        for (auto thing = begin; thing != end; ++thing) hold(node.box, *thing);
        const auto at = static_cast<std::int64_t>(tree.nodes.size());
        tree.nodes.push_back(node);
        if (leaf) continue;
        const glm::dvec3 size = node.box.size();
        const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
        const std::uint32_t half = part.count / 2;
        std::nth_element(begin, begin + half, end, [&](std::uint32_t a, std::uint32_t b) {
            const double x = middle(a, axis), y = middle(b, axis);
            return x < y || (x == y && a < b);
        });
        open.push_back({part.first + half, part.count - half, at});
        open.push_back({part.first, half, -1});
    }
    return tree;
}

} // namespace ramus
