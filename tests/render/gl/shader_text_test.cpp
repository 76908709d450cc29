// Shaders as drivers get them, and their complaints as people do: with our files and lines.
#include "render/gl/bindings.h"
#include "render/gl/gl_objects.h"
#include "render/gl/shader_text.h"
#include "tests/support/gl_test.h"

#include <doctest/doctest.h>
#include <map>

using namespace ramus::render;
using ramus::test::WatchedContext;

namespace {

// The line of a shader file, from 1, that begins so.
int line_of(std::string_view file, std::string_view beginning) {
    const std::string_view text = kShaderSources.at(file);
    int line = 1;
    for (std::size_t at = 0; at < text.size(); at = text.find('\n', at) + 1, ++line) {
        if (text.substr(at).starts_with(beginning)) return line;
        if (text.find('\n', at) == std::string_view::npos) break;
    }
    FAIL("no such line");
    return 0;
}

} // namespace

TEST_CASE("a shader that does not compile is told by file and line, inside of includes as well") {
    for (const GlVersion version : {GlVersion{4, 5}, GlVersion{4, 3}, GlVersion{3, 3}}) {
        CAPTURE(version.text());
        const WatchedContext context(version);
        struct Case {
            const char *vertex, *fragment, *define, *file, *line;
        };
        // Each breaks the one line that it names.
        for (const Case& one :
             {Case{"fullscreen.vert", "occlusion.frag", "#define kNothing =\n", "view.glsl", "const float kNothing"},
              Case{"fullscreen.vert", "occlusion.frag", "#define kGolden =\n", "occlusion.frag",
                   "    const mat2 kGolden"},
              Case{"fullscreen.vert", "shade.frag", "#define kSolid =\n", "ids.glsl", "const uint kSolid"},
              Case{"mark.vert", "mark.frag", "#define ink =\n", "mark.vert", "flat out vec3 ink"}}) {
            CAPTURE(one.define);
            const auto program = make_program(one.vertex, one.fragment, one.define);
            REQUIRE_FALSE(program.has_value());
            const std::string message = program.error().message();
            const std::string position =
                std::string(one.file) + ":" + std::to_string(line_of(one.file, one.line)) + ":";
            CHECK_MESSAGE(message.find(position) != std::string::npos, message, " does not name ", position);
            CHECK(message.find("update the graphics driver") != std::string::npos);
        }
        CHECK(make_program("fullscreen.vert", "none.frag").error().message().find("none.frag") != std::string::npos);
    }
}

TEST_CASE("logs of all drivers are turned to files and lines") {
    const std::vector<std::string> files{"shade.frag", "fallback.glsl", "view.glsl"};
    const auto turned = [&](const char* log) { return with_file_names(log, files); };
    CHECK(turned("2:13(5): error: syntax error\n") == "view.glsl:13: error: syntax error"); // Mesa
    CHECK(turned("0(7) : error C1008: undefined variable") ==
          "shade.frag:7: error C1008: undefined variable"); // NVIDIA
    CHECK(turned("ERROR: 1:3: 'x' : undeclared identifier") == "ERROR: fallback.glsl:3: 'x' : undeclared identifier");
    CHECK(turned("0:1(1): warning: a\n2:4(9): error: b") == "shade.frag:1: warning: a\nview.glsl:4: error: b");
    for (const char* other : {"", "Link error: out of registers", "9:1(1): error: no such file", "99999999999:1: what"})
        CHECK(turned(other) == other);
}

TEST_CASE("below 4.30 the text has no numbers, and tells them") {
    const ShaderText floor = shader_text("shade.frag", "#define GLASS\n", 330);
    CHECK(floor.glsl.starts_with("#version 330 core\n#define FALLBACK\n#define GLASS\n"));
    for (const char* newer :
         {"#version 450", "\n#include", "layout(location = k", "layout(binding = ", "layout(std140, binding"})
        CHECK(floor.glsl.find(newer) == std::string::npos);
    const auto number = [](const std::vector<ShaderText::Numbered>& named, std::string_view name) {
        for (const auto& one : named)
            if (one.name == name) return one.number;
        return -1;
    };
    CHECK(number(floor.samplers, "occlusion") == kUnitOcclusion);
    CHECK(number(floor.blocks, "Scene") == kBlockScene);
    CHECK(number(shader_text("fragment.frag", {}, 330).uniforms, "sample_positions") == kUniformSamplePositions);
    CHECK(shader_text("shade.frag", {}, 450).samplers.empty());
    const std::string vertex = shader_text("mark.vert", {}, 330, true).glsl;
    CHECK(vertex.find("2.0 * gl_Position.z - gl_Position.w") != std::string::npos);
}

TEST_CASE("every layout says its number, and no two of a program's have the same") {
    for (const auto& entry : kShaderSources) {
        const std::string_view file = entry.first;
        if (file.ends_with(".glsl")) continue;
        CAPTURE(file);
        const std::string glsl = shader_text(file, {}, 450).glsl;
        CHECK(glsl.find("binding = k") == std::string::npos);
        CHECK(glsl.find("location = k") == std::string::npos);
        const ShaderText floor = shader_text(file, {}, 330);
        std::map<int, std::string> samplers, uniforms;
        for (const auto& [name, number] : floor.samplers) {
            CHECK(number < kUnits);
            CHECK(samplers.try_emplace(number, name).first->second == name);
        }
        for (const auto& [name, number] : floor.uniforms) {
            CHECK(number < kUniforms);
            CHECK(uniforms.try_emplace(number, name).first->second == name);
        }
    }
}
