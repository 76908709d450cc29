// ShaderText: a shader file as a driver gets it, for the version of GLSL that the driver has. Files are written once,
// for `#version 450 core`, which they need not say; before each stands what all have in common: numbers, ids, the
// language of shaders/look. `#include "name"` lines are replaced by the file of that name, names of
// shaders/bindings.glsl in layout(...) by their numbers, and compilers' messages are turned back to files and lines.
// Below 4.30 a shader cannot say where its uniforms, samplers and blocks lie: that is taken out of the text and told,
// for the program to be given it when it is linked (render/gl/gl_floor.h).
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace ramus::render {

struct ShaderText {
    std::string glsl;
    std::vector<std::string> files; // by the number that #line directives, and so the driver's messages, have for them

    // What `layout(...)` said, below 4.30.
    struct Numbered {
        std::string name;
        int number = 0;
    };
    std::vector<Numbered> uniforms, samplers, blocks;
};

// The text of the files in shaders/, by their path in there, embedded at build time.
extern const std::map<std::string_view, std::string_view> kShaderSources;

// The embedded file `name`. `defines` goes after the #version line. `version` is 450, 430 or 330; at 330 FLOOR is
// defined. With `full_depth`, clip space has depths from -w to w: a vertex shader, which reckons from 0 to w, is
// brought to that at its end, and FULL_DEPTH is defined for what comes after it.
[[nodiscard]] ShaderText shader_text(std::string_view name, std::string_view defines, int version,
                                     bool full_depth = false);

// A compiler's log with names in place of numbers: "view.glsl:13: error: ...". Knows the forms of Mesa, NVIDIA, AMD,
// Intel and Apple; what it does not know stays as it is.
[[nodiscard]] std::string with_file_names(const std::string& log, const std::vector<std::string>& files);

} // namespace ramus::render
