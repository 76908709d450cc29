// Edits of radii: radius and scale, for whole branches.
#include "core/tree/edit_steps.h"

#include <algorithm>

namespace ramus::tree {

Result<EditedTree> change_radii(const VesselTree& tree, const Edit& edit) {
    if (!(edit.value > 0.0))
        return fail(edit.kind == Edit::Kind::kRadius ? "a radius is not positive" : "a factor is not positive", {},
                    "give a number above 0");
    EditGraph graph(tree);
    std::vector<bool> named(tree.branches.size(), false);
    for (const int id : edit.branches) named[static_cast<std::size_t>(id)] = true;
    // Points that also belong to other branches keep their radii.
    std::vector<bool> changes(tree.points.size(), false);
    for (const int id : edit.branches)
        for (const std::uint32_t p : tree.branches[static_cast<std::size_t>(id)].points) changes[p] = true;
    for (std::size_t id = 0; id < named.size(); ++id)
        if (!named[id]) changes[tree.branches[id].points.front()] = changes[tree.branches[id].points.back()] = false;
    for (const int id : edit.branches) {
        const auto& points = tree.branches[static_cast<std::size_t>(id)].points;
        if (std::ranges::none_of(points, [&](std::uint32_t p) { return bool(changes[p]); })) {
            const std::uint32_t middle = graph.point_at(tree, id, 0.5);
            changes.resize(graph.points.size(), false);
            changes[middle] = true;
        }
    }
    for (std::size_t p = 0; p < changes.size(); ++p) {
        if (!changes[p]) continue;
        double& radius = graph.points[p].radius;
        radius = edit.kind == Edit::Kind::kRadius ? edit.value : edit.value * radius;
        if (!(radius > 0.0 && radius <= kMaximumRadius))
            return fail("a radius would be " + std::to_string(radius) + " mm", {},
                        "radii are above 0 and at most 1000 m");
    }
    return std::move(graph).assembled(tree);
}

} // namespace ramus::tree
