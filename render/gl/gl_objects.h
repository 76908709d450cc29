// Owners of GL objects, their memory, and programs from the embedded shaders. Moving is allowed, copying is not; each
// must die while its context is current.
//
// Graphics memory may run out in any allocation. Functions here then throw OutOfGraphicsMemory, as `new` throws: what
// was made dies, nothing is used that is not there, and Renderer::draw() returns it as an Error.
#pragma once

#include "core/base/error.h"
#include "core/base/shared_pages.h"
#include "render/gl/bindings.h"

#include <cstddef>
#include <glad/gl.h>
#include <glm/vec2.hpp>
#include <initializer_list>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string_view>
#include <utility>
#include <vector>

namespace ramus::render {

class OutOfGraphicsMemory : public std::runtime_error {
public:
    explicit OutOfGraphicsMemory(std::size_t bytes);
};

// GL objects that are alive, of all contexts: 0 once everything that draws is gone.
[[nodiscard]] int gl_objects_alive();
void count_gl_object(int change);
// Programs that the calling thread has linked so far. A driver takes its time for each, and for the first use.
[[nodiscard]] int gl_programs_made();

template <void (*destroy)(GLuint)> class GlObject {
public:
    GlObject() = default;
    explicit GlObject(GLuint id) : id_(id) { count_gl_object(id != 0 ? 1 : 0); }
    GlObject(GlObject&& other) noexcept : id_(std::exchange(other.id_, 0)) {}
    GlObject& operator=(GlObject&& other) noexcept {
        std::swap(id_, other.id_);
        return *this;
    }
    ~GlObject() {
        if (id_ == 0) return;
        destroy(id_);
        count_gl_object(-1);
    }
    operator GLuint() const { return id_; } // NOLINT: it stands for its name

private:
    GLuint id_ = 0;
};

inline void delete_buffer(GLuint id) { glDeleteBuffers(1, &id); }
inline void delete_texture(GLuint id) { glDeleteTextures(1, &id); }
inline void delete_framebuffer(GLuint id) { glDeleteFramebuffers(1, &id); }
inline void delete_vertex_array(GLuint id) { glDeleteVertexArrays(1, &id); }
inline void delete_query(GLuint id) { glDeleteQueries(1, &id); }
inline void delete_program(GLuint id) { glDeleteProgram(id); }
inline void delete_shader(GLuint id) { glDeleteShader(id); }

using Buffer = GlObject<delete_buffer>;
using Texture = GlObject<delete_texture>;
using Framebuffer = GlObject<delete_framebuffer>;
using VertexArray = GlObject<delete_vertex_array>;
using Query = GlObject<delete_query>;
using Program = GlObject<delete_program>;
using Shader = GlObject<delete_shader>;

// By one of OpenGL's functions that make objects; `target` is that of a texture.
template <class Object> [[nodiscard]] Object created(auto create, auto... target) {
    GLuint id = 0;
    create(target..., 1, &id);
    return Object(id);
}

// A point in the stream of commands that the graphics card passes some time.
class Fence {
public:
    Fence() = default;
    Fence(Fence&& other) noexcept : sync_(std::exchange(other.sync_, nullptr)) {}
    Fence& operator=(Fence&& other) noexcept {
        std::swap(sync_, other.sync_);
        return *this;
    }
    ~Fence() { glDeleteSync(sync_); } // none: nothing

    void put(); // here, after what was drawn so far
    // Whether all before it is done, after waiting for so long at most; true where none was put.
    [[nodiscard]] bool passed(double seconds);

private:
    GLsync sync_ = nullptr;
};

// An offset into the buffer that is bound, in the pointer that OpenGL takes it in.
[[nodiscard]] inline void* offset_pointer(std::size_t bytes) {
    return reinterpret_cast<void*>(bytes); // NOLINT(performance-no-int-to-ptr): nothing lies there
}

// `flags` as of glBufferStorage; `data` may be null.
[[nodiscard]] Buffer make_buffer(std::size_t bytes, const void* data, GLbitfield flags = 0);
struct GiveBackPages {
    std::size_t bytes = 0;
    void operator()(void* pages) const;
};

// A buffer for much that comes in pieces, by glNamedBufferSubData. A software rasteriser clears a buffer when it makes
// it, which takes seconds where it is large: there it lies in pages of this process's own memory, which the system
// clears as each is written (GL_AMD_pinned_memory).
class LargeBuffer {
public:
    LargeBuffer() = default;
    explicit LargeBuffer(std::size_t bytes);
    // Of these bytes, which take memory once as long as nothing else is written; where the driver takes no pages of
    // this process's own, or the system gives none, of as many bytes that are unset. `shared`: whether they are there.
    LargeBuffer(const SharedPages& pages, bool& shared);
    LargeBuffer(LargeBuffer&& other) noexcept = default;
    LargeBuffer& operator=(LargeBuffer&& other) noexcept {
        std::swap(pages_, other.pages_);
        std::swap(buffer_, other.buffer_);
        return *this;
    }
    ~LargeBuffer() = default;
    operator GLuint() const { return buffer_; } // NOLINT: it stands for its name

private:
    void lie_in(void* pages, std::size_t bytes);

