// FollowedSurface: the surface of a tree that follows which branches are hidden. It keeps a polygonizer for each vessel
// system, which recomputes only what changed (polygonize/polygonizer.h). The mesh then has the same bits as one that
// make_surface() makes of the same fields, in another order.
//
//     auto fields = fields_by_system(tree, whole.field, hidden);
//     if (auto updated = surface.update(fields, options, job); !updated) return updated;
//     auto without_false_loops = surface.match(fields, whole.tree, memory, job);
#pragma once

#include "core/base/error.h"
#include "core/base/job.h"
#include "core/field/surface_projector.h"
#include "core/mesh/polygonize/polygonizer.h"
#include "core/mesh/tree_field.h"

#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace ramus::mesh {

class FollowedSurface {
public:
    // Of the same tree each time, with as many systems. At least one is visible. Fails as Polygonizer::update() does;
    // the next update then begins from nothing.
    [[nodiscard]] Result<void> update(std::span<const SystemField> systems, const PolygonizeOptions& options, Job& job);

    // The mesh of one system is edited in place: with gaps, and what was written since the last call.
    [[nodiscard]] bool in_place() const { return polygonizers_.size() == 1; }
    [[nodiscard]] const TriangleMesh& slots() const { return polygonizers_.front().slots(); }
    [[nodiscard]] SurfaceEdit take_edit() { return polygonizers_.front().take_edit(); }
    // The mesh of all visible systems of the last update, put together anew; with gaps.
    [[nodiscard]] TriangleMesh together(std::span<const SystemField> systems) const;
    // What these are meshes of.
    [[nodiscard]] const std::shared_ptr<const field::SurfaceProjector>& projector() const { return projector_; }

    // The surface with the pieces and loops of its tree (loops/match_tree.h), without gaps; nothing where it has these
    // already, which is the rule. What is followed stays as it is. `tree`: as prepared.
    [[nodiscard]] std::optional<TriangleMesh> match(std::span<const SystemField> systems, const PreparedTree& tree,
                                                    double memory_bytes, Job& job) const;

private:
    std::vector<Polygonizer> polygonizers_; // one for each system
    std::shared_ptr<const field::SurfaceProjector> projector_;
};

} // namespace ramus::mesh
