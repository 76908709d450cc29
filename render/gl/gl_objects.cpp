#include "render/gl/gl_objects.h"

#include "core/base/free_in_background.h"
#include "render/gl/gl_context.h"
#include "render/gl/gl_fallback.h"
#include "render/gl/shader_text.h"

#include <algorithm>
#include <atomic>
#include <limits>
#include <string>
#include <sys/mman.h>
#include <vector>

namespace ramus::render {

namespace {

// For tests: number of objects in all contexts, programs linked per thread, and the simulated limit of memory.
std::atomic<int> alive{0};
thread_local int programs_made = 0;
std::size_t largest_allocation = std::numeric_limits<std::size_t>::max();

std::size_t texel_bytes(GLenum format) {
    return format == GL_R8 ? 1 : format == GL_RG32UI || format == GL_RGB16F ? 8 : format == GL_RGBA32F ? 16 : 4;
}

// Wraps an allocation; earlier errors are not attributed to it.
template <class Allocate> void allocate(std::size_t bytes, const Allocate& call) {
    if (bytes > largest_allocation) throw OutOfGraphicsMemory(bytes);
    (void)gl_ran_out_of_memory();
    call();
    if (gl_ran_out_of_memory()) throw OutOfGraphicsMemory(bytes);
}

std::size_t area(int width, int height) { return static_cast<std::size_t>(width) * static_cast<std::size_t>(height); }

struct CompiledShader {
    Shader shader;
    ShaderText text;
};

template <class GetLog> std::string log_of(GLuint id, const GetLog& get) {
    std::string log(8192, '\0');
    GLsizei length = 0;
    get(id, static_cast<GLsizei>(log.size()), &length, log.data());
    log.resize(static_cast<std::size_t>(length));
    return log;
}

Result<CompiledShader> compile(GLenum stage, std::string_view name, std::string_view defines) {
    const GlVersion version = gl_version();
    const bool depth_control = version >= GlVersion{4, 5};
    CompiledShader made;
    made.text = shader_text(name, defines, depth_control ? 450 : gl_has_lists() ? 430 : 330, !depth_control);
    made.shader = Shader(glCreateShader(stage));
    const char* const pointer = made.text.glsl.c_str();
    glShaderSource(made.shader, 1, &pointer, nullptr);
    glCompileShader(made.shader);
    GLint compiled = GL_FALSE;
    glGetShaderiv(made.shader, GL_COMPILE_STATUS, &compiled);
    if (compiled == GL_TRUE) return made;
    return fail(
        "a shader does not compile: " + with_file_names(log_of(made.shader, glGetShaderInfoLog), made.text.files),
        std::string(name), "update the graphics driver, or draw without it: ramus render (" + gl_description() + ")");
}

} // namespace

OutOfGraphicsMemory::OutOfGraphicsMemory(std::size_t bytes)
    : std::runtime_error(
          "out of graphics memory" +
          (bytes == 0 ? std::string()
                      : ": " + std::to_string((bytes + (1U << 20) - 1) >> 20) + " MiB more are not to be had")) {}

int gl_objects_alive() { return alive; }
int gl_programs_made() { return programs_made; }
void count_gl_object(int change) { alive += change; }
void limit_gl_allocation(std::size_t bytes) { largest_allocation = bytes; }

void Fence::put() {
    glDeleteSync(sync_);
    sync_ = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
    glFlush();
}

bool Fence::passed(double seconds) {
    if (sync_ == nullptr) return true;
    constexpr double kLongest = 1e3;
    const auto nanoseconds = static_cast<GLuint64>(1e9 * std::clamp(seconds, 0.0, kLongest));
    if (glClientWaitSync(sync_, 0, nanoseconds) == GL_TIMEOUT_EXPIRED) return false;
    glDeleteSync(std::exchange(sync_, nullptr));
    return true;
}

Buffer make_buffer(std::size_t bytes, const void* data, GLbitfield flags) {
    Buffer buffer = created<Buffer>(glCreateBuffers);
    allocate(bytes, [&] { glNamedBufferStorage(buffer, static_cast<GLsizeiptr>(bytes), data, flags); });
    return buffer;
}

namespace {

constexpr GLenum kOwnMemory = 0x9160; // GL_EXTERNAL_VIRTUAL_MEMORY_BUFFER_AMD

} // namespace

// Waits for pending draws from these pages.
void GiveBackPages::operator()(void* pages) const {
    glFinish();
    free_in_background([pages, all = bytes] { munmap(pages, all); });
}

LargeBuffer::LargeBuffer(std::size_t bytes) {
    constexpr std::size_t kLarge = std::size_t{1} << 20;
    if (bytes < kLarge || !gl_takes_own_memory()) {
        buffer_ = make_buffer(bytes, nullptr, GL_DYNAMIC_STORAGE_BIT);
        return;
    }
    buffer_ = created<Buffer>(glCreateBuffers);
    allocate(bytes, [&] {
        void* pages = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
        if (pages == MAP_FAILED) throw OutOfGraphicsMemory(bytes);
        lie_in(pages, bytes);
    });
}

LargeBuffer::LargeBuffer(const SharedPages& pages, bool& shared) {
    void* again = gl_takes_own_memory() ? pages.map_private_copy() : nullptr;
    shared = again != nullptr;
    if (!shared) {
        *this = LargeBuffer(pages.bytes());
        return;
    }
    buffer_ = created<Buffer>(glCreateBuffers);
    allocate(pages.bytes(), [&] { lie_in(again, pages.bytes()); });
}

// Binding to this target makes the driver use the pages as the buffer's memory.
void LargeBuffer::lie_in(void* pages, std::size_t bytes) {
    pages_ = {pages, GiveBackPages{bytes}};
    glBindBuffer(kOwnMemory, buffer_);
    glBufferData(kOwnMemory, static_cast<GLsizeiptr>(bytes), pages, GL_DYNAMIC_DRAW);
    glBindBuffer(kOwnMemory, 0);
}

void set_filter(GLuint texture, GLint filter) {
    for (const GLenum when : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER}) glTextureParameteri(texture, when, filter);
    for (const GLenum side : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T, GL_TEXTURE_WRAP_R})
        glTextureParameteri(texture, side, GL_CLAMP_TO_EDGE);
}

