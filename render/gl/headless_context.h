// Creates OpenGL core contexts without a display, on the processor or on a graphics card, for commands that draw
// pictures. They have no visible surface; the Renderer draws into its own framebuffers. A returned context is current
// and its functions are loaded.
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
    kOsMesa, // on the processor; the same pixels on every machine
    kEgl,    // on the graphics card, if there is one
};
[[nodiscard]] std::string_view name_of(Backend backend); // the name on the command line

// `device`: index into egl_devices(); by default EGL chooses.
[[nodiscard]] Result<std::unique_ptr<GlContext>> make_headless_context(Backend backend, std::optional<int> device = {});

// Mesa's llvmpipe through OSMesa.
[[nodiscard]] Result<std::unique_ptr<GlContext>> make_osmesa_context();

// Surfaceless EGL: a graphics card if there is one, otherwise Mesa's llvmpipe. libEGL is loaded on first use; ramus
// starts without it. Without `device` the order is: graphics cards, EGL_MESA_platform_surfaceless, software devices.
[[nodiscard]] Result<std::unique_ptr<GlContext>> make_egl_context(std::optional<int> device = {});

// The devices of EGL_EXT_device_enumeration, in its order: "/dev/dri/card0", or "software" if the device has no name.
// Empty without libEGL.
[[nodiscard]] std::vector<std::string> egl_devices();

} // namespace ramus::render
