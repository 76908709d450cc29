// The binding numbers that shaders and C++ share, included from the shaders' own file.
#pragma once

namespace ramus::render {

#include "shaders/bindings.glsl"

} // namespace ramus::render
