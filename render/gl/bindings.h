// The numbers that shaders and C++ agree on, from the shaders' own files.
#pragma once

namespace ramus::render {

#include "shaders/bindings.glsl"
#include "shaders/limits.glsl"

} // namespace ramus::render
