// Finds the branches inside a lasso by the projected points of their centerlines. Each point represents half of its
// adjacent segments; a branch is inside if at least half of its length is, or optionally any part.
#pragma once

#include "app/tools/pixel_polygon.h"
#include "core/tree/vessel_tree.h"
#include "render/renderer/drawn.h"
#include "render/scene/camera.h"

#include <vector>

namespace ramus::app {

struct LassoRule {
    bool any_part = false; // false: at least half of the length
    // Null: also selects hidden parts. Otherwise the picture's branches, at the camera's size: only points whose pixel
    // shows their branch count, both inside and in total.
    const render::BranchPicture* visible = nullptr;
};

// Returns ids, ascending. `size`: of the picture, pixels. `hidden`: by branch, not 0 for branches to skip; missing
// entries are 0. Points behind the camera are outside.
[[nodiscard]] std::vector<int> branches_inside(const tree::VesselTree& tree, const render::Camera& camera,
                                               glm::ivec2 size, const PixelPolygon& polygon, const LassoRule& rule,
                                               std::span<const std::uint8_t> hidden = {});

} // namespace ramus::app
