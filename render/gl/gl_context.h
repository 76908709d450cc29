// GlContext: the interface between the renderer and a provider of OpenGL core, version 3.3 or later. OSMesa and EGL
// need no display (render/gl/headless_context.h); the window creates its context with GLFW and then calls
// load_gl(glfwGetProcAddress).
//
// GL function pointers belong to the process, not to the context: after switching to a context of another kind, call
// load_gl() again (GlContext::make_current() does). Two threads may each use a context of the same kind if
// gl_takes_threads(). Nothing here links libGL: under OSMesa that would load a second, wrong implementation.
#pragma once

#include "core/base/error.h"

#include <array>
#include <compare>
#include <string>

namespace ramus::render {

using GlFunction = void (*)();
using GlLoader = GlFunction (*)(const char* name);

// A version of OpenGL. kOldestGl is the minimum; code that creates contexts requests kWantedGl in this order.
struct GlVersion {
    int major = 0, minor = 0;
    // NOLINTNEXTLINE(modernize-use-nullptr): there is no pointer
    auto operator<=>(const GlVersion&) const = default;
    [[nodiscard]] std::string text() const { return std::to_string(major) + "." + std::to_string(minor); }
};
inline constexpr GlVersion kOldestGl{3, 3};
inline constexpr std::array kWantedGl{GlVersion{4, 5}, GlVersion{4, 3}, kOldestGl};

// Loads GL's functions for the current context and enables debug messages if the context supports them. On contexts
// older than 4.5, missing functions are emulated with 3.3 (render/gl/gl_fallback.h). `context` identifies the context
// among those that exist at the same time. Fails for contexts older than 3.3, with the version found and `remedy`.
[[nodiscard]] Result<void> load_gl(GlLoader loader, const void* context = nullptr, const std::string& remedy = {});

// The version that load_gl() found, capped by limit_gl_version().
[[nodiscard]] GlVersion gl_version();
// Whether shaders can write lists (4.3). With lists, glass takes one pass; without, one pass per layer.
[[nodiscard]] inline bool gl_has_lists() { return gl_version() >= GlVersion{4, 3}; }
// Whether another thread may use a second context of the same kind: from 4.5 on, because the emulation binds objects.
[[nodiscard]] inline bool gl_takes_threads() { return gl_version() >= GlVersion{4, 5}; }
// For tests: from the next load_gl() on, contexts count as no newer than this.
void limit_gl_version(GlVersion newest);

// "llvmpipe (LLVM 15.0.6, 256 bits), OpenGL 4.5 (Core Profile) Mesa 22.3.6"
[[nodiscard]] std::string gl_description();

// "llvmpipe (LLVM 15.0.6, 256 bits)"
[[nodiscard]] std::string gl_renderer();

// Whether OpenGL is a software rasteriser.
[[nodiscard]] bool is_software_rasteriser();

// Whether OpenGL is a software rasteriser that accepts buffers in this process's own memory (GL_AMD_pinned_memory).
[[nodiscard]] bool gl_takes_own_memory();

// Memory available to the current context, in bytes: a graphics card's own if its driver reports it
// (GL_NVX_gpu_memory_info, GL_ATI_meminfo), half of the machine's for software rasterisers, otherwise infinite.
[[nodiscard]] double graphics_memory_bytes();

// Number of GL errors and messages of high severity in this process, except out-of-memory errors. 0 in a correct
// program; tests check it. gl_last_error() returns the latest.
[[nodiscard]] int gl_error_count();
[[nodiscard]] std::string gl_last_error();
// Whether memory ran out since the last call. Other pending errors are counted as by note_gl_errors().
[[nodiscard]] bool gl_ran_out_of_memory();
// Counts the errors pending in glGetError(); `where` names the last operation. Contexts with debug messages report
// errors by themselves, at once.
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
