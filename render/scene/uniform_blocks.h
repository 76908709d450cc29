// The shaders' uniform blocks, for OpenGL and for the caster: std140 lays out vec4 and mat4 as C++ does.
#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

namespace ramus::render {

using glm::mat4, glm::vec2, glm::vec4;

#include "shaders/limits.glsl"

struct ViewBlock {
#include "shaders/view_block.glsl"
};
struct LookBlock {
#include "shaders/look_block.glsl"
};
struct SceneBlock {
#include "shaders/scene_block.glsl"
};
struct PlanesBlock {
#include "shaders/planes_block.glsl"
};

} // namespace ramus::render
