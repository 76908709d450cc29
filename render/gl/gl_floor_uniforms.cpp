// The half of gl_floor that gives uniforms, samplers and blocks their numbers. Below 4.3 the linker chooses locations:
// calls name those of the shader files, and are sent on to the ones that were chosen.
#include "render/gl/bindings.h"
#include "render/gl/gl_floor.h"

#include <array>
#include <map>
#include <string>
#include <type_traits>
#include <unordered_map>

namespace ramus::render {

namespace {

using Locations = std::array<GLint, kUniforms>; // by those of the shader files

std::unordered_map<GLuint, Locations>* programs = nullptr; // of the current context; null: it needs none of this

GLuint program_in_use = 0;

GLint chosen(GLint location) {
    const auto found = programs->find(program_in_use);
    if (found == programs->end() || location < 0) return location;
    return found->second.at(static_cast<std::size_t>(location)); // -1, which is ignored: the shader has no use for it
}

// glad's `function` as it was loaded, before it was turned here.
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

// `of_program` as `uniform`, of a program that need not be in use.
template <auto& uniform> void put_in_terms_of_use(auto& of_program) {
    of_program = [](GLuint program, GLint at, auto... values) {
        const Using here(program);
        uniform(at, values...);
    };
}

} // namespace

void install_uniform_floor(int version, const void* context) {
    // Of the process, as GL's function pointers are, and by context.
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
            if (const GLint at = locate(name); at >= 0) loaded<glad_glUniform1i>(at, number);
        for (const auto& [name, number] : text->blocks) {
            const GLuint index = glGetUniformBlockIndex(program, name.c_str());
            if (index != GL_INVALID_INDEX) glUniformBlockBinding(program, index, static_cast<GLuint>(number));
        }
    }
}

} // namespace ramus::render
