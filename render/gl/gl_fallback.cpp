#include "render/gl/gl_fallback.h"

#include "render/gl/gl_objects.h"

#include <array>
#include <map>
#include <type_traits>
#include <unordered_map>

namespace ramus::render {

namespace {

// No other code uses these binding points, so bindings need not be restored.
constexpr GLenum kBuffer = GL_COPY_WRITE_BUFFER;
constexpr GLenum kUnit = GL_TEXTURE0 + 31; // 3.3 guarantees 48

// 4.5 separates vertex formats from vertex buffers, in any order; here they are combined.
struct Attribute {
    GLint size = 0;
    GLenum type = 0;
    GLboolean normalised = GL_FALSE;
    bool whole = false; // an integer in the shader
    GLuint offset = 0;
    GLuint source = 0; // binding index of its buffer
};
struct VertexBuffer {
    GLuint buffer = 0;
    GLintptr offset = 0;
    GLsizei stride = 0;
};
struct VertexSource {
    std::array<VertexBuffer, 2> buffers{};
    std::array<Attribute, 8> attributes{};
};

struct Names {
    std::unordered_map<GLuint, GLenum> targets;       // of textures by name, needed for binding
    std::unordered_map<GLuint, VertexSource> sources; // by vertex array
};
Names* names = nullptr; // of the current context

GLuint bound(GLenum what) {
    GLint id = 0;
    glGetIntegerv(what, &id);
    return static_cast<GLuint>(id);
}

// Classes that bind an object to the target on which a function of 3.3 operates.

struct BufferBound {
    explicit BufferBound(GLuint id) { glBindBuffer(target, id); }
    GLenum target = kBuffer;
};

struct TextureBound {
    explicit TextureBound(GLuint id) : target(names->targets[id]) {
        glActiveTexture(kUnit);
        glBindTexture(target, id);
    }
    GLenum target;
};

// Binds during its lifetime and then restores the previous binding, queried by `asked`. `at`: the target.
template <GLenum asked, void (*bind)(GLuint), GLenum at> class BoundForNow {
public:
    explicit BoundForNow(GLuint id) : before_(bound(asked)) { bind(id); }
    ~BoundForNow() { bind(before_); }
    BoundForNow(const BoundForNow&) = delete;
    BoundForNow& operator=(const BoundForNow&) = delete;
    GLenum target = at;

private:
    GLuint before_;
};

void draw_into(GLuint framebuffer) { glBindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer); }
using DrawnInto = BoundForNow<GL_DRAW_FRAMEBUFFER_BINDING, draw_into, GL_DRAW_FRAMEBUFFER>;

void bind_array(GLuint array) { glBindVertexArray(array); }
using ArrayBound = BoundForNow<GL_VERTEX_ARRAY_BINDING, bind_array, GL_ELEMENT_ARRAY_BUFFER>;

// Implements `function`, which takes an object, by `older`, which has the same further parameters and uses the bound
// object.
template <class Bind, auto& older> void put_in_terms_of(auto& function) {
    function = [](GLuint id, auto... values) {
        const Bind here(id);
        if constexpr (std::is_invocable_v<decltype(older), GLenum, decltype(values)...>)
            return older(here.target, values...);
        else
            return older(values...);
    };
}

// Implements `function`, which creates objects, by `generate`: a generated name becomes an object when it is first
// bound.
template <class Bind, auto& generate> void create_by(auto& function) {
    function = [](GLsizei count, GLuint* ids) {
        generate(count, ids);
        for (GLsizei i = 0; i < count; ++i) const Bind created(ids[i]);
    };
}

// Makes `function`, which deletes objects, also delete their entries in `known`, since drivers reuse names.
template <auto known> void forget_on(auto& function) {
    static std::remove_reference_t<decltype(function)> loaded; // glad's original function
    loaded = function;
    function = [](GLsizei count, const GLuint* ids) {
        for (GLsizei i = 0; i < count; ++i) (names->*known).erase(ids[i]);
        loaded(count, ids);
    };
}

// Buffers.

void GLAD_API_PTR buffer_storage(GLuint id, GLsizeiptr bytes, const void* data, GLbitfield flags) {
    const BufferBound here(id);
    const bool read = (flags & GL_MAP_READ_BIT) != 0, changes = (flags & GL_DYNAMIC_STORAGE_BIT) != 0;
    glBufferData(kBuffer, bytes, data, read ? GL_STREAM_READ : changes ? GL_DYNAMIC_DRAW : GL_STATIC_DRAW);
}

// Textures.

void GLAD_API_PTR create_textures(GLenum target, GLsizei count, GLuint* ids) {
    glGenTextures(count, ids);
    for (GLsizei i = 0; i < count; ++i) {
        names->targets[ids[i]] = target;
        const TextureBound created(ids[i]);
    }
}

void GLAD_API_PTR bind_texture_unit(GLuint unit, GLuint id) {
    glActiveTexture(GL_TEXTURE0 + unit);
    if (id != 0) {
        glBindTexture(names->targets[id], id);
        return;
    }
    for (const GLenum target : {GL_TEXTURE_1D, GL_TEXTURE_2D, GL_TEXTURE_3D, GL_TEXTURE_2D_ARRAY, GL_TEXTURE_BUFFER,
                                GL_TEXTURE_2D_MULTISAMPLE})
        glBindTexture(target, 0);
}

struct PixelFormat {
    GLenum format, type;
};

// A pixel format that is valid for an internal format; irrelevant without data, but glTexImage checks it.
PixelFormat pixels_of(GLenum inner) {
    if (inner == GL_RG32UI) return {GL_RG_INTEGER, GL_UNSIGNED_INT};
    return {inner == GL_DEPTH_COMPONENT32F       ? GLenum{GL_DEPTH_COMPONENT}
            : inner == GL_R8 || inner == GL_R32F ? GLenum{GL_RED}
            : inner == GL_RGB16F                 ? GLenum{GL_RGB}
                                                 : GLenum{GL_RGBA},
            GL_FLOAT};
}

// Implements `function` by `older`, glTexImage with the same number of dimensions.
template <auto& older> void put_storage_in_terms_of(auto& function) {
    function = [](GLuint id, GLsizei, GLenum inner, auto... size) {
        const GLenum target = TextureBound(id).target;
        const PixelFormat p = pixels_of(inner);
        older(target, 0, static_cast<GLint>(inner), size..., 0, p.format, p.type, nullptr);
        glTexParameteri(target, GL_TEXTURE_MAX_LEVEL, 0);
    };
}

void GLAD_API_PTR get_texture_image(GLuint id, GLint level, GLenum format, GLenum type, GLsizei, void* data) {
    glGetTexImage(TextureBound(id).target, level, format, type, data);
}

// Framebuffers.

// NOLINTNEXTLINE(readability-function-size): OpenGL's own parameters
void GLAD_API_PTR blit_framebuffer(GLuint from, GLuint to, GLint x0, GLint y0, GLint x1, GLint y1, GLint to_x0,
                                   GLint to_y0, GLint to_x1, GLint to_y1, GLbitfield mask, GLenum filter) {
    const GLuint read_before = bound(GL_READ_FRAMEBUFFER_BINDING);
    const DrawnInto here(to);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, from);
    glBlitFramebuffer(x0, y0, x1, y1, to_x0, to_y0, to_x1, to_y1, mask, filter);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, read_before);
}

