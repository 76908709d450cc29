// OpenGL core contexts through EGL without a display and without a surface: a graphics card's where the machine has
// one, Mesa's llvmpipe else. libEGL is loaded when the first one is asked for; ramus starts without it.
#pragma once

#include "render/gl/gl_context.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace ramus::render {

// The context is current and its functions are loaded when this returns. `device` is one of egl_devices(); without it
// graphics cards are tried before EGL_MESA_platform_surfaceless, and devices that are software after it.
[[nodiscard]] Result<std::unique_ptr<GlContext>> make_egl_context(std::optional<int> device = {});

// What EGL_EXT_device_enumeration finds, in its order: "/dev/dri/card0", "software" where it says no more. None
// without libEGL.
[[nodiscard]] std::vector<std::string> egl_devices();

} // namespace ramus::render
