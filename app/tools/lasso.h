// Which branches lie inside a lasso: by their centerline's points, where the camera shows them. Every point stands for
// half of each segment that it ends, so a branch is in when at least half of its length is, or with any part of it.
#pragma once

#include "app/tools/pixel_polygon.h"
#include "core/tree/vessel_tree.h"
#include "render/renderer/drawn.h"
#include "render/scene/camera.h"

#include <vector>

namespace ramus::app {

struct LassoRule {
    bool any_part = false; // else at least half of the length
    // Null: through the tree. Else what the picture shows, of the camera's size: only points whose pixel shows that
    // very branch count, inside and in all.
    const render::BranchPicture* visible = nullptr;
};

// Ids, ascending. `size` is the picture's, in pixels; `hidden` has a value other than 0 for each branch that is never
// in, branches beyond its end may be. Points behind the camera are outside.
[[nodiscard]] std::vector<int> branches_inside(const tree::VesselTree& tree, const render::Camera& camera,
                                               glm::ivec2 size, const PixelPolygon& polygon, const LassoRule& rule,
                                               std::span<const std::uint8_t> hidden = {});

} // namespace ramus::app
