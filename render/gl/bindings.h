// The numbers that shaders and C++ agree on, from the shaders' own files.
#pragma once

namespace ramus::render {

#include "shaders/bindings.glsl"

} // namespace ramus::render
