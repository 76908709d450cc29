// GlContext: the seam between the renderer and whatever provides OpenGL core, from 3.3 on. OSMesa and EGL need no
// display (render/gl/headless_context.h); the window makes its own with GLFW and calls load_gl(glfwGetProcAddress) once
// it is current.
//
// The GL function pointers are the process's, not the context's: whoever makes a context of another kind current calls
// load_gl() again (GlContext::make_current() does). Two threads may use contexts of one kind, each its own, where no
// function is put in other terms (gl_takes_threads()). Nothing here links libGL: under OSMesa that would bring a
// second, wrong implementation.
#pragma once

#include "core/base/error.h"

#include <array>
#include <compare>
#include <string>

namespace ramus::render {

using GlFunction = void (*)();
using GlLoader = GlFunction (*)(const char* name);

// A version of OpenGL. Everything is drawn from kOldestGl on; makers of contexts ask for these, best first.
struct GlVersion {
    int major = 0, minor = 0;
    // NOLINTNEXTLINE(modernize-use-nullptr): there is no pointer
    auto operator<=>(const GlVersion&) const = default;
    [[nodiscard]] std::string text() const { return std::to_string(major) + "." + std::to_string(minor); }
};
inline constexpr GlVersion kOldestGl{3, 3};
inline constexpr std::array kWantedGl{GlVersion{4, 5}, GlVersion{4, 3}, kOldestGl};

// Loads GL's functions through `loader` for the context that is current, and turns on debug messages where the context
// has them. What 4.5 has and the context has not is put in terms of 3.3 (render/gl/gl_floor.h); `context` tells
// contexts apart that live at the same time. Fails when the context is older than 3.3, with the version found and
// `remedy`.
[[nodiscard]] Result<void> load_gl(GlLoader loader, const void* context = nullptr, const std::string& remedy = {});

// What load_gl() found, no more than limit_gl_version() allows.
[[nodiscard]] GlVersion gl_version();
// Whether shaders can write lists (4.3): glass is one pass then, else one a layer.
[[nodiscard]] inline bool gl_has_lists() { return gl_version() >= GlVersion{4, 3}; }
// Whether a second context of the same kind may be used by another thread: from 4.5 on (see gl_floor.h).
[[nodiscard]] inline bool gl_takes_threads() { return gl_version() >= GlVersion{4, 5}; }
// For tests: contexts that are made current from now on count as no newer than this.
void limit_gl_version(GlVersion newest);

// "llvmpipe (LLVM 15.0.6, 256 bits), OpenGL 4.5 (Core Profile) Mesa 22.3.6"
[[nodiscard]] std::string gl_description();

// "llvmpipe (LLVM 15.0.6, 256 bits)"
[[nodiscard]] std::string gl_renderer();

// Whether the processor draws, triangle by triangle, instead of a graphics card.
[[nodiscard]] bool is_software_rasteriser();

// Whether the processor draws and takes buffers in memory of this process's own (GL_AMD_pinned_memory).
[[nodiscard]] bool gl_takes_own_memory();

// What the current context has to draw with, in bytes: a graphics card's own memory where its driver tells
// (GL_NVX_gpu_memory_info, GL_ATI_meminfo), half of the machine's where the processor draws, infinite elsewhere.
[[nodiscard]] double graphics_memory_bytes();

// GL errors and messages of high severity since the process began, but for memory that ran out. A correct program keeps
// it at 0; tests check it. The last one is `gl_last_error`.
[[nodiscard]] int gl_error_count();
[[nodiscard]] std::string gl_last_error();
// Whether memory ran out since the last call. Counts what else went wrong.
[[nodiscard]] bool gl_ran_out_of_memory();
// Counts what glGetError() has to tell; `where` names what was just done. Contexts with debug messages tell by
// themselves, at once.
void note_gl_errors(const char* where);

class GlContext {
public:
    GlContext() = default;
    GlContext(const GlContext&) = delete;
    GlContext& operator=(const GlContext&) = delete;
    virtual ~GlContext() = default;
    [[nodiscard]] virtual Result<void> make_current() = 0;
};

} // namespace ramus::render
