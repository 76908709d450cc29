#include "core/tree/prepare.h"

#include "core/tree/branch_data.h"
#include "core/tree/build_tree.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <map>
#include <utility>

namespace ramus::tree {

namespace {

std::vector<std::uint32_t> indices_in_order(const VesselTree& tree, const std::map<Edge, std::uint32_t>& index_of) {
    std::vector<std::uint32_t> indices;
    indices.reserve(tree.segment_count());
    for (const Branch& branch : tree.branches)
        for (std::size_t i = 1; i < branch.points.size(); ++i)
            indices.push_back(index_of.at(std::minmax(branch.points[i - 1], branch.points[i])));
    return indices;
}

PreparedTree unpruned(const VesselTree& tree) {
    PreparedTree result{tree, {}, {}, 0, Centerline::kLines};
    result.segment_source.reserve(tree.segment_count());
    for (std::size_t id = 0; id < tree.branches.size(); ++id)
        result.segment_source.insert(result.segment_source.end(), tree.branches[id].points.size() - 1,
                                     static_cast<int>(id));
    return result;
}

// The leaf branches of `tree` that are too short. A branch that closes a loop is no leaf.
std::vector<bool> short_leaves(const VesselTree& tree, double ratio) {
    std::vector<int> degree(tree.points.size(), 0);
    for (const Branch& branch : tree.branches) ++degree[branch.points.front()], ++degree[branch.points.back()];
    std::vector<bool> goes(tree.branches.size(), false);
    for (std::size_t id = 0; id < tree.branches.size(); ++id) {
        const Branch& branch = tree.branches[id];
        if (branch.parent == kNoBranch || degree[branch.points.back()] != 1) continue;
        goes[id] =
            length_mm(tree, branch) < ratio * length_mm(tree, tree.branches[static_cast<std::size_t>(branch.parent)]);
    }
    return goes;
}

} // namespace

PreparedTree prune(const VesselTree& source, double ratio) {
    PreparedTree result = unpruned(source);
    if (!(ratio > 0.0)) return result;
    std::map<Edge, std::uint32_t> index_of;
    {
        std::uint32_t index = 0;
        for (const Branch& branch : source.branches)
            for (std::size_t i = 1; i < branch.points.size(); ++i)
                index_of[std::minmax(branch.points[i - 1], branch.points[i])] = index++;
    }
    VesselTree tree = source;
    std::vector<int> systems(tree.points.size(), 0);
    for (const Branch& branch : source.branches)
        for (const std::uint32_t p : branch.points) systems[p] = branch.system;
    while (true) {
        const std::vector<bool> goes = short_leaves(tree, ratio);
        if (std::ranges::none_of(goes, [](bool g) { return g; })) break;
        std::vector<Edge> edges;
        for (std::size_t id = 0; id < tree.branches.size(); ++id) {
            if (goes[id]) continue;
            const auto& points = tree.branches[id].points;
            for (std::size_t i = 1; i < points.size(); ++i) edges.emplace_back(points[i - 1], points[i]);
        }
        const std::vector<std::uint32_t> roots = tree.roots;
        tree = assemble(std::move(tree.points), std::move(tree.labels), edges, roots, systems);
    }
    result.source_segments = result.segment_source.size();
    result.segment_index = indices_in_order(tree, index_of);
    std::vector<int> sources;
    sources.reserve(result.segment_index.size());
    for (const std::uint32_t index : result.segment_index) sources.push_back(result.segment_source[index]);
    result.segment_source = std::move(sources);

    std::vector<std::uint32_t> renumbered(tree.points.size(), 0);
    std::vector<bool> used(tree.points.size(), false);
    for (const Branch& branch : tree.branches)
        for (const std::uint32_t p : branch.points) used[p] = true;
    VesselTree compact;
    std::vector<std::uint32_t> kept;
    for (std::uint32_t p = 0; p < tree.points.size(); ++p) {
        if (!used[p]) continue;
        renumbered[p] = static_cast<std::uint32_t>(compact.points.size());
        kept.push_back(p);
        compact.points.push_back(tree.points[p]);
        if (!tree.labels.empty()) compact.labels.push_back(tree.labels[p]);
    }
    compact.branches = std::move(tree.branches);
    for (Branch& branch : compact.branches)
        for (std::uint32_t& p : branch.points) p = renumbered[p];
    for (const std::uint32_t root : tree.roots) compact.roots.push_back(renumbered[root]);
    compact.point_data = picked(source.point_data, kept);
    compact.branch_data = branch_data(compact, result.segment_source, source.branch_data);
    compact.loop_count = source.loop_count;
    compact.source = source.source;
    compact.systems = source.systems;
    compact.notes = source.notes;
    compact.claims = source.claims;
    compact.voxels = source.voxels;
    result.tree = std::move(compact);
    return result;
}

VesselTree thinned(VesselTree tree, double spacing) {
    for (Branch& branch : tree.branches) {
        if (branch.points.size() < 3) continue;
        std::size_t kept = 1;
        for (std::size_t i = 1; i + 1 < branch.points.size(); ++i) {
            const Point& last = tree.points[branch.points[kept - 1]];
            const Point& point = tree.points[branch.points[i]];
            if (glm::distance(last.position, point.position) >= spacing * point.radius)
                branch.points[kept++] = branch.points[i];
        }
        branch.points[kept++] = branch.points.back();
        branch.points.resize(kept);
    }
    return tree;
}

} // namespace ramus::tree
