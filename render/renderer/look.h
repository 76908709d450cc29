// The uniform block of look.glsl, from a frame: colours and lights, for shaders and for the caster.
#pragma once

#include "render/renderer/view_setup.h"

namespace ramus::render {

// `outlined`: something is selected.
[[nodiscard]] LookBlock look_of(const Frame& frame, const ViewSetup& view, bool has_glass, bool outlined);

} // namespace ramus::render
