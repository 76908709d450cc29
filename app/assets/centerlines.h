// The centerlines that a surface follows, as pictures take them: of the tree as it was pruned and smoothed, by the
// branches of the file. Distances from the root are those of the file's own tree, so that they are the same numbers
// whatever the surface's options.
#pragma once

#include "core/mesh/surface.h"
#include "render/scene/centerlines.h"

#include <memory>

namespace ramus::app {

struct SurfaceCenterlines {
    int smooth_passes = 0;
    double prune_ratio = 0.0;
    std::shared_ptr<const render::Centerlines> lines; // null: none yet
    [[nodiscard]] bool fits(const mesh::SurfaceOptions& options) const {
        return lines && smooth_passes == options.smooth_passes && prune_ratio == options.prune_ratio;
    }
};

[[nodiscard]] SurfaceCenterlines centerlines_of(const tree::VesselTree& tree, const mesh::SurfaceOptions& options);

} // namespace ramus::app
