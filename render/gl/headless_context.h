// OpenGL without a display, from whom one wants it: one choice for every command that draws pictures.
#pragma once

#include "render/gl/gl_context.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>

namespace ramus::render {

enum class Backend : std::uint8_t {
    kOsMesa, // on the processor, the same everywhere
    kEgl,    // on the graphics card where there is one
};
[[nodiscard]] std::string_view name_of(Backend backend); // as on the command line

// The context is current and its functions are loaded when this returns. `device`: of EGL's, see egl_context.h.
[[nodiscard]] Result<std::unique_ptr<GlContext>> make_headless_context(Backend backend, std::optional<int> device = {});

} // namespace ramus::render
