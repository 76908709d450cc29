// OpenGL core contexts without a display: on the processor or on a graphics card, one choice for every command that
// draws pictures. They have no visible surface: the Renderer draws into framebuffers of its own. Each is current and
// its functions are loaded when its maker returns.
#pragma once

#include "render/gl/gl_context.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ramus::render {

enum class Backend : std::uint8_t {
    kOsMesa, // on the processor, the same everywhere
    kEgl,    // on the graphics card where there is one
};
[[nodiscard]] std::string_view name_of(Backend backend); // as on the command line

// `device`: one of egl_devices(); without it EGL chooses.
[[nodiscard]] Result<std::unique_ptr<GlContext>> make_headless_context(Backend backend, std::optional<int> device = {});

// In memory: Mesa's llvmpipe through OSMesa.
[[nodiscard]] Result<std::unique_ptr<GlContext>> make_osmesa_context();

// Through EGL without a surface: a graphics card's where the machine has one, Mesa's llvmpipe else. libEGL is loaded
// when the first one is asked for; ramus starts without it. Without `device` graphics cards are tried before
// EGL_MESA_platform_surfaceless, and devices that are software after it.
[[nodiscard]] Result<std::unique_ptr<GlContext>> make_egl_context(std::optional<int> device = {});

// What EGL_EXT_device_enumeration finds, in its order: "/dev/dri/card0", "software" where it says no more. None
// without libEGL.
[[nodiscard]] std::vector<std::string> egl_devices();

} // namespace ramus::render
