// Edits of the flow direction: move root and flip.
#include "core/tree/edit_steps.h"

#include <algorithm>

namespace ramus::tree {

namespace {

EditedTree with_root(const VesselTree& tree, std::uint32_t root) {
    EditGraph graph(tree);
    const auto pieces = graph.pieces();
    const auto old = std::ranges::find_if(graph.roots, [&](std::uint32_t r) { return pieces[r] == pieces[root]; });
    if (old == graph.roots.end())
        graph.roots.push_back(root);
    else
        *old = root;
    return std::move(graph).assembled(tree);
}

} // namespace

Result<EditedTree> move_root(const VesselTree& tree, const Edit& edit) {
    const int id = edit.branches[0];
    const auto& points = tree.branches[static_cast<std::size_t>(id)].points;
    const EditGraph graph(tree);
    const auto degree = graph.degrees();
    const auto pieces = graph.pieces();
    const bool ring = [&] {
        for (std::uint32_t p = 0; p < degree.size(); ++p)
            if (degree[p] == 1 && pieces[p] == pieces[points.front()]) return false;
        return true;
    }();
    std::uint32_t nearer = edit.fractions[0] > 0.5 ? points.back() : points.front();
    const std::uint32_t farther = edit.fractions[0] > 0.5 ? points.front() : points.back();
    if (!ring && degree[nearer] != 1) nearer = farther;
    if (!ring && degree[nearer] != 1)
        return fail("branch " + std::to_string(id) + " has no free end", {},
                    "a root is an end of the tree: choose one");
    if (std::ranges::find(tree.roots, nearer) != tree.roots.end())
        return fail("the root is at this end of branch " + std::to_string(id) + " already", {}, "choose another end");
    return with_root(tree, nearer);
}

Result<EditedTree> flip(const VesselTree& tree, const Edit& edit) {
    const auto degree = degrees(tree);
    std::vector<int> open{edit.branches[0]};
    std::uint32_t best = 0;
    bool found = false;
    for (std::size_t n = 0; n < open.size(); ++n) {
        const Branch& branch = tree.branches[static_cast<std::size_t>(open[n])];
        const std::uint32_t end = branch.points.back();
        if (degree[end] == 1 && (!found || tree.points[end].radius > tree.points[best].radius))
            best = end, found = true;
        open.insert(open.end(), branch.children.begin(), branch.children.end());
    }
    if (!found)
        return fail("no free end lies beyond branch " + std::to_string(edit.branches[0]), {},
                    "blood cannot enter there; move the root instead");
    return with_root(tree, best);
}

} // namespace ramus::tree