Texture make_texture(GLenum format, int width, int height, int samples) {
    Texture texture = created<Texture>(glCreateTextures, samples > 0 ? GL_TEXTURE_2D_MULTISAMPLE : GL_TEXTURE_2D);
    if (samples > 0) {
        allocate(area(width, height) * texel_bytes(format) * static_cast<std::size_t>(samples),
                 [&] { glTextureStorage2DMultisample(texture, samples, format, width, height, GL_TRUE); });
    } else {
        allocate(area(width, height) * texel_bytes(format),
                 [&] { glTextureStorage2D(texture, 1, format, width, height); });
        set_filter(texture, GL_NEAREST);
    }
    return texture;
}

Texture make_deep_texture(GLenum target, GLenum format, int width, int height, int depth) {
    Texture texture = created<Texture>(glCreateTextures, target);
    allocate(area(width, height) * static_cast<std::size_t>(depth) * texel_bytes(format),
             [&] { glTextureStorage3D(texture, 1, format, width, height, depth); });
    set_filter(texture, GL_NEAREST);
    return texture;
}

BufferTexture make_buffer_texture(GLenum format, const void* data, std::size_t bytes) {
    Buffer buffer = make_buffer(bytes, data, GL_DYNAMIC_STORAGE_BIT);
    Texture texture = created<Texture>(glCreateTextures, GL_TEXTURE_BUFFER);
    glTextureBuffer(texture, format, buffer);
    return {std::move(buffer), std::move(texture)};
}

