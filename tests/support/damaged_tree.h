// What goes wrong with vessels, done to a tree on purpose: a surface of the damaged tree is held against the tree as it
// was, or the other way round. mm.
#pragma once

#include "core/tree/build_tree.h"
#include "core/tree/edit_tree.h"
#include "core/tree/vessel_tree.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <doctest/doctest.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>
#include <vector>

namespace ramus::test {

// The same vessels and the same ids, with points no farther apart than that.
inline tree::VesselTree dense(tree::VesselTree tree, double spacing) {
    for (tree::Branch& branch : tree.branches) {
        std::vector<std::uint32_t> points{branch.points.front()};
        for (std::size_t i = 1; i < branch.points.size(); ++i) {
            const tree::Point a = tree.points[branch.points[i - 1]], b = tree.points[branch.points[i]];
            const int pieces =
                std::max(1, static_cast<int>(std::ceil(glm::distance(a.position, b.position) / spacing)));
            for (int k = 1; k < pieces; ++k) {
                const double share = double(k) / pieces;
                points.push_back(static_cast<std::uint32_t>(tree.points.size()));
                tree.points.push_back({glm::mix(a.position, b.position, share), std::lerp(a.radius, b.radius, share)});
            }
            points.push_back(branch.points[i]);
        }
        branch.points = std::move(points);
    }
    tree.labels.clear();
    return tree;
}

// A place on a branch, so many mm from its first point.
struct PlaceOn {
    int branch = 0;
    double along = 0.0;
};

inline tree::Point point_at(const tree::VesselTree& tree, const PlaceOn& place) {
    const std::vector<std::uint32_t>& points = tree.branches[static_cast<std::size_t>(place.branch)].points;
    double left = place.along;
    for (std::size_t i = 1; i < points.size(); ++i) {
        const tree::Point &a = tree.points[points[i - 1]], &b = tree.points[points[i]];
        const double length = glm::distance(a.position, b.position);
        if (left <= length || i + 1 == points.size()) {
            const double share = std::min(left / length, 1.0);
            return {glm::mix(a.position, b.position, share), std::lerp(a.radius, b.radius, share)};
        }
        left -= length;
    }
    return {};
}

// A cosine-shaped stenosis of `share` of the radius over `length` mm: each point keeps 1 - share of its radius in the
// middle. Points should be dense.
inline tree::VesselTree with_stenosis(tree::VesselTree tree, const PlaceOn& place, double share, double length) {
    const std::vector<std::uint32_t>& points = tree.branches[static_cast<std::size_t>(place.branch)].points;
    double along = 0.0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (i > 0) along += glm::distance(tree.points[points[i - 1]].position, tree.points[points[i]].position);
        const double off = 2.0 * (along - place.along) / length;
        if (std::abs(off) < 1.0)
            tree.points[points[i]].radius *= 1.0 - share * 0.5 * (1.0 + std::cos(std::numbers::pi * off));
    }
    return tree;
}

// Calls change(point) for the points of a branch that no other branch has.
template <class Change> tree::VesselTree with_own_points(tree::VesselTree tree, int branch, const Change& change) {
    std::vector<int> degree(tree.points.size(), 0);
    for (const tree::Branch& one : tree.branches) ++degree[one.points.front()], ++degree[one.points.back()];
    for (const std::uint32_t p : tree.branches[static_cast<std::size_t>(branch)].points)
        if (degree[p] <= 1) change(tree.points[p]); // inner points are nobody's end
    return tree;
}

inline tree::VesselTree scaled_branch(const tree::VesselTree& tree, int branch, double factor) {
    return with_own_points(tree, branch, [&](tree::Point& point) { point.radius *= factor; });
}

inline tree::VesselTree shifted_branch(const tree::VesselTree& tree, int branch, const glm::dvec3& by) {
    return with_own_points(tree, branch, [&](tree::Point& point) { point.position += by; });
}

inline tree::VesselTree without_branch(const tree::VesselTree& tree, int branch) {
    auto edited = tree::apply(tree, {tree::Edit::Kind::kDelete, {branch}, {}, 0.0});
    REQUIRE_MESSAGE(edited, (edited ? "" : edited.error().message()));
    return std::move(edited->tree);
}

// The tree with one more vessel along `points`, which begins at an inner point of a branch. Ids are others.
inline tree::VesselTree with_branch(const tree::VesselTree& tree, std::uint32_t from,
                                    const std::vector<tree::Point>& more) {
    std::vector<tree::Point> points = tree.points;
    std::vector<tree::Edge> edges;
    for (const tree::Branch& branch : tree.branches)
        for (std::size_t i = 1; i < branch.points.size(); ++i)
            edges.emplace_back(branch.points[i - 1], branch.points[i]);
    std::uint32_t last = from;
    for (const tree::Point& point : more) {
        points.push_back(point);
        edges.emplace_back(last, static_cast<std::uint32_t>(points.size() - 1));
        last = static_cast<std::uint32_t>(points.size() - 1);
    }
    return tree::assemble(std::move(points), {}, edges, tree.roots);
}

} // namespace ramus::test
