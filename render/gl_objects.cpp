#include "render/gl_objects.h"

#include "render/shader_sources.h"

#include <string>
#include <vector>

namespace ramus::render {

namespace {

std::string source_of(std::string_view name) {
    const auto found = kShaderSources.find(name);
    if (found == kShaderSources.end()) return "#error no shader file of this name\n";
    std::string text(found->second);
    constexpr std::string_view kInclude = "#include \"";
    for (std::size_t at = text.find(kInclude); at != std::string::npos; at = text.find(kInclude, at)) {
        const std::size_t end = text.find('"', at + kInclude.size());
        const std::string included = source_of(text.substr(at + kInclude.size(), end - at - kInclude.size()));
        text.replace(at, end + 1 - at, included);
    }
    return text;
}

Result<GLuint> compile(GLenum stage, std::string_view name, std::string_view defines) {
    std::string text = source_of(name);
    if (const std::size_t version = text.find("#version"); version != std::string::npos)
        text.insert(text.find('\n', version) + 1, defines);
    const char* const pointer = text.c_str();
    const GLuint shader = glCreateShader(stage);
    glShaderSource(shader, 1, &pointer, nullptr);
    glCompileShader(shader);
    GLint compiled = GL_FALSE;
    glGetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
    if (compiled == GL_TRUE) return shader;
    std::string log(4096, '\0');
    GLsizei length = 0;
    glGetShaderInfoLog(shader, static_cast<GLsizei>(log.size()), &length, log.data());
    log.resize(static_cast<std::size_t>(length));
    glDeleteShader(shader);
    return fail("shader does not compile: " + log, std::string(name), "update the graphics driver");
}

} // namespace

Buffer make_buffer() {
    GLuint id = 0;
    glCreateBuffers(1, &id);
    return Buffer(id);
}

VertexArray make_vertex_array() {
    GLuint id = 0;
    glCreateVertexArrays(1, &id);
    return VertexArray(id);
}

Texture make_texture(GLenum format, int width, int height, int samples) {
    GLuint id = 0;
    glCreateTextures(samples > 0 ? GL_TEXTURE_2D_MULTISAMPLE : GL_TEXTURE_2D, 1, &id);
    if (samples > 0) {
        glTextureStorage2DMultisample(id, samples, format, width, height, GL_TRUE);
    } else {
        glTextureStorage2D(id, 1, format, width, height);
        glTextureParameteri(id, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
        glTextureParameteri(id, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
        glTextureParameteri(id, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
        glTextureParameteri(id, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    }
    return Texture(id);
}

Framebuffer make_framebuffer(std::initializer_list<GLuint> colours, GLuint depth) {
    GLuint id = 0;
    glCreateFramebuffers(1, &id);
    std::vector<GLenum> attachments;
    for (const GLuint texture : colours) {
        attachments.push_back(GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(attachments.size()));
        glNamedFramebufferTexture(id, attachments.back(), texture, 0);
    }
    glNamedFramebufferDrawBuffers(id, static_cast<GLsizei>(attachments.size()), attachments.data());
    if (depth != 0) glNamedFramebufferTexture(id, GL_DEPTH_ATTACHMENT, depth, 0);
    return Framebuffer(id);
}

Result<Program> make_program(std::string_view vertex_shader, std::string_view fragment_shader,
                             std::string_view defines) {
    const auto vertex = compile(GL_VERTEX_SHADER, vertex_shader, defines);
    if (!vertex) return tl::unexpected(vertex.error());
    const auto fragment = compile(GL_FRAGMENT_SHADER, fragment_shader, defines);
    if (!fragment) {
        glDeleteShader(*vertex);
        return tl::unexpected(fragment.error());
    }
    Program program(glCreateProgram());
    glAttachShader(program, *vertex);
    glAttachShader(program, *fragment);
    glLinkProgram(program);
    glDeleteShader(*vertex);
    glDeleteShader(*fragment);
    GLint linked = GL_FALSE;
    glGetProgramiv(program, GL_LINK_STATUS, &linked);
    if (linked == GL_TRUE) return program;
    std::string log(4096, '\0');
    GLsizei length = 0;
    glGetProgramInfoLog(program, static_cast<GLsizei>(log.size()), &length, log.data());
    log.resize(static_cast<std::size_t>(length));
    return fail("shaders do not link: " + log, std::string(fragment_shader), "update the graphics driver");
}

} // namespace ramus::render
