// An OpenGL core context in memory (Mesa's llvmpipe through OSMesa), for pictures without a display. It has no
// visible surface: the Renderer draws into framebuffers of its own.
#pragma once

#include "render/gl/gl_context.h"

#include <memory>

namespace ramus::render {

// The context is current and its functions are loaded when this returns.
[[nodiscard]] Result<std::unique_ptr<GlContext>> make_osmesa_context();

} // namespace ramus::render
