#include "core/tree/edit_graph.h"

#include "core/base/disjoint_sets.h"
#include "core/tree/branch_data.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <map>
#include <tuple>

namespace ramus::tree {

namespace {

std::vector<std::vector<int>> sources_of(const VesselTree& tree, const std::vector<EditLink>& links) {
    std::vector<std::tuple<std::uint32_t, std::uint32_t, int>> sorted;
    sorted.reserve(links.size());
    for (const EditLink& link : links)
        sorted.emplace_back(std::min(link.a, link.b), std::max(link.a, link.b), link.source);
    std::ranges::sort(sorted);
    std::vector<std::vector<int>> sources(tree.branches.size());
    for (std::size_t id = 0; id < tree.branches.size(); ++id) {
        const auto& points = tree.branches[id].points;
        std::map<int, double> share; // mm
        for (std::size_t i = 1; i < points.size(); ++i) {
            const auto [low, high] = std::minmax(points[i - 1], points[i]);
            const auto found = std::ranges::lower_bound(sorted, std::tuple(low, high, kNoBranch));
            if (std::get<2>(*found) == kNoBranch) continue;
            share[std::get<2>(*found)] +=
                glm::distance(tree.points[points[i - 1]].position, tree.points[points[i]].position);
        }
        for (const auto& [source, length] : share) sources[id].push_back(source);
        std::ranges::stable_sort(sources[id], [&](int x, int y) { return share[x] > share[y]; });
    }
    return sources;
}

} // namespace

EditGraph::EditGraph(const VesselTree& tree)
    : points(tree.points), labels(tree.labels), systems(tree.points.size(), 0), point_data(tree.point_data),
      roots(tree.roots) {
    links.reserve(tree.segment_count());
    for (std::size_t id = 0; id < tree.branches.size(); ++id) {
        const Branch& branch = tree.branches[id];
        for (const std::uint32_t p : branch.points) systems[p] = branch.system;
        for (std::size_t i = 1; i < branch.points.size(); ++i)
            links.push_back({branch.points[i - 1], branch.points[i], static_cast<int>(id)});
    }
}

std::uint32_t EditGraph::add_point_between(std::uint32_t a, std::uint32_t b, double share) {
    points.push_back(
        {glm::mix(points[a].position, points[b].position, share), glm::mix(points[a].radius, points[b].radius, share)});
    if (!labels.empty()) labels.push_back(labels[a]);
    systems.push_back(systems[a]);
    append_between(point_data, a, b, share);
    return static_cast<std::uint32_t>(points.size() - 1);
}

std::vector<std::uint32_t> EditGraph::pieces() const {
    DisjointSets sets(points.size());
    for (const EditLink& link : links) sets.join(link.a, link.b);
    std::vector<std::uint32_t> lowest(points.size());
    for (std::uint32_t p = 0; p < points.size(); ++p) lowest[p] = sets.find(p);
    return lowest;
}

std::vector<int> EditGraph::degrees() const {
    std::vector<int> count(points.size(), 0);
    for (const EditLink& link : links) ++count[link.a], ++count[link.b];
    return count;
}

std::uint32_t EditGraph::point_at(const VesselTree& tree, int branch, double fraction) {
    const Branch& along = tree.branches[static_cast<std::size_t>(branch)];
    if (fraction <= 0.0) return along.points.front();
    if (fraction >= 1.0) return along.points.back();
    constexpr double kSame = 1e-9; // of the branch's length: an existing point this near is used
    const double length = length_mm(tree, along);
    const double wanted = fraction * length;
    double before = 0.0;
    for (std::size_t i = 1; i < along.points.size(); ++i) {
        const std::uint32_t a = along.points[i - 1];
        const std::uint32_t b = along.points[i];
        const double step = glm::distance(tree.points[a].position, tree.points[b].position);
        if (wanted - before <= kSame * length) return a;
        if (before + step - wanted <= kSame * length) return b;
        if (wanted < before + step) {
            const std::uint32_t middle = add_point_between(a, b, (wanted - before) / step);
            const auto link = std::ranges::find_if(links, [&](const EditLink& l) { return l.a == a && l.b == b; });
            link->b = middle;
            links.insert(link + 1, {middle, b, branch});
            return middle;
        }
        before += step;
    }
    return along.points.back();
}

EditedTree EditGraph::assembled(const VesselTree& before) && {
    std::vector<bool> used(points.size(), false);
    for (const EditLink& link : links) used[link.a] = used[link.b] = true;
    std::vector<std::uint32_t> renumbered(points.size(), 0);
    std::vector<Point> kept;
    std::vector<std::uint32_t> from;
    std::vector<int> kept_labels, kept_systems, link_branches;
    for (std::uint32_t p = 0; p < points.size(); ++p) {
        if (!used[p]) continue;
        renumbered[p] = static_cast<std::uint32_t>(kept.size());
        kept.push_back(points[p]);
        from.push_back(p);
        if (!labels.empty()) kept_labels.push_back(labels[p]);
        kept_systems.push_back(systems[p]);
    }
    std::vector<Edge> edges;
    edges.reserve(links.size());
    for (EditLink& link : links) {
        link.a = renumbered[link.a], link.b = renumbered[link.b];
        edges.emplace_back(link.a, link.b);
        link_branches.push_back(link.source);
    }
    std::vector<std::uint32_t> kept_roots;
    for (const std::uint32_t root : roots)
        if (used[root]) kept_roots.push_back(renumbered[root]);
    kept_roots = complete_roots(kept, edges, std::move(kept_roots));
    EditedTree edited{assemble(std::move(kept), std::move(kept_labels), edges, kept_roots, kept_systems), {}};
    edited.sources = sources_of(edited.tree, links);
    edited.tree.point_data = picked(point_data, from);
    edited.tree.branch_data = branch_data_of_edges(edited.tree, edges, picked(before.branch_data, link_branches));
    edited.tree.systems = before.systems;
    edited.tree.source = before.source;
    edited.tree.notes = before.notes;
    edited.tree.claims = before.claims;
    edited.tree.voxels = before.voxels;
    note_network(edited.tree);
    return edited;
}

} // namespace ramus::tree
