// The part of gl_fallback that assigns numbers to uniforms, samplers and blocks. Below 4.3 the linker chooses
// locations: calls use the numbers of the shader files, which are translated here.
#include "render/gl/bindings.h"
#include "render/gl/gl_fallback.h"

#include <array>
#include <map>
#include <string>
#include <type_traits>
#include <unordered_map>

namespace ramus::render {

namespace {

using Locations = std::array<GLint, kUniforms>; // actual locations by the numbers of the shader files

std::unordered_map<GLuint, Locations>* programs = nullptr; // of the current context; null: not needed

GLuint program_in_use = 0;

GLint chosen(GLint location) {
    const auto found = programs->find(program_in_use);
    if (found == programs->end() || location < 0) return location;
    return found->second.at(static_cast<std::size_t>(location)); // -1 is ignored: the shader does not use the uniform
}

// glad's original `function`, before it was replaced here.
template <auto& function> std::remove_reference_t<decltype(function)> loaded = nullptr;

template <auto& function> void turn(std::remove_reference_t<decltype(function)> here) {
    loaded<function> = function;
    function = here;
}

template <auto&... uniforms> void turn_uniforms() {
    (turn<uniforms>([](GLint at, auto... values) { loaded<uniforms>(chosen(at), values...); }), ...);
}

void GLAD_API_PTR use_program(GLuint program) {
    program_in_use = program;
    loaded<glad_glUseProgram>(program);
}

class Using {
public:
    explicit Using(GLuint program) : before_(program_in_use) { use_program(program); }
    ~Using() { use_program(before_); }
    Using(const Using&) = delete;
    Using& operator=(const Using&) = delete;

private:
    GLuint before_;
};

// Implements `of_program`, which takes a program, by `uniform`, which uses the current program.
template <auto& uniform> void put_in_terms_of_use(auto& of_program) {
    of_program = [](GLuint program, GLint at, auto... values) {
        const Using here(program);
        uniform(at, values...);
    };
}

} // namespace

void install_uniform_fallback(int version, const void* context) {
    // One per context; static, since function pointers belong to the process.
    static std::map<const void*, std::unordered_map<GLuint, Locations>> all;
    programs = version < GLAD_MAKE_VERSION(4, 3) ? &all[context] : nullptr;
    if (programs == nullptr) return;
    GLint in_use = 0;
    glGetIntegerv(GL_CURRENT_PROGRAM, &in_use);
    program_in_use = static_cast<GLuint>(in_use);
    turn<glad_glUseProgram>(use_program);
    turn_uniforms<glad_glUniform1i, glad_glUniform1ui, glad_glUniform1f, glad_glUniform2i, glad_glUniform2f,
                  glad_glUniform3f, glad_glUniform4f, glad_glUniform2fv, glad_glUniformMatrix3fv,
                  glad_glUniformMatrix4fv>();
    put_in_terms_of_use<glad_glUniform1i>(glad_glProgramUniform1i);
    put_in_terms_of_use<glad_glUniform1f>(glad_glProgramUniform1f);
    put_in_terms_of_use<glad_glUniform2i>(glad_glProgramUniform2i);
    put_in_terms_of_use<glad_glUniform2f>(glad_glProgramUniform2f);
    put_in_terms_of_use<glad_glUniform3f>(glad_glProgramUniform3f);
    put_in_terms_of_use<glad_glUniform4f>(glad_glProgramUniform4f);
    put_in_terms_of_use<glad_glUniform2fv>(glad_glProgramUniform2fv);
    // For a context that is limited to an older version: functions that must not be used are null.
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
            if (const GLint at = locate(name); at >= 0) loaded<glad_glUniform1i>(at, number);
        for (const auto& [name, number] : text->blocks) {
            const GLuint index = glGetUniformBlockIndex(program, name.c_str());
            if (index != GL_INVALID_INDEX) glUniformBlockBinding(program, index, static_cast<GLuint>(number));
        }
    }
}

} // namespace ramus::render