Framebuffer make_framebuffer(std::initializer_list<GLuint> colours, GLuint depth) {
    Framebuffer framebuffer = created<Framebuffer>(glCreateFramebuffers);
    std::vector<GLenum> attachments;
    for (const GLuint texture : colours) {
        attachments.push_back(GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(attachments.size()));
        glNamedFramebufferTexture(framebuffer, attachments.back(), texture, 0);
    }
    glNamedFramebufferDrawBuffers(framebuffer, static_cast<GLsizei>(attachments.size()), attachments.data());
    if (depth != 0) glNamedFramebufferTexture(framebuffer, GL_DEPTH_ATTACHMENT, depth, 0);
    return framebuffer;
}

Result<Program> make_program(std::string_view vertex_shader, std::string_view fragment_shader, std::string_view defines,
                             std::string_view geometry_shader) {
    RAMUS_TRY(vertex, compile(GL_VERTEX_SHADER, vertex_shader, defines));
    RAMUS_TRY(geometry, geometry_shader.empty() ? Result<CompiledShader>()
                                                : compile(GL_GEOMETRY_SHADER, geometry_shader, defines));
    RAMUS_TRY(fragment, compile(GL_FRAGMENT_SHADER, fragment_shader, defines));
    Program program(glCreateProgram());
    ++programs_made;
    const auto of_all = [&](auto call) {
        for (const auto* made : {&vertex, &geometry, &fragment})
            if (made->shader != 0) call(program, made->shader);
    };
    of_all(glAttachShader);
    glLinkProgram(program);
    of_all(glDetachShader); // no longer needed after linking
    GLint linked = GL_FALSE;
    glGetProgramiv(program, GL_LINK_STATUS, &linked);
    if (linked != GL_TRUE)
        return fail("shaders do not link: " + log_of(program, glGetProgramInfoLog), std::string(fragment_shader),
                    "update the graphics driver, or draw without it: ramus render (" + gl_description() + ")");
    number_program(program, vertex.text, fragment.text);
    return program;
}

Result<void> make_programs(std::initializer_list<ProgramSource> sources) {
    for (const ProgramSource& source : sources) {
        RAMUS_TRY(made, make_program(source.vertex, source.fragment, source.defines, source.geometry));
        *source.to = std::move(made);
    }
    return {};
}

void use_attributes(GLuint array, std::initializer_list<GLuint> attributes, GLuint source) {
    for (const GLuint attribute : attributes) {
        glVertexArrayAttribBinding(array, attribute, source);
        glEnableVertexArrayAttrib(array, attribute);
    }
}

Result<void> Fullscreen::make(std::string_view fragment, std::string_view defines) {
    no_vertices_ = make_vertex_array();
    return make_programs({{&program_, "fullscreen.vert", fragment, defines}});
}

void Fullscreen::draw(Pixels pixels) const {
    if (pixels != Pixels::kAll) {
        glEnable(GL_DEPTH_TEST);
        glDepthMask(pixels == Pixels::kAllDepths ? GL_TRUE : GL_FALSE);
        glDepthFunc(pixels == Pixels::kAllDepths ? GL_ALWAYS : GL_LESS);
    }
    glUseProgram(program_);
    glBindVertexArray(no_vertices_);
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glDisable(GL_DEPTH_TEST);
    glDepthMask(GL_TRUE);
}

int end_of_band(int first, int end, int width) {
    constexpr int kBandPixels = 1 << 16, kTile = 64; // of Mesa's rasteriser
    const int tiles = std::max(kBandPixels / (std::max(width, 1) * kTile), 1);
    return std::min(end, (first / kTile + tiles) * kTile);
}

void Fullscreen::draw_in(glm::ivec2 at, glm::ivec2 size, Pixels pixels) const {
    if (size.x <= 0 || size.y <= 0) return;
    const bool in_bands = is_software_rasteriser();
    glEnable(GL_SCISSOR_TEST);
    Fence before;
    for (int first = at.y, end = 0; first < at.y + size.y; first = end) {
        (void)before.passed(std::numeric_limits<double>::infinity());
        end = in_bands ? end_of_band(first, at.y + size.y, size.x) : at.y + size.y;
        glScissor(at.x, first, size.x, end - first);
        draw(pixels);
        if (in_bands) before.put();
    }
    glDisable(GL_SCISSOR_TEST);
}

} // namespace ramus::render
