// LookData: inputs of the formulas in shaders/look other than the surface: lesions, margins, scales, cuts and context,
// in eye space. SceneTables sends it to OpenGL; the caster reads it directly. A value without GL.
#pragma once

#include "render/scene/frame.h"
#include "render/scene/uniform_blocks.h"

#include <glm/mat4x4.hpp>
#include <vector>

namespace ramus::render {

struct LookData {
    SceneBlock block{};
    std::vector<glm::vec4> lesions; // spherical lesions: centre, radius
    // Ends of the lost parts of branches, five entries per part: the branch and which ends exist; then for each end its
    // position and radius, and the vessel's direction and mm from the root.
    std::vector<glm::vec4> cuts;
    // Linear colour and opacity, negative for lines: of context mesh i at 2 i, of lesion i at 2 i + 1.
    std::vector<glm::vec4> shapes;
};

// `lines`: of the tree; may be null. `eye`: from mm to eye space, depth as +z.
[[nodiscard]] LookData look_data_of(const Frame& frame, const Centerlines* lines, const glm::dmat4& eye);

} // namespace ramus::render
