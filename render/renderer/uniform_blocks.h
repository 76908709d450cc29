// The uniform blocks as shaders/ declares them: std140 lays out vec4 and mat4 as C++ does.
#pragma once

#include "render/gl/bindings.h"

#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>

namespace ramus::render {

using glm::mat4, glm::vec4;

struct ViewBlock {
#include "shaders/view_block.glsl"
};
struct SceneBlock {
#include "shaders/scene_block.glsl"
};

} // namespace ramus::render
