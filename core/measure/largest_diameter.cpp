#include "core/measure/largest_diameter.h"

#include "core/base/halved_boxes.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <queue>
#include <utility>
#include <vector>

namespace ramus::measure {

namespace {

// Two nodes, and the square of the greatest distance that points of them can have.
struct NodePair {
    double bound;
    std::uint32_t a, b;
    bool operator<(const NodePair& other) const { return bound < other.bound; }
};

NodePair node_pair(const std::vector<BoxNode>& nodes, std::uint32_t a, std::uint32_t b) {
    const auto &one = nodes[a].box, &other = nodes[b].box;
    const glm::dvec3 reach = glm::max(one.most - other.least, other.most - one.least);
    return {glm::dot(reach, reach), a, b};
}

} // namespace

double largest_diameter(std::span<const glm::vec3> points) {
    const HalvedBoxes tree = halved_boxes(
        static_cast<std::uint32_t>(points.size()),
        [&](Bounds<glm::dvec3>& box, std::uint32_t point) { box.hold(glm::dvec3(points[point])); },
        [&](std::uint32_t point, int axis) { return static_cast<double>(points[point][axis]); });
    if (tree.nodes.empty()) return 0.0;
    const auto diagonal = [&](std::uint32_t node) { return glm::length(tree.nodes[node].box.size()); };
    double best = 0.0; // squared
    std::priority_queue<NodePair> open;
    const auto add = [&](std::uint32_t a, std::uint32_t b) {
        if (const NodePair pair = node_pair(tree.nodes, a, b); pair.bound > best) open.push(pair);
    };
    add(0, 0);
    while (!open.empty() && open.top().bound > best) {
        auto [bound, a, b] = open.top();
        open.pop();
        if (tree.nodes[a].count == 0 && (tree.nodes[b].count > 0 || diagonal(a) >= diagonal(b)))
            std::swap(a, b); // divides b
        const BoxNode &one = tree.nodes[a], &divided = tree.nodes[b];
        if (divided.count == 0) {
            if (a == b) { // both are divided
                add(b + 1, b + 1);
                add(b + 1, divided.first);
                add(divided.first, divided.first);
            } else {
                add(a, b + 1);
                add(a, divided.first);
            }
            continue;
        }
        for (std::uint32_t i = one.first; i < one.first + one.count; ++i)
            for (std::uint32_t j = divided.first; j < divided.first + divided.count; ++j) {
                const glm::dvec3 between = glm::dvec3(points[tree.order[i]]) - glm::dvec3(points[tree.order[j]]);
                best = std::max(best, glm::dot(between, between));
            }
    }
    return std::sqrt(best);
}

} // namespace ramus::measure
