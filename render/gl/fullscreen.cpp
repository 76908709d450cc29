#include "render/gl/fullscreen.h"

namespace ramus::render {

Result<void> make_programs(std::initializer_list<ProgramSource> sources) {
    for (const ProgramSource& source : sources) {
        auto made = make_program(source.vertex, source.fragment, source.defines, source.geometry);
        if (!made) return tl::unexpected(made.error());
        *source.to = std::move(*made);
    }
    return {};
}

Result<void> Fullscreen::make(std::string_view fragment, std::string_view defines) {
    no_vertices_ = make_vertex_array();
    return make_programs({{&program_, "fullscreen.vert", fragment, defines}});
}

void Fullscreen::draw(Pixels pixels) const {
    if (pixels == Pixels::kCovered) {
        glEnable(GL_DEPTH_TEST);
        glDepthMask(GL_FALSE);
        glDepthFunc(GL_LESS);
    }
    glUseProgram(program_);
    glBindVertexArray(no_vertices_);
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glDisable(GL_DEPTH_TEST);
    glDepthMask(GL_TRUE);
}

} // namespace ramus::render
