// Bits of ids and of branch records, included from the shaders' own file.
#pragma once

#include <cstdint>

namespace ramus::render::record {

using uint = std::uint32_t;
#include "shaders/ids.glsl"

} // namespace ramus::render::record