// Vertex arrays.

void point(const VertexSource& source, GLuint index) {
    const Attribute& a = source.attributes[index];
    const VertexBuffer& from = source.buffers.at(a.source);
    if (from.buffer == 0 || a.size == 0) return;
    const auto* offset = offset_pointer(static_cast<std::size_t>(from.offset) + a.offset);
    glBindBuffer(GL_ARRAY_BUFFER, from.buffer);
    if (a.whole)
        glVertexAttribIPointer(index, a.size, a.type, from.stride, offset);
    else
        glVertexAttribPointer(index, a.size, a.type, a.normalised, from.stride, offset);
    glBindBuffer(GL_ARRAY_BUFFER, 0);
}

// NOLINTNEXTLINE(readability-function-size): OpenGL's own parameters
void GLAD_API_PTR vertex_array_vertex_buffer(GLuint array, GLuint number, GLuint buffer, GLintptr offset,
                                             GLsizei stride) {
    const ArrayBound here(array);
    VertexSource& source = names->sources[array];
    source.buffers.at(number) = {buffer, offset, stride};
    for (GLuint i = 0; i < source.attributes.size(); ++i) point(source, i);
}

void set_format(GLuint array, GLuint index, const Attribute& attribute) {
    const ArrayBound here(array);
    VertexSource& source = names->sources[array];
    const GLuint from = source.attributes.at(index).source;
    source.attributes[index] = attribute;
    source.attributes[index].source = from;
    point(source, index);
}

void GLAD_API_PTR vertex_array_binding(GLuint array, GLuint index, GLuint from) {
    const ArrayBound here(array);
    VertexSource& source = names->sources[array];
    source.attributes.at(index).source = from;
    point(source, index);
}

