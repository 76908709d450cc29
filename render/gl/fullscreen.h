// Programs for passes: several made at once, and those that run over a picture's pixels.
#pragma once

#include "render/gl/gl_objects.h"

#include <initializer_list>
#include <string_view>

namespace ramus::render {

struct ProgramSource { // as for make_program()
    Program* to;
    std::string_view vertex, fragment, defines = {}, geometry = {};
};
[[nodiscard]] Result<void> make_programs(std::initializer_list<ProgramSource> sources);

// A fragment shader over the pixels of the framebuffer that is bound.
class Fullscreen {
public:
    [[nodiscard]] Result<void> make(std::string_view fragment, std::string_view defines = {});
    [[nodiscard]] bool made() const { return program_ != 0; }

    // Every pixel, or only those where the depth that is attached says that there is something: the early depth test is
    // the one branch that a software rasteriser really skips. The triangle lies at depth 0, the far plane. Leaves the
    // depth test off and depths written.
    enum class Pixels { kAll, kCovered };
    void draw(Pixels pixels = Pixels::kAll) const;

    operator GLuint() const { return program_; } // NOLINT: it stands for its program

private:
    Program program_;
    VertexArray no_vertices_;
};

} // namespace ramus::render
