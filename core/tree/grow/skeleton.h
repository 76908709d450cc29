// The straight tree that growth works on: nodes with a parent, and how much blood each carries. Node i stands also for
// the segment from its parent to it; node 0 is the root. After growth every inner node but the root has two children
// (three at the one fork that makes an even number of branches), so a segment is a branch.
#pragma once

#include "core/tree/grow/exact_math.h"

#include <array>
#include <vector>

namespace ramus::tree::growth {

struct Node {
    Vec position{0.0};
    int parent = -1;
    std::array<int, 3> children{-1, -1, -1};
    int child_count = 0;
    double flow = 0.0;  // sum of the terminals' flows that pass through
    double width = 0.0; // cube root of flow: Murray's law makes radii proportional to it
};

struct Skeleton {
    std::vector<Node> nodes;
    double root_radius_mm = 0.0;

    [[nodiscard]] Node& at(int node) { return nodes[static_cast<std::size_t>(node)]; }
    [[nodiscard]] const Node& at(int node) const { return nodes[static_cast<std::size_t>(node)]; }
    [[nodiscard]] int size() const { return static_cast<int>(nodes.size()); }
    [[nodiscard]] double radius_scale() const { return root_radius_mm / nodes.front().width; }
    [[nodiscard]] double radius_mm(int node) const { return radius_scale() * at(node).width; }
    [[nodiscard]] double length_mm(int node) const {
        return glm::length(at(node).position - at(at(node).parent).position);
    }
    [[nodiscard]] Vec way(int node) const { return direction(at(at(node).parent).position, at(node).position); }

    int add(const Vec& position, int parent, double flow) {
        Node node;
        node.position = position;
        node.parent = parent;
        node.flow = flow;
        node.width = cube_root(flow);
        nodes.push_back(node);
        const int id = size() - 1;
        if (parent >= 0) {
            Node& above = at(parent);
            above.children[static_cast<std::size_t>(above.child_count++)] = id;
        }
        return id;
    }

    // Nodes in an order where parents come before their children.
    [[nodiscard]] std::vector<int> from_root() const {
        std::vector<int> order{0};
        for (std::size_t i = 0; i < order.size(); ++i) {
            const Node& node = at(order[i]);
            for (int c = 0; c < node.child_count; ++c) order.push_back(node.children[static_cast<std::size_t>(c)]);
        }
        return order;
    }

    // Recomputes the flows from the terminals, which removes the accumulated rounding of many small additions.
    void settle_flows() {
        const std::vector<int> order = from_root();
        for (auto id = order.rbegin(); id != order.rend(); ++id) {
            Node& node = at(*id);
            if (node.child_count == 0) continue;
            node.flow = 0.0;
            for (int c = 0; c < node.child_count; ++c) node.flow += at(node.children[static_cast<std::size_t>(c)]).flow;
            node.width = cube_root(node.flow);
        }
    }
};

} // namespace ramus::tree::growth
