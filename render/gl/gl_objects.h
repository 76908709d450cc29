// RAII owners of GL objects, their allocation, and programs from the embedded shaders. They are movable, not copyable,
// and must be destroyed while their context is current.
//
// Any allocation may run out of graphics memory. Functions here then throw OutOfGraphicsMemory, as `new` throws; partly
// built objects are destroyed, and Renderer::draw() returns an Error.
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

// Number of live GL objects in all contexts; 0 after everything that draws was destroyed.
[[nodiscard]] int gl_objects_alive();
void count_gl_object(int change);
// Number of programs that the calling thread has linked. Linking, and the first use, take the driver noticeable time.
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

// Creates one object with a glCreate... function; `target`: of a texture.
template <class Object> [[nodiscard]] Object created(auto create, auto... target) {
    GLuint id = 0;
    create(target..., 1, &id);
    return Object(id);
}

// A point in the stream of GL commands, to wait for or to poll.
class Fence {
public:
    Fence() = default;
    Fence(Fence&& other) noexcept : sync_(std::exchange(other.sync_, nullptr)) {}
    Fence& operator=(Fence&& other) noexcept {
        std::swap(sync_, other.sync_);
        return *this;
    }
    ~Fence() { glDeleteSync(sync_); }

    void put(); // after the commands issued so far
    // Whether the commands before the fence are complete, after waiting at most this long; true if put() was never
    // called.
    [[nodiscard]] bool passed(double seconds);

private:
    GLsync sync_ = nullptr;
};

// A byte offset into the bound buffer, as the pointer that OpenGL expects.
[[nodiscard]] inline void* offset_pointer(std::size_t bytes) {
    return reinterpret_cast<void*>(bytes); // NOLINT(performance-no-int-to-ptr): never dereferenced
}

// `flags`: of glBufferStorage; `data` may be null.
[[nodiscard]] Buffer make_buffer(std::size_t bytes, const void* data, GLbitfield flags = 0);
struct GiveBackPages {
    std::size_t bytes = 0;
    void operator()(void* pages) const;
};

// A large buffer that glNamedBufferSubData fills in pieces. A software rasteriser clears new buffers, which takes
// seconds for large ones. There the buffer uses pages of this process's own memory (GL_AMD_pinned_memory), which the
// system clears on first write.
class LargeBuffer {
public:
    LargeBuffer() = default;
    explicit LargeBuffer(std::size_t bytes);
    // Shares these pages, without a copy as long as nothing else is written. If the driver or the system does not
    // support that, allocates uninitialised memory of the same size. `shared`: out, whether the pages are shared.
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

    std::unique_ptr<void, GiveBackPages> pages_; // null: the driver owns the memory
    Buffer buffer_;                              // destroyed before its memory
};
[[nodiscard]] inline VertexArray make_vertex_array() { return created<VertexArray>(glCreateVertexArrays); }
// Enables these attributes; they read from the buffer at the array's binding index `source`.
void use_attributes(GLuint array, std::initializer_list<GLuint> attributes, GLuint source = 0);
// A texture without mipmaps, with nearest filtering; multisampled if samples > 0.
[[nodiscard]] Texture make_texture(GLenum format, int width, int height, int samples = 0);
// The same for GL_TEXTURE_2D_ARRAY or GL_TEXTURE_3D.
[[nodiscard]] Texture make_deep_texture(GLenum target, GLenum format, int width, int height, int depth);
void set_filter(GLuint texture, GLint filter); // also clamps to the edge
// A buffer that shaders read texel by texel.
struct BufferTexture {
    Buffer buffer;
    Texture texture;
};
[[nodiscard]] BufferTexture make_buffer_texture(GLenum format, const void* data, std::size_t bytes);
[[nodiscard]] BufferTexture make_buffer_texture(GLenum format, const auto& texels) {
    return make_buffer_texture(format, texels.data(), texels.size() * sizeof texels[0]);
}
// A small buffer texture whose values change from picture to picture.
class TexelTable {
public:
    explicit TexelTable(GLenum format) : format_(format) {}
    // Grows when necessary; sends nothing if there are no texels. Throws OutOfGraphicsMemory.
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

// Limits the size of a single buffer or texture from now on, in bytes. Tests use it to exhaust memory.
void limit_gl_allocation(std::size_t bytes = std::numeric_limits<std::size_t>::max());

// Builds a program from two or three embedded files, for the version of the current context (render/gl/shader_text.h).
// `defines` goes into each, after the #version line. Errors name the file and the line.
[[nodiscard]] Result<Program> make_program(std::string_view vertex_shader, std::string_view fragment_shader,
                                           std::string_view defines = {}, std::string_view geometry_shader = {});

// A program to build with make_programs().
struct ProgramSource { // see make_program()
    Program* to;
    std::string_view vertex, fragment, defines = {}, geometry = {};
};
[[nodiscard]] Result<void> make_programs(std::initializer_list<ProgramSource> sources);

// On a software rasteriser rows are drawn in bands. Returns the end of the first band of the rows [first, end): few
// enough rows that another context can wait for them, ending at a tile border of the rasteriser. `first` is 0 or more.
[[nodiscard]] int end_of_band(int first, int end, int width);

// Runs a fragment shader over the pixels of the bound framebuffer.
class Fullscreen {
public:
    [[nodiscard]] Result<void> make(std::string_view fragment, std::string_view defines = {});
    [[nodiscard]] bool made() const { return program_ != 0; }

    // kAll: every pixel. kAllDepths: every pixel, and the program writes its depth. kCovered: only pixels whose
    // attached depth is not empty; the early depth test is the only branch that a software rasteriser really skips. The
    // triangle lies at depth 0, the far plane. Leaves the depth test off and depth writes on.
    enum class Pixels { kAll, kAllDepths, kCovered };
    void draw(Pixels pixels = Pixels::kAll) const;
    // The same in a rectangle, y from below; leaves the scissor test off. On a software rasteriser it draws and waits
    // for some rows at a time: Mesa has one rasteriser for all contexts, and a window's context would wait for
    // everything queued.
    void draw_in(glm::ivec2 at, glm::ivec2 size, Pixels pixels = Pixels::kAll) const;

    operator GLuint() const { return program_; } // NOLINT: it stands for its program

private:
    Program program_;
    VertexArray no_vertices_;
};

} // namespace ramus::render
