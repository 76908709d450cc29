// ShaderText: an embedded shader file, preprocessed for the driver's version of GLSL. Shaders are written for `#version
// 450 core`, which they omit. Each gets a common preamble (numbers, ids, the language of shaders/look). `#include
// "name"` lines are replaced by that file, and names from shaders/bindings.glsl in layout(...) by their numbers. Below
// 4.30 a shader cannot declare the locations of uniforms, samplers and blocks: these are removed from the text and
// listed, and number_program() (render/gl/gl_fallback.h) assigns them after linking.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace ramus::render {

struct ShaderText {
    std::string glsl;
    std::vector<std::string> files; // indexed by the file number in #line directives and in the driver's messages

    // The numbers that layout(...) declared; below 4.30 only.
    struct Numbered {
        std::string name;
        int number = 0;
    };
    std::vector<Numbered> uniforms, samplers, blocks;
};

// The embedded files of shaders/ by their relative path.
extern const std::map<std::string_view, std::string_view> kShaderSources;

// Preprocesses the embedded file `name`. `defines` goes after the #version line. `version`: 450, 430 or 330; at 330
// FALLBACK is defined. `full_depth`: clip-space depths run from -w to w. Vertex shaders, which compute depths from 0 to
// w, get a conversion at their end, and FULL_DEPTH is defined for later stages.
[[nodiscard]] ShaderText shader_text(std::string_view name, std::string_view defines, int version,
                                     bool full_depth = false);

// Replaces file numbers in a compiler's log by names: "view.glsl:13: error: ...". Supports the formats of Mesa, NVIDIA,
// AMD, Intel and Apple; other text is unchanged.
[[nodiscard]] std::string with_file_names(const std::string& log, const std::vector<std::string>& files);

} // namespace ramus::render
