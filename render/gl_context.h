// GlContext: the seam between the renderer and whatever provides OpenGL 4.5 core. OsMesaContext
// (render/osmesa_context.h) needs no display; the window makes its own with GLFW and calls load_gl(glfwGetProcAddress)
// once it is current.
//
// The GL function pointers are the process's, not the context's: whoever makes a context of another kind current calls
// load_gl() again (GlContext::make_current() does). All GL runs on one thread. Nothing here links libGL: under OSMesa
// that would bring a second, wrong implementation.
#pragma once

#include "core/base/error.h"

#include <string>

namespace ramus::render {

using GlFunction = void (*)();
using GlLoader = GlFunction (*)(const char* name);

// Loads every GL 4.5 function through `loader` for the context that is current, and turns on debug messages where the
// context has them. Fails when the context is older than 4.5, with the version found.
[[nodiscard]] Result<void> load_gl(GlLoader loader);

// "llvmpipe (LLVM 15.0.6, 256 bits), OpenGL 4.5 (Core Profile) Mesa 22.3.6"
[[nodiscard]] std::string gl_description();

// Whether the processor draws, triangle by triangle, instead of a graphics card.
[[nodiscard]] bool is_software_rasteriser();

// GL errors that the driver reported since the process began (debug messages of type error, and glGetError by the
// renderer after each frame). A correct program keeps it at 0; tests check it. The last one is logged in
// `gl_last_error`.
[[nodiscard]] int gl_error_count();
// Whether memory ran out since the last call. Counts what else went wrong.
[[nodiscard]] bool gl_ran_out_of_memory();
[[nodiscard]] const std::string& gl_last_error();

class GlContext {
public:
    GlContext() = default;
    GlContext(const GlContext&) = delete;
    GlContext& operator=(const GlContext&) = delete;
    virtual ~GlContext() = default;
    [[nodiscard]] virtual Result<void> make_current() = 0;
};

} // namespace ramus::render
