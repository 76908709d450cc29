#include "render/gl_context.h"

#include <cstdio>
#include <glad/gl.h>
#include <utility>

namespace ramus::render {

namespace {

int error_count = 0;
bool out_of_memory = false;
std::string last_error;

void GLAD_API_PTR note_message(GLenum, GLenum type, GLuint id, GLenum severity, GLsizei, const GLchar* message,
                               const void*) {
    if (type != GL_DEBUG_TYPE_ERROR) return;
    ++error_count;
    last_error = message;
    std::fprintf(stderr, "ramus: OpenGL error %u (severity 0x%x): %s\n", id, severity, message);
}

} // namespace

Result<void> load_gl(GlLoader loader) {
    const int version = gladLoadGL(loader);
    if (version == 0) return fail("OpenGL could not be loaded", {}, "check the graphics driver, or use `ramus render`");
    if (version < GLAD_MAKE_VERSION(4, 5))
        return fail("OpenGL " + std::to_string(GLAD_VERSION_MAJOR(version)) + "." +
                        std::to_string(GLAD_VERSION_MINOR(version)) + " is too old, 4.5 is needed",
                    gl_description(), "update the graphics driver, or set LIBGL_ALWAYS_SOFTWARE=1");
    GLint flags = 0;
    glGetIntegerv(GL_CONTEXT_FLAGS, &flags);
    if (glDebugMessageCallback != nullptr) {
        glEnable(GL_DEBUG_OUTPUT);
        if ((flags & GL_CONTEXT_FLAG_DEBUG_BIT) != 0) glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
        glDebugMessageCallback(note_message, nullptr);
    }
    return {};
}

std::string gl_description() {
    const auto text = [](GLenum name) {
        const auto* value = glGetString(name);
        return std::string(value != nullptr ? reinterpret_cast<const char*>(value) : "unknown");
    };
    return text(GL_RENDERER) + ", OpenGL " + text(GL_VERSION);
}

bool is_software_rasteriser() {
    const std::string name = gl_description();
    for (const char* known : {"llvmpipe", "softpipe", "swrast", "SWR", "SwiftShader"})
        if (name.find(known) != std::string::npos) return true;
    return false;
}

int gl_error_count() {
    for (GLenum error = glGetError(); error != GL_NO_ERROR; error = glGetError()) {
        out_of_memory = out_of_memory || error == GL_OUT_OF_MEMORY;
        // With debug output on, the callback has already counted this one.
        if (last_error.empty()) {
            ++error_count;
            last_error = "glGetError " + std::to_string(error);
        }
    }
    return error_count;
}

bool gl_ran_out_of_memory() {
    (void)gl_error_count();
    return std::exchange(out_of_memory, false);
}

const std::string& gl_last_error() { return last_error; }

} // namespace ramus::render
