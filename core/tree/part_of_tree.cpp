#include "core/tree/part_of_tree.h"

#include "core/tree/branch_data.h"
#include "core/tree/build_tree.h"

#include <limits>
#include <utility>

namespace ramus::tree {

namespace {

constexpr std::uint32_t kGone = std::numeric_limits<std::uint32_t>::max();

} // namespace

VesselTree part_of(const VesselTree& tree, std::span<const std::uint8_t> kept) {
    const auto is_kept = [&](int branch) {
        return branch >= 0 && static_cast<std::size_t>(branch) < kept.size() &&
               kept[static_cast<std::size_t>(branch)] != 0;
    };
    std::vector<std::uint32_t> now(tree.points.size(), kGone);
    std::vector<int> system_of(tree.points.size(), 0);
    for (std::size_t b = 0; b < tree.branches.size(); ++b)
        if (is_kept(static_cast<int>(b)))
            for (const std::uint32_t point : tree.branches[b].points)
                now[point] = 0, system_of[point] = tree.branches[b].system;
    // Points and branches keep their order.
    std::vector<Point> points;
    std::vector<std::size_t> from;
    std::vector<int> labels, point_systems, edge_branches;
    for (std::size_t p = 0; p < tree.points.size(); ++p) {
        if (now[p] == kGone) continue;
        now[p] = static_cast<std::uint32_t>(points.size());
        points.push_back(tree.points[p]);
        from.push_back(p);
        if (!tree.labels.empty()) labels.push_back(tree.labels[p]);
        if (!tree.systems.empty()) point_systems.push_back(system_of[p]);
    }
    std::vector<Edge> edges;
    std::vector<std::uint32_t> roots;
    for (const std::uint32_t root : tree.roots)
        if (now[root] != kGone) roots.push_back(now[root]);
    for (std::size_t b = 0; b < tree.branches.size(); ++b) {
        if (!is_kept(static_cast<int>(b))) continue;
        const Branch& branch = tree.branches[b];
        for (std::size_t i = 1; i < branch.points.size(); ++i)
            edges.emplace_back(now[branch.points[i - 1]], now[branch.points[i]]);
        edge_branches.resize(edges.size(), static_cast<int>(b));
        // assemble() ignores this root if the piece has already been reached from another root.
        if (!is_kept(branch.parent)) roots.push_back(now[branch.points.front()]);
    }
    VesselTree part = assemble(std::move(points), std::move(labels), edges, roots, point_systems);
    part.point_data = picked(tree.point_data, from);
    part.branch_data = branch_data_of_edges(part, edges, picked(tree.branch_data, edge_branches));
    part.systems = tree.systems;
    part.source = tree.source;
    part.notes = tree.notes;
    part.claims = tree.claims;
    part.voxels = tree.voxels;
    return part;
}

} // namespace ramus::tree
