// Synthetic organ trees for tests and benchmarks: what `ramus grow` grows, without the file between.
#pragma once

#include "core/tree/build_tree.h"
#include "core/tree/grow/grow.h"

#include <cstdint>
#include <string>
#include <utility>

namespace ramus::test {

inline Result<tree::VesselTree> grown_tree(int branches, std::uint64_t seed = 1) {
    tree::GrowOptions options;
    options.branches = branches;
    options.seed = seed;
    Job job;
    const auto grown = tree::grow(options, job);
    if (!grown) return tl::unexpected(grown.error());
    tree::Graph graph;
    graph.points = grown->points;
    for (std::uint32_t i = 0; i < grown->parents.size(); ++i) {
        if (grown->parents[i] < 0)
            graph.roots.push_back(i);
        else
            graph.edges.emplace_back(static_cast<std::uint32_t>(grown->parents[i]), i);
    }
    return tree::build_tree(std::move(graph), tree::Repair::kUsual, [](std::uint32_t) { return std::string("grown"); });
}

// The same, for who cannot go on without.
inline tree::VesselTree grown(int branches, std::uint64_t seed = 1) {
    return std::move(grown_tree(branches, seed).value());
}

} // namespace ramus::test
