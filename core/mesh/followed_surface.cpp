#include "core/mesh/followed_surface.h"

#include "core/mesh/loops/match_tree.h"
#include "core/mesh/systems.h"
#include "core/mesh/tree_field.h"

#include <utility>

namespace ramus::mesh {

Result<void> FollowedSurface::update(std::span<const SystemField> systems, const PolygonizeOptions& options, Job& job) {
    polygonizers_.resize(systems.size());
    std::vector<field::Field> fields;
    for (const SystemField& system : systems) fields.push_back(system.field);
    projector_ = std::make_shared<const field::SurfaceProjector>(std::move(fields));
    for (std::size_t n = 0; n < systems.size(); ++n) {
        if (!systems[n].visible()) continue; // its polygonizer stays where it is: what comes next is likely near that
        if (auto updated = polygonizers_[n].update(systems[n].field, options, job); !updated) return updated;
        if (!in_place()) static_cast<void>(polygonizers_[n].take_edit());
    }
    return {};
}

TriangleMesh FollowedSurface::together(std::span<const SystemField> systems) const {
    TriangleMesh all;
    for (std::size_t n = 0; n < polygonizers_.size(); ++n)
        if (systems[n].visible()) append(all, polygonizers_[n].slots());
    return all;
}

std::optional<TriangleMesh> FollowedSurface::match(std::span<const SystemField> systems, const PreparedTree& tree,
                                                   double memory_bytes, Job& job) const {
    std::vector<PreparedTree> visible;
    bool matches = true;
    for (std::size_t n = 0; n < systems.size(); ++n) {
        visible.push_back(visible_part(tree, systems[n].hidden));
        matches = matches && (!systems[n].visible() || matches_tree(polygonizers_[n].slots(), visible[n].tree));
    }
    if (matches) return std::nullopt;
    TriangleMesh all;
    bool changed = false;
    for (std::size_t n = 0; n < systems.size(); ++n) {
        if (!systems[n].visible()) continue;
        TriangleMesh one = polygonizers_[n].compact();
        const auto walled = polygonizers_[n].walled();
        changed = match_tree(one, visible[n], walled, memory_bytes, job).changed() || changed;
        append(all, std::move(one));
    }
    return changed ? std::optional(std::move(all)) : std::nullopt;
}

} // namespace ramus::mesh
