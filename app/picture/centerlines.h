// The centerlines that a surface follows, as pictures take them: of the tree as it was pruned and smoothed, by the
// branches of the file. Distances from the root are those of the file's own tree, so that they are the same numbers
// whatever the surface's options.
#pragma once

#include "core/mesh/surface.h"
#include "render/scene/centerlines.h"

#include <memory>

namespace ramus::app {

[[nodiscard]] render::Centerlines make_centerlines(const tree::VesselTree& tree, const mesh::SurfaceOptions& options);

// The same, made once for a tree and its options: the last result is kept, so that one picture after another shares it.
// Any thread may ask.
[[nodiscard]] std::shared_ptr<const render::Centerlines>
centerlines_of(const std::shared_ptr<const tree::VesselTree>& tree, const mesh::SurfaceOptions& options);

} // namespace ramus::app
