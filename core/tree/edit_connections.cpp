// Edits of connections: join, cut and delete.
#include "core/tree/edit_steps.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <set>

namespace ramus::tree {

namespace {

const Branch& branch_of(const VesselTree& tree, int id) { return tree.branches[static_cast<std::size_t>(id)]; }

std::string system_name(const VesselTree& tree, int system) {
    return static_cast<std::size_t>(system) < tree.systems.size() ? tree.systems[static_cast<std::size_t>(system)].name
                                                                  : std::to_string(system);
}

double radius_at(const VesselTree& tree, const Branch& branch, double mm) {
    double before = 0.0;
    for (std::size_t i = 1; i < branch.points.size(); ++i) {
        const Point& a = tree.points[branch.points[i - 1]];
        const Point& b = tree.points[branch.points[i]];
        const double step = glm::distance(a.position, b.position);
        if (mm <= before + step) return glm::mix(a.radius, b.radius, std::max(0.0, mm - before) / step);
        before += step;
    }
    return tree.points[branch.points.back()].radius;
}

// The root of two pieces that become one: the root that is not at the joint. If both are, or neither is, the root of
// the piece with more links.
void keep_one_root(EditGraph& graph, const std::vector<std::uint32_t>& pieces, std::uint32_t a, std::uint32_t b) {
    const auto root_of = [&](std::uint32_t at) {
        return std::ranges::find_if(graph.roots, [&](std::uint32_t root) { return pieces[root] == pieces[at]; });
    };
    const auto links_of = [&](std::uint32_t at) {
        return std::ranges::count_if(graph.links, [&](const EditLink& link) { return pieces[link.a] == pieces[at]; });
    };
    const auto first = root_of(a);
    const auto second = root_of(b);
    if (first == graph.roots.end() || second == graph.roots.end()) return;
    const bool first_joined = *first == a;
    const bool second_joined = *second == b;
    const bool keep_first = first_joined != second_joined ? second_joined : links_of(a) > links_of(b);
    graph.roots.erase(keep_first ? second : first);
}

// The links of one branch between two lengths (mm). Adds points at the two ends where there are none.
struct Kept {
    std::vector<EditLink> links;
    std::uint32_t first = 0, last = 0; // points
};
Kept part_between(EditGraph& graph, const VesselTree& tree, int id, double from, double to, double length) {
    const double same = 1e-9 * length;
    const auto& points = branch_of(tree, id).points;
    Kept kept;
    double before = 0.0;
    for (std::size_t i = 1; i < points.size(); ++i) {
        const Point& a = tree.points[points[i - 1]];
        const Point& b = tree.points[points[i]];
        const double step = glm::distance(a.position, b.position);
        const double begin = std::max(from, before);
        const double end = std::min(to, before + step);
        const auto point_at = [&](double mm) {
            if (mm <= before + same) return points[i - 1];
            if (mm >= before + step - same) return points[i];
            return graph.add_point_between(points[i - 1], points[i], (mm - before) / step);
        };
        if (end - begin > same) {
            const std::uint32_t start = kept.links.empty() ? point_at(begin) : kept.last;
            const std::uint32_t stop = point_at(end);
            if (start != stop) {
                if (kept.links.empty()) kept.first = start;
                kept.links.push_back({start, stop, id});
                kept.last = stop;
            }
        }
        before += step;
    }
    return kept;
}

// Gives each piece that has lost its root a root at one of `ends`, the ends of the cut, if it has one.
void root_at_cut(EditGraph& graph, const std::vector<std::uint32_t>& ends) {
    const auto pieces = graph.pieces();
    const auto degrees = graph.degrees();
    std::set<std::uint32_t> rooted;
    for (const std::uint32_t root : graph.roots)
        if (degrees[root] > 0) rooted.insert(pieces[root]);
    for (const std::uint32_t end : ends)
        if (degrees[end] == 1 && rooted.insert(pieces[end]).second) graph.roots.push_back(end);
}

} // namespace

Result<EditedTree> join(const VesselTree& tree, const Edit& edit) {
    const int free_id = edit.branches[0];
    const int other_id = edit.branches[1];
    const std::string free_name = "branch " + std::to_string(free_id);
    const int from = branch_of(tree, free_id).system;
    const int to = branch_of(tree, other_id).system;
    if (from != to)
        return fail(free_name + " is of the system " + system_name(tree, from) + ", branch " +
                        std::to_string(other_id) + " of the system " + system_name(tree, to),
                    {}, "vessels of different systems are never joined");
    EditGraph graph(tree);
    const auto& points = branch_of(tree, free_id).points;
    const std::uint32_t end = edit.fractions[0] > 0.5 ? points.back() : points.front();
    if (graph.degrees()[end] != 1)
        return fail("this end of " + free_name + " is no free end", {}, "begin at an end that nothing else is at");
    const std::uint32_t place = graph.point_at(tree, other_id, edit.fractions[1]);
    const auto connects = [&](const EditLink& link) {
        return (link.a == end && link.b == place) || (link.a == place && link.b == end);
    };
    if (place == end || std::ranges::any_of(graph.links, connects))
        return fail("the two places are connected already", {}, "choose a place on another vessel");
    const auto pieces = graph.pieces();
    if (pieces[end] != pieces[place]) keep_one_root(graph, pieces, end, place);
    if (graph.points[end].position != graph.points[place].position) {
        graph.links.push_back({end, place, kNoBranch});
        return std::move(graph).assembled(tree);
    }
    // The two points coincide: one point represents both.
    graph.points[place].radius = std::max(graph.points[place].radius, graph.points[end].radius);
    std::ranges::replace(graph.roots, end, place);
    for (EditLink& link : graph.links) {
        if (link.a == end) link.a = place;
        if (link.b == end) link.b = place;
    }
    return std::move(graph).assembled(tree);
}

CutRange cut_range(const VesselTree& tree, int id, double fraction, double gap_mm) {
    const Branch& branch = branch_of(tree, id);
    const double length = length_mm(tree, branch);
    const double at = fraction * length;
    const double half = gap_mm > 0.0 ? 0.5 * gap_mm : radius_at(tree, branch, at);
    CutRange range{std::max(0.0, at - half) / length, std::min(length, at + half) / length};
    if (range.from * length < tree.points[branch.points.front()].radius) range.from = 0.0;
    if ((1.0 - range.to) * length < tree.points[branch.points.back()].radius) range.to = 1.0;
    return range;
}

Result<EditedTree> cut(const VesselTree& tree, const Edit& edit) {
    const int id = edit.branches[0];
    const double length = length_mm(tree, branch_of(tree, id));
    const CutRange range = cut_range(tree, id, edit.fractions[0], edit.value);
    EditGraph graph(tree);
    const Kept near = part_between(graph, tree, id, 0.0, range.from * length, length);
    const Kept far = part_between(graph, tree, id, range.to * length, length, length);
    const auto own = std::ranges::find(graph.links, id, &EditLink::source);
    const auto at = graph.links.erase(own, own + static_cast<std::ptrdiff_t>(branch_of(tree, id).points.size() - 1));
    auto kept = near.links;
    kept.insert(kept.end(), far.links.begin(), far.links.end());
    graph.links.insert(at, kept.begin(), kept.end());
    if (graph.links.empty()) return fail("nothing would be left of the tree", {}, "cut less out of it");
    std::vector<std::uint32_t> ends;
    ends.push_back(far.links.empty() ? branch_of(tree, id).points.back() : far.first);
    ends.push_back(near.links.empty() ? branch_of(tree, id).points.front() : near.last);
    root_at_cut(graph, ends);
    return std::move(graph).assembled(tree);
}

Result<EditedTree> remove_branches(const VesselTree& tree, const Edit& edit) {
    EditGraph graph(tree);
    const auto before = graph.pieces();
    std::vector<bool> goes(tree.branches.size(), false);
    for (const int id : edit.branches) goes[static_cast<std::size_t>(id)] = true;
    std::erase_if(graph.links, [&](const EditLink& link) { return goes[static_cast<std::size_t>(link.source)]; });
    if (graph.links.empty()) return fail("nothing would be left of the tree", {}, "leave a branch at least");
    const auto after = graph.pieces();
    std::set<std::pair<std::uint32_t, std::uint32_t>> parts; // piece before, piece after
    for (const EditLink& link : graph.links) parts.emplace(before[link.a], after[link.a]);
    const auto split =
        std::ranges::adjacent_find(parts, [](const auto& one, const auto& next) { return one.first == next.first; });
    if (split != parts.end())
        return fail(edit.branches.size() == 1
                        ? "branch " + std::to_string(edit.branches[0]) + " carries others, which would be left hanging"
                        : "these branches carry others, which would be left hanging",
                    {}, "delete what depends on it too, or cut it");
    return std::move(graph).assembled(tree);
}

} // namespace ramus::tree