    std::unique_ptr<void, GiveBackPages> pages_; // none: the memory is the driver's
    Buffer buffer_;                              // goes before its memory
};
[[nodiscard]] inline VertexArray make_vertex_array() { return created<VertexArray>(glCreateVertexArrays); }
// What is read of the one buffer that the array has.
void use_attributes(GLuint array, std::initializer_list<GLuint> attributes, GLuint source = 0);
// A texture without mipmaps, nearest filtering, of the given internal format; multisampled when samples > 0.
[[nodiscard]] Texture make_texture(GLenum format, int width, int height, int samples = 0);
// The same with layers, of GL_TEXTURE_2D_ARRAY or GL_TEXTURE_3D.
[[nodiscard]] Texture make_deep_texture(GLenum target, GLenum format, int width, int height, int depth);
void set_filter(GLuint texture, GLint filter); // its edges are clamped
// A buffer that shaders read texel by texel.
struct BufferTexture {
    Buffer buffer;
    Texture texture;
};
[[nodiscard]] BufferTexture make_buffer_texture(GLenum format, const void* data, std::size_t bytes);
[[nodiscard]] BufferTexture make_buffer_texture(GLenum format, const auto& texels) {
    return make_buffer_texture(format, texels.data(), texels.size() * sizeof texels[0]);
}
// Few values of one format that change from picture to picture, read by shaders texel by texel.
class TexelTable {
public:
    explicit TexelTable(GLenum format) : format_(format) {}
    // Grows as it is needed; of no texels nothing is sent. Throws OutOfGraphicsMemory.
    template <class Texel> void send(const std::vector<Texel>& texels) {
        send(texels.data(), texels.size() * sizeof(Texel));
    }
    operator GLuint() const { return table_.texture; } // NOLINT: it stands for its texture

private:
    void send(const void* texels, std::size_t bytes) {
        if (bytes == 0) return;
        if (bytes > capacity_) {
            table_ = make_buffer_texture(format_, nullptr, 2 * bytes);
            capacity_ = 2 * bytes;
        }
        glNamedBufferSubData(table_.buffer, 0, static_cast<GLsizeiptr>(bytes), texels);
    }

    GLenum format_;
    BufferTexture table_;
    std::size_t capacity_ = 0; // bytes
};

// A framebuffer that draws into `colours` (attachments 0, 1, ...) and tests against `depth` when it is not 0.
[[nodiscard]] Framebuffer make_framebuffer(std::initializer_list<GLuint> colours, GLuint depth = 0);

// What a single buffer or texture may take from now on, in bytes. Tests let memory run out with it.
void limit_gl_allocation(std::size_t bytes = std::numeric_limits<std::size_t>::max());

// From two or three of the embedded files, for the version of the current context (render/gl/shader_text.h). `defines`
// goes into all, after their #version lines. A failure names the file and the line.
[[nodiscard]] Result<Program> make_program(std::string_view vertex_shader, std::string_view fragment_shader,
                                           std::string_view defines = {}, std::string_view geometry_shader = {});

// Programs for passes: several made at once, and those that run over a picture's pixels.
struct ProgramSource { // as for make_program()
    Program* to;
    std::string_view vertex, fragment, defines = {}, geometry = {};
};
[[nodiscard]] Result<void> make_programs(std::initializer_list<ProgramSource> sources);

// Of rows from `first` to before `end` those to be drawn first by a software rasteriser: the row after them. They are
// few enough that another context can wait for them, and end where tiles of the rasteriser end. Rows are 0 or more.
[[nodiscard]] int end_of_band(int first, int end, int width);

// A fragment shader over the pixels of the framebuffer that is bound.
class Fullscreen {
public:
    [[nodiscard]] Result<void> make(std::string_view fragment, std::string_view defines = {});
    [[nodiscard]] bool made() const { return program_ != 0; }

    // Every pixel; every one, whose depth the program writes; or only those where the depth that is attached says that
    // there is something: the early depth test is the one branch that a software rasteriser really skips. The triangle
    // lies at depth 0, the far plane. Leaves the depth test off and depths written.
    enum class Pixels { kAll, kAllDepths, kCovered };
    void draw(Pixels pixels = Pixels::kAll) const;
    // The same in a rectangle, in GL's sense of y; leaves the scissor test off. On a software rasteriser it comes some
    // rows at a time, each waited for: Mesa has one for all contexts, and a window's would wait for all that is queued.
    void draw_in(glm::ivec2 at, glm::ivec2 size, Pixels pixels = Pixels::kAll) const;

    operator GLuint() const { return program_; } // NOLINT: it stands for its program

private:
    Program program_;
    VertexArray no_vertices_;
};

} // namespace ramus::render
