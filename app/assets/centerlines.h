// The centerlines of a surface for pictures: of the pruned and smoothed tree, by the file's branches. Distances from
// the root are those of the file's tree, so they do not depend on the surface's options.
#pragma once

#include "app/session/smoothing_text.h"
#include "core/mesh/surface_options.h"
#include "render/caster/fitted_cones.h"
#include "render/scene/centerlines.h"

#include <memory>

namespace ramus::app {

// Width of a surface with these options around its centerlines, as in render::Frame.
struct DrawnWidth {
    float width = 0.0F, beyond_ends = 1.0F;
    bool operator==(const DrawnWidth&) const = default;
};
[[nodiscard]] DrawnWidth drawn_width(const mesh::SurfaceOptions& options, mesh::Method method);

struct SurfaceCenterlines {
    int smooth_passes = 0;
    double prune_ratio = 0.0;
    Smoothing smoothing;                              // of the whole tree
    std::shared_ptr<const render::Centerlines> lines; // null: not yet computed
    // Cones of the lines, perhaps for earlier options. Null: pictures build them when needed.
    std::shared_ptr<const render::caster::FittedCones> cones;
    [[nodiscard]] bool fits(const mesh::SurfaceOptions& options) const {
        return lines && smooth_passes == options.smooth_passes && prune_ratio == options.prune_ratio;
    }
    [[nodiscard]] bool cones_fit(const DrawnWidth& width) const {
        return cones && cones->lines == lines && cones->width == width.width && cones->beyond_ends == width.beyond_ends;
    }
};

[[nodiscard]] SurfaceCenterlines centerlines_of(const tree::VesselTree& tree, const mesh::SurfaceOptions& options);

// Whether the caster can represent a surface of these options: it has the Gaussian kernel, or none.
[[nodiscard]] bool drawn_along_lines(const mesh::SurfaceOptions& options, mesh::Method method);

} // namespace ramus::app
