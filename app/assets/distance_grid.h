// The distance to lesions that are meshes, on a grid, as pictures colour by it. Sampled from the exact distance;
// between the samples it is off by a small part of their spacing, which follows the size of the lesions and the widest
// margin.
#pragma once

#include "app/session/session.h"
#include "core/measure/lesion_distance.h"
#include "render/scene/scene.h"

#include <memory>
#include <vector>

namespace ramus::app {

struct LesionGrid {
    std::vector<std::shared_ptr<const measure::MeshDistance>> of;
    double reach_mm = 0.0;
    std::shared_ptr<const render::DistanceGrid> grid; // null: none yet
    [[nodiscard]] bool fits(const measure::Lesions& lesions, double reach) const {
        return grid && of == lesions.meshes && reach_mm == reach;
    }
};

// The distance that pictures colour by; 0 without margins.
[[nodiscard]] double widest_margin_mm(const Planning& planning);

// `lesions` have meshes; the grid covers all within `reach_mm` of them. A third of a second on one core for a lesion of
// ten thousand triangles.
[[nodiscard]] LesionGrid distance_grid(const measure::Lesions& lesions, double reach_mm);

} // namespace ramus::app
