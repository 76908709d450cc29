// How far the surface that is shown lies from another one, vertex by vertex, for its colours; and of what that was
// measured. Measuring takes seconds where surfaces are large: a worker's task (app/workspace/deviation_maker.h).
#pragma once

#include "app/session/session.h"
#include "render/scene/paged_mesh.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace ramus::app {

// Everything that the other surface depends on.
struct DeviationOf {
    std::shared_ptr<const tree::VesselTree> tree;
    DeviationChoice::From from = DeviationChoice::From::kCones;
    std::string file, units;                     // a mesh, or a mask and the unit of its lengths
    std::string axes;                            // of a mesh that does not state them
    std::vector<volume::LabelChoice> labels;     // in the mask
    std::optional<mesh::SurfaceOptions> options; // of cones
    std::vector<int> hidden;                     // likewise: branch ids, ascending
    bool operator==(const DeviationOf&) const = default;
};
// `options`: the surface's, where they are not the session's.
[[nodiscard]] DeviationOf deviation_of(std::shared_ptr<const tree::VesselTree> tree, const Marks& marks,
                                       const mesh::SurfaceOptions& options);

struct SurfaceDeviation {
    using Paged = std::shared_ptr<const render::PagedMesh>;
    DeviationOf of;
    Paged mesh, preview;               // that were measured; null: nothing was, yet. The preview's vertices lie on the
                                       // same surface, so that its distances are true as well
    Paged valued_mesh, valued_preview; // the same, each vertex with its distance in mm
    double mean_mm = 0.0, percentile_95_mm = 0.0, percentile_99_mm = 0.0, most_mm = 0.0; // over the mesh's vertices
    std::optional<double> voxel_mm; // diagonal of the voxels of the mask
    std::string trouble;            // why the other surface cannot be had; empty: it could

    // Whether there are distances of a surface from that.
    [[nodiscard]] bool fits(const DeviationOf& wanted, const Paged& surface) const {
        return surface && of == wanted && trouble.empty() && (surface == mesh || surface == valued_mesh);
    }
};

} // namespace ramus::app
