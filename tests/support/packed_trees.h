// Grown trees packed so closely that their vessels overlap: one to three roots, and a loop in every other one.
#pragma once

#include "core/tree/build_tree.h"
#include "core/tree/grow/grow.h"

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace ramus::test {

inline tree::VesselTree packed_trees(std::uint64_t seed) {
    tree::Graph graph;
    for (std::uint64_t n = 0; n < 1 + seed % 3; ++n) {
        tree::GrowOptions options;
        options.branches = 21 + 10 * static_cast<int>(seed % 4);
        options.seed = 10 * seed + n + 1;
        options.organ_width_mm = 100.0;
        options.root_radius_mm = 2.8;
        Job job;
        const auto grown = tree::grow(options, job);
        const auto first = static_cast<std::uint32_t>(graph.points.size());
        for (tree::Point point : grown.value().points) {
            point.position += static_cast<double>(n) * glm::dvec3(3.0, 5.0, -4.0);
            graph.points.push_back(point);
        }
        for (std::uint32_t p = 0; p < grown->parents.size(); ++p) {
            if (grown->parents[p] < 0)
                graph.roots.push_back(first + p);
            else
                graph.edges.emplace_back(first + static_cast<std::uint32_t>(grown->parents[p]), first + p);
        }
    }
    if (seed % 2 == 1) {
        std::vector<int> degree(graph.points.size(), 0);
        for (const auto& [a, b] : graph.edges) ++degree[a], ++degree[b];
        std::vector<std::uint32_t> ends;
        for (std::uint32_t p = 0; p < degree.size(); ++p)
            if (degree[p] == 1) ends.push_back(p);
        graph.edges.emplace_back(ends[1], ends[ends.size() / 2]);
    }
    return tree::build_tree(std::move(graph), tree::without(tree::Repair::kUsual, tree::Repair::kOpenEnds),
                            [](std::uint32_t) { return std::string(); })
        .value();
}

} // namespace ramus::test
