// SurfaceDeviation: the distance of each vertex of the shown surface from another one, with the inputs of the
// measurement. Measuring takes seconds for large surfaces: use a worker (app/workspace/deviation_maker.h).
#pragma once

#include "app/session/session.h"
#include "render/scene/paged_mesh.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace ramus::app {

// The inputs that define the other surface.
struct DeviationOf {
    std::shared_ptr<const tree::VesselTree> tree;
    DeviationChoice::From from = DeviationChoice::From::kCones;
    std::string file, units;                     // a mesh, or a mask and its unit
    std::string axes;                            // of a mesh that does not state them
    std::vector<volume::LabelChoice> labels;     // of the mask
    std::optional<mesh::SurfaceOptions> options; // for cones
    std::vector<int> hidden;                     // for cones: branch ids, ascending
    bool operator==(const DeviationOf&) const = default;
};
// `options`: of the surface, if not the session's.
[[nodiscard]] DeviationOf deviation_of(std::shared_ptr<const tree::VesselTree> tree, const Marks& marks,
                                       const mesh::SurfaceOptions& options);

struct SurfaceDeviation {
    using Paged = std::shared_ptr<const render::PagedMesh>;
    DeviationOf of;
    Paged mesh, preview;               // the measured surface; null: not measured. The preview's vertices lie on the
                                       // same surface, so its distances are valid, too
    Paged valued_mesh, valued_preview; // the same, each vertex with its distance in mm
    double mean_mm = 0.0, percentile_95_mm = 0.0, percentile_99_mm = 0.0, most_mm = 0.0; // over the mesh's vertices
    std::optional<double> voxel_mm; // diagonal of the mask's voxels
    std::string trouble;            // why the other surface is unavailable; empty: it is available

    // Whether this has the distances of `surface` from `wanted`.
    [[nodiscard]] bool fits(const DeviationOf& wanted, const Paged& surface) const {
        return surface && of == wanted && trouble.empty() && (surface == mesh || surface == valued_mesh);
    }
};

} // namespace ramus::app