void GLAD_API_PTR vertex_array_format(GLuint array, GLuint index, GLint size, GLenum type, GLboolean normalised,
                                      GLuint offset) {
    set_format(array, index, {size, type, normalised, false, offset, 0});
}

void GLAD_API_PTR vertex_array_integer_format(GLuint array, GLuint index, GLint size, GLenum type, GLuint offset) {
    set_format(array, index, {size, type, GL_FALSE, true, offset, 0});
}

} // namespace

void install_uniform_fallback(int version, const void* context); // gl_fallback_uniforms.cpp

void install_gl_fallback(int version, const void* context) {
    // One per context; static, since function pointers belong to the process.
    static std::map<const void*, Names> all;
    names = &all[context];
    if (version >= GLAD_MAKE_VERSION(4, 5)) return install_uniform_fallback(version, context);
    create_by<BufferBound, glad_glGenBuffers>(glad_glCreateBuffers);
    glad_glNamedBufferStorage = buffer_storage;
    put_in_terms_of<BufferBound, glad_glBufferSubData>(glad_glNamedBufferSubData);
    put_in_terms_of<BufferBound, glad_glGetBufferSubData>(glad_glGetNamedBufferSubData);
    put_in_terms_of<BufferBound, glad_glMapBufferRange>(glad_glMapNamedBufferRange);
    put_in_terms_of<BufferBound, glad_glUnmapBuffer>(glad_glUnmapNamedBuffer);
    put_in_terms_of<BufferBound, glad_glClearBufferSubData>(glad_glClearNamedBufferSubData);
    glad_glCreateTextures = create_textures;
    forget_on<&Names::targets>(glad_glDeleteTextures);
    glad_glBindTextureUnit = bind_texture_unit;
    put_storage_in_terms_of<glad_glTexImage1D>(glad_glTextureStorage1D);
    put_storage_in_terms_of<glad_glTexImage2D>(glad_glTextureStorage2D);
    put_storage_in_terms_of<glad_glTexImage3D>(glad_glTextureStorage3D);
    put_in_terms_of<TextureBound, glad_glTexImage2DMultisample>(glad_glTextureStorage2DMultisample);
    put_in_terms_of<TextureBound, glad_glTexBuffer>(glad_glTextureBuffer);
    put_in_terms_of<TextureBound, glad_glTexParameteri>(glad_glTextureParameteri);
    put_in_terms_of<TextureBound, glad_glTexParameteriv>(glad_glTextureParameteriv);
    put_in_terms_of<TextureBound, glad_glTexSubImage1D>(glad_glTextureSubImage1D);
    put_in_terms_of<TextureBound, glad_glTexSubImage2D>(glad_glTextureSubImage2D);
    put_in_terms_of<TextureBound, glad_glTexSubImage3D>(glad_glTextureSubImage3D);
    glad_glGetTextureImage = get_texture_image;
    create_by<DrawnInto, glad_glGenFramebuffers>(glad_glCreateFramebuffers);
    put_in_terms_of<DrawnInto, glad_glFramebufferTexture>(glad_glNamedFramebufferTexture);
    put_in_terms_of<DrawnInto, glad_glFramebufferTextureLayer>(glad_glNamedFramebufferTextureLayer);
    put_in_terms_of<DrawnInto, glad_glDrawBuffers>(glad_glNamedFramebufferDrawBuffers);
    put_in_terms_of<DrawnInto, glad_glCheckFramebufferStatus>(glad_glCheckNamedFramebufferStatus);
    glad_glBlitNamedFramebuffer = blit_framebuffer;
    create_by<ArrayBound, glad_glGenVertexArrays>(glad_glCreateVertexArrays);
    forget_on<&Names::sources>(glad_glDeleteVertexArrays);
    glad_glVertexArrayVertexBuffer = vertex_array_vertex_buffer;
    put_in_terms_of<ArrayBound, glad_glBindBuffer>(glad_glVertexArrayElementBuffer);
    glad_glVertexArrayAttribFormat = vertex_array_format;
    glad_glVertexArrayAttribIFormat = vertex_array_integer_format;
    glad_glVertexArrayAttribBinding = vertex_array_binding;
    put_in_terms_of<ArrayBound, glad_glEnableVertexAttribArray>(glad_glEnableVertexArrayAttrib);
    glad_glClipControl = [](GLenum, GLenum) {}; // shaders convert depths
    install_uniform_fallback(version, context);
}

} // namespace ramus::render
