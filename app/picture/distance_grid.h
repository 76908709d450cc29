// The distance to lesions that are meshes, on a grid, as pictures colour by it. Sampled from the exact distance;
// between the samples it is off by a small part of their spacing, which follows the size of the lesions and the widest
// margin.
#pragma once

#include "core/measure/lesion_distance.h"
#include "render/scene/scene.h"

#include <memory>

namespace ramus::app {

// Null without meshes. The last result is kept: asked again for the same meshes and reach, it is the same grid.
[[nodiscard]] std::shared_ptr<const render::DistanceGrid> distance_grid(const measure::Lesions& lesions,
                                                                        double reach_mm);

} // namespace ramus::app
