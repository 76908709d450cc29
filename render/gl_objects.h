// Owners of GL objects, and programs from the embedded shaders. Moving is allowed, copying is not; each must die while
// its context is current.
#pragma once

#include "core/base/error.h"

#include <glad/gl.h>
#include <initializer_list>
#include <string_view>
#include <utility>

namespace ramus::render {

template <void (*destroy)(GLuint)> class GlObject {
public:
    GlObject() = default;
    explicit GlObject(GLuint id) : id_(id) {}
    GlObject(GlObject&& other) noexcept : id_(std::exchange(other.id_, 0)) {}
    GlObject& operator=(GlObject&& other) noexcept {
        std::swap(id_, other.id_);
        return *this;
    }
    ~GlObject() {
        if (id_ != 0) destroy(id_);
    }
    operator GLuint() const { return id_; } // NOLINT: it stands for its name

private:
    GLuint id_ = 0;
};

inline void delete_buffer(GLuint id) { glDeleteBuffers(1, &id); }
inline void delete_texture(GLuint id) { glDeleteTextures(1, &id); }
inline void delete_framebuffer(GLuint id) { glDeleteFramebuffers(1, &id); }
inline void delete_vertex_array(GLuint id) { glDeleteVertexArrays(1, &id); }
inline void delete_program(GLuint id) { glDeleteProgram(id); }

using Buffer = GlObject<delete_buffer>;
using Texture = GlObject<delete_texture>;
using Framebuffer = GlObject<delete_framebuffer>;
using VertexArray = GlObject<delete_vertex_array>;
using Program = GlObject<delete_program>;

[[nodiscard]] Buffer make_buffer();
[[nodiscard]] VertexArray make_vertex_array();
// A texture without mipmaps, nearest filtering, of the given internal format; multisampled when samples > 0.
[[nodiscard]] Texture make_texture(GLenum format, int width, int height, int samples = 0);
// A framebuffer that draws into `colours` (attachments 0, 1, ...) and tests against `depth` when it is not 0.
[[nodiscard]] Framebuffer make_framebuffer(std::initializer_list<GLuint> colours, GLuint depth = 0);

// From two of the embedded files; `#include "name"` lines are replaced by the file of that name.
// `defines` goes into both, after their #version lines.
[[nodiscard]] Result<Program> make_program(std::string_view vertex_shader, std::string_view fragment_shader,
                                           std::string_view defines = {});

} // namespace ramus::render
