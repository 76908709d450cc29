#include "render/gl/gl_context.h"

#include "core/base/memory.h"
#include "render/gl/gl_fallback.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdio>
#include <glad/gl.h>
#include <limits>
#include <mutex>
#include <string_view>
#include <utility>

namespace ramus::render {

namespace {

// Debug messages arrive by a callback on any thread; function pointers belong to the process.
std::atomic<int> error_count{0};
std::mutex last_error_mutex;
std::string last_error;
GlVersion found_version;
GlVersion newest_allowed{99, 0};
// For the current context of a thread.
thread_local bool out_of_memory = false;
thread_local int looked_at = 0; // error_count at the last glGetError()

void count_error(std::string text) {
    std::fprintf(stderr, "ramus: OpenGL: %s\n", text.c_str());
    const std::lock_guard lock(last_error_mutex);
    last_error = std::move(text);
    ++error_count;
}

void GLAD_API_PTR note_message(GLenum source, GLenum type, GLuint, GLenum severity, GLsizei, const GLchar* message,
                               const void*) {
    if (type != GL_DEBUG_TYPE_ERROR && severity != GL_DEBUG_SEVERITY_HIGH) return;
    if (source == GL_DEBUG_SOURCE_SHADER_COMPILER) return; // make_program() reports it
    // Running out of memory is not an error of the program; the allocating code reports it.
    if (std::string_view(message).find("OUT_OF_MEMORY") != std::string_view::npos) return;
    count_error(message);
}

std::string text_of(GLenum name) {
    const auto* value = glGetString(name);
    return value != nullptr ? reinterpret_cast<const char*>(value) : "unknown";
}

// Constants of two extensions, which core loaders lack. Values are in KiB.
constexpr GLenum kDedicatedMemory = 0x9047;  // GPU_MEMORY_INFO_DEDICATED_VIDMEM_NVX
constexpr GLenum kFreeBufferMemory = 0x87FB; // VBO_FREE_MEMORY_ATI: of the whole pool, and three other values

bool has_extension(std::string_view name) {
    GLint count = 0;
    glGetIntegerv(GL_NUM_EXTENSIONS, &count);
    for (GLint i = 0; i < count; ++i)
        if (reinterpret_cast<const char*>(glGetStringi(GL_EXTENSIONS, static_cast<GLuint>(i))) == name) return true;
    return false;
}

} // namespace

Result<void> load_gl(GlLoader loader, const void* context, const std::string& remedy) {
    const int loaded = gladLoadGL(loader);
    if (loaded == 0) return fail("OpenGL could not be loaded", {}, "check the graphics driver, or use `ramus render`");
    found_version = std::min(GlVersion{GLAD_VERSION_MAJOR(loaded), GLAD_VERSION_MINOR(loaded)}, newest_allowed);
    if (found_version < kOldestGl)
        return fail("OpenGL " + found_version.text() + " is too old, " + kOldestGl.text() + " is needed",
                    gl_description(),
                    remedy.empty() ? "update the graphics driver, or set LIBGL_ALWAYS_SOFTWARE=1" : remedy);
    install_gl_fallback(GLAD_MAKE_VERSION(found_version.major, found_version.minor), context);
    GLint flags = 0;
    glGetIntegerv(GL_CONTEXT_FLAGS, &flags);
    if (glDebugMessageCallback != nullptr) {
        glEnable(GL_DEBUG_OUTPUT);
        if ((flags & GL_CONTEXT_FLAG_DEBUG_BIT) != 0) glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
        glDebugMessageCallback(note_message, nullptr);
    }
    return {};
}

GlVersion gl_version() { return found_version; }
void limit_gl_version(GlVersion newest) { newest_allowed = newest; }

std::string gl_renderer() { return text_of(GL_RENDERER); }

std::string gl_description() { return gl_renderer() + ", OpenGL " + text_of(GL_VERSION); }

bool is_software_rasteriser() {
    const std::string name = gl_description();
    for (const char* known : {"llvmpipe", "softpipe", "swrast", "SWR", "SwiftShader"})
        if (name.find(known) != std::string::npos) return true;
    return false;
}

bool gl_takes_own_memory() { return is_software_rasteriser() && has_extension("GL_AMD_pinned_memory"); }

double graphics_memory_bytes() {
    if (is_software_rasteriser()) return memory_limit(0.0);
    std::array<GLint, 4> kilobytes{};
    if (has_extension("GL_NVX_gpu_memory_info"))
        glGetIntegerv(kDedicatedMemory, kilobytes.data());
    else if (has_extension("GL_ATI_meminfo"))
        glGetIntegerv(kFreeBufferMemory, kilobytes.data());
    return kilobytes[0] > 0 ? 1024.0 * kilobytes[0] : std::numeric_limits<double>::infinity();
}

void note_gl_errors(const char* where) {
    constexpr int kMost = 16; // glGetError() never ends without a context or with a lost one
    for (int i = 0; i < kMost; ++i) {
        const GLenum error = glGetError();
        if (error == GL_NO_ERROR) break;
        if (error == GL_OUT_OF_MEMORY)
            out_of_memory = true;
        else if (error_count == looked_at) // not reported by a debug message
            count_error("error " + std::to_string(error) + " after " + where);
    }
    looked_at = error_count;
}

int gl_error_count() {
    if (glad_glGetError != nullptr) note_gl_errors("the last call");
    return error_count;
}

bool gl_ran_out_of_memory() {
    note_gl_errors("an allocation");
    return std::exchange(out_of_memory, false);
}

std::string gl_last_error() {
    const std::lock_guard lock(last_error_mutex);
    return last_error;
}

} // namespace ramus::render
