// LookData: what the formulas of shaders/look read of a frame beside the surface itself: lesions and margins, scales,
// cuts and context, in eye space. SceneTables sends it to OpenGL, the caster reads it as it is. A value without GL.
#pragma once

#include "render/scene/frame.h"
#include "render/scene/uniform_blocks.h"

#include <glm/mat4x4.hpp>
#include <vector>

namespace ramus::render {

struct LookData {
    SceneBlock block{};
    std::vector<glm::vec4> lesions; // those that are spheres: centre, radius
    // Where parts of branches that are lost begin and end, five a part: the branch and which ends it has; then for each
    // end its position and radius, and the vessel's direction and mm from the root.
    std::vector<glm::vec4> cuts;
    std::vector<glm::vec4> context; // meshes: linear colour, opacity; negative: lines
};

// `lines`: the tree's; null where there are none. `eye`: from mm to eye space, depth as +z.
[[nodiscard]] LookData look_data_of(const Frame& frame, const Centerlines* lines, const glm::dmat4& eye);

} // namespace ramus::render
