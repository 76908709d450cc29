// The options of `ramus render` that choose the OpenGL implementation.
#pragma once

#include "app/commands/surface_flags.h"
#include "core/base/error.h"
#include "render/gl/headless_context.h"

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json_fwd.hpp>

namespace ramus::app {

struct BackendFlags {
    render::Backend backend = render::Backend::kOsMesa;
    int device = -1; // EGL device; -1: the best one
};

// Adds the options to `command`; parsing writes to `flags`, which must live as long as the command.
void add_backend_flags(CLI::App& command, BackendFlags& flags);
// Throws CLI::Error for options that cannot be combined.
void check_backend_flags(const BackendFlags& flags);

// Creates an OpenGL context of the requested backend and makes it current.
[[nodiscard]] Result<std::unique_ptr<render::GlContext>> open_context(const BackendFlags& flags,
                                                                      const SurfaceFlags& common);
// The OpenGL in use, for --json.
[[nodiscard]] nlohmann::json opengl_in_use(render::Backend backend);

} // namespace ramus::app
