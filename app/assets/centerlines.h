// The centerlines that a surface follows, as pictures take them: of the tree as it was pruned and smoothed, by the
// branches of the file. Distances from the root are those of the file's own tree, so that they are the same numbers
// whatever the surface's options.
#pragma once

#include "app/session/smoothing_text.h"
#include "core/mesh/surface_options.h"
#include "render/caster/fitted_cones.h"
#include "render/scene/centerlines.h"

#include <memory>

namespace ramus::app {

// How wide a surface of these options is around its centerlines, as render::Frame has it.
struct DrawnWidth {
    float width = 0.0F, beyond_ends = 1.0F;
    bool operator==(const DrawnWidth&) const = default;
};
[[nodiscard]] DrawnWidth drawn_width(const mesh::SurfaceOptions& options, mesh::Method method);

struct SurfaceCenterlines {
    int smooth_passes = 0;
    double prune_ratio = 0.0;
    Smoothing smoothing;                              // of the whole tree
    std::shared_ptr<const render::Centerlines> lines; // null: none yet
    // Of the lines, and of options that are or that were. Null: none yet; pictures make them when they need them.
    std::shared_ptr<const render::caster::FittedCones> cones;
    [[nodiscard]] bool fits(const mesh::SurfaceOptions& options) const {
        return lines && smooth_passes == options.smooth_passes && prune_ratio == options.prune_ratio;
    }
    [[nodiscard]] bool cones_fit(const DrawnWidth& width) const {
        return cones && cones->lines == lines && cones->width == width.width && cones->beyond_ends == width.beyond_ends;
    }
};

[[nodiscard]] SurfaceCenterlines centerlines_of(const tree::VesselTree& tree, const mesh::SurfaceOptions& options);

// Whether what is drawn while the view moves knows the surface of these options: it has the Gaussian kernel, or none.
[[nodiscard]] bool drawn_along_lines(const mesh::SurfaceOptions& options, mesh::Method method);

} // namespace ramus::app
