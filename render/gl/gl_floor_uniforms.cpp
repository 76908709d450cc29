// The half of gl_floor that gives uniforms, samplers and blocks their numbers. Below 4.3 the linker chooses locations:
// calls name those of the shader files, and are sent on to the ones that were chosen.
#include "render/gl/bindings.h"
#include "render/gl/gl_floor.h"

#include <array>
#include <map>
#include <string>
#include <unordered_map>

namespace ramus::render {

namespace {

using Locations = std::array<GLint, kUniforms>; // by those of the shader files

std::unordered_map<GLuint, Locations>* programs = nullptr; // of the current context; null: it needs none of this

// What glad loaded, before its pointers were turned here.
struct Native {
    PFNGLUSEPROGRAMPROC use_program = nullptr;
    PFNGLUNIFORM1IPROC uniform1i = nullptr;
    PFNGLUNIFORM1UIPROC uniform1ui = nullptr;
    PFNGLUNIFORM1FPROC uniform1f = nullptr;
    PFNGLUNIFORM2IPROC uniform2i = nullptr;
    PFNGLUNIFORM2FPROC uniform2f = nullptr;
    PFNGLUNIFORM3FPROC uniform3f = nullptr;
    PFNGLUNIFORM4FPROC uniform4f = nullptr;
    PFNGLUNIFORM2FVPROC uniform2fv = nullptr;
    PFNGLUNIFORMMATRIX3FVPROC matrix3 = nullptr;
    PFNGLUNIFORMMATRIX4FVPROC matrix4 = nullptr;
};
Native native;
GLuint current = 0; // program in use

GLint chosen(GLint location) {
    const auto found = programs->find(current);
    if (found == programs->end() || location < 0) return location;
    return found->second.at(static_cast<std::size_t>(location)); // -1, which is ignored: the shader has no use for it
}

void GLAD_API_PTR use_program(GLuint program) {
    current = program;
    native.use_program(program);
}

void GLAD_API_PTR uniform1i(GLint at, GLint x) { native.uniform1i(chosen(at), x); }
void GLAD_API_PTR uniform1ui(GLint at, GLuint x) { native.uniform1ui(chosen(at), x); }
void GLAD_API_PTR uniform1f(GLint at, GLfloat x) { native.uniform1f(chosen(at), x); }
void GLAD_API_PTR uniform2i(GLint at, GLint x, GLint y) { native.uniform2i(chosen(at), x, y); }
void GLAD_API_PTR uniform2f(GLint at, GLfloat x, GLfloat y) { native.uniform2f(chosen(at), x, y); }
void GLAD_API_PTR uniform3f(GLint at, GLfloat x, GLfloat y, GLfloat z) { native.uniform3f(chosen(at), x, y, z); }
void GLAD_API_PTR uniform4f(GLint at, GLfloat x, GLfloat y, GLfloat z, GLfloat w) {
    native.uniform4f(chosen(at), x, y, z, w);
}
void GLAD_API_PTR uniform2fv(GLint at, GLsizei count, const GLfloat* values) {
    native.uniform2fv(chosen(at), count, values);
}
void GLAD_API_PTR matrix3(GLint at, GLsizei count, GLboolean transpose, const GLfloat* values) {
    native.matrix3(chosen(at), count, transpose, values);
}
void GLAD_API_PTR matrix4(GLint at, GLsizei count, GLboolean transpose, const GLfloat* values) {
    native.matrix4(chosen(at), count, transpose, values);
}

class Using {
public:
    explicit Using(GLuint program) : before_(current) { use_program(program); }
    ~Using() { use_program(before_); }
    Using(const Using&) = delete;
    Using& operator=(const Using&) = delete;

private:
    GLuint before_;
};

void GLAD_API_PTR program_uniform1i(GLuint program, GLint at, GLint x) {
    const Using here(program);
    uniform1i(at, x);
}
void GLAD_API_PTR program_uniform1f(GLuint program, GLint at, GLfloat x) {
    const Using here(program);
    uniform1f(at, x);
}
void GLAD_API_PTR program_uniform2i(GLuint program, GLint at, GLint x, GLint y) {
    const Using here(program);
    uniform2i(at, x, y);
}
void GLAD_API_PTR program_uniform2f(GLuint program, GLint at, GLfloat x, GLfloat y) {
    const Using here(program);
    uniform2f(at, x, y);
}
void GLAD_API_PTR program_uniform3f(GLuint program, GLint at, GLfloat x, GLfloat y, GLfloat z) {
    const Using here(program);
    uniform3f(at, x, y, z);
}

} // namespace

void install_uniform_floor(int version, const void* context) {
    // Of the process, as GL's function pointers are, and by context.
    static std::map<const void*, std::unordered_map<GLuint, Locations>> all;
    programs = version < GLAD_MAKE_VERSION(4, 3) ? &all[context] : nullptr;
    if (programs == nullptr) return;
    GLint in_use = 0;
    glGetIntegerv(GL_CURRENT_PROGRAM, &in_use);
    current = static_cast<GLuint>(in_use);
    native = {glad_glUseProgram, glad_glUniform1i,        glad_glUniform1ui,      glad_glUniform1f,
              glad_glUniform2i,  glad_glUniform2f,        glad_glUniform3f,       glad_glUniform4f,
              glad_glUniform2fv, glad_glUniformMatrix3fv, glad_glUniformMatrix4fv};
    glad_glUseProgram = use_program;
    glad_glUniform1i = uniform1i;
    glad_glUniform1ui = uniform1ui;
    glad_glUniform1f = uniform1f;
    glad_glUniform2i = uniform2i;
    glad_glUniform2f = uniform2f;
    glad_glUniform3f = uniform3f;
    glad_glUniform4f = uniform4f;
    glad_glUniform2fv = uniform2fv;
    glad_glUniformMatrix3fv = matrix3;
    glad_glUniformMatrix4fv = matrix4;
    glad_glProgramUniform1i = program_uniform1i;
    glad_glProgramUniform1f = program_uniform1f;
    glad_glProgramUniform2i = program_uniform2i;
    glad_glProgramUniform2f = program_uniform2f;
    glad_glProgramUniform3f = program_uniform3f;
    // A context that could more, told to do with less: what it must not use is not there.
    glad_glMemoryBarrier = nullptr;
    glad_glClearNamedBufferSubData = nullptr;
    glad_glGetNamedBufferSubData = nullptr;
}

void number_program(GLuint program, const ShaderText& vertex, const ShaderText& fragment) {
    if (programs == nullptr) return;
    Locations& locations = (*programs)[program];
    locations.fill(-1);
    const auto locate = [&](const std::string& name) { return glGetUniformLocation(program, name.c_str()); };
    const Using here(program);
    for (const ShaderText* text : {&vertex, &fragment}) {
        for (const auto& [name, number] : text->uniforms)
            if (const GLint at = locate(name); at >= 0) locations.at(static_cast<std::size_t>(number)) = at;
        for (const auto& [name, number] : text->samplers)
            if (const GLint at = locate(name); at >= 0) native.uniform1i(at, number);
        for (const auto& [name, number] : text->blocks) {
            const GLuint index = glGetUniformBlockIndex(program, name.c_str());
            if (index != GL_INVALID_INDEX) glUniformBlockBinding(program, index, static_cast<GLuint>(number));
        }
    }
}

} // namespace ramus::render
