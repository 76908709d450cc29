#include "render/renderer/passes/gl_state.h"

#include <array>

namespace ramus::render {

void begin_passes(glm::ivec2 size) {
    glDisable(GL_SCISSOR_TEST);
    glDisable(GL_BLEND);
    glDisable(GL_STENCIL_TEST);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
    glViewport(0, 0, size.x, size.y);
    glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
}

void end_passes() {
    glDisable(GL_SCISSOR_TEST);
    glDisable(GL_CULL_FACE);
    glDisable(GL_DEPTH_TEST);
    glDepthMask(GL_TRUE);
    glClipControl(GL_LOWER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
    glDepthFunc(GL_LESS);
    glBindVertexArray(0);
    glUseProgram(0);
    for (GLuint unit = 0; unit < kUnits; ++unit) glBindTextureUnit(unit, 0);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
}

void draw_front_faces(bool write_depth) {
    glEnable(GL_DEPTH_TEST);
    glDepthMask(write_depth ? GL_TRUE : GL_FALSE);
    glDepthFunc(GL_GREATER);
    glEnable(GL_CULL_FACE);
    glCullFace(GL_BACK);
    glFrontFace(GL_CCW);
    glEnable(GL_MULTISAMPLE);
}

void draw_opaque_into(const SampleTarget& target, bool values) {
    glBindFramebuffer(GL_FRAMEBUFFER, values ? target.valued_framebuffer : target.framebuffer);
    draw_front_faces(true);
}

void clear_samples() {
    const std::array<GLuint, 4> nothing{};
    const GLfloat farthest = 0.0F;
    glClearBufferuiv(GL_COLOR, 0, nothing.data());
    glClearBufferfv(GL_DEPTH, 0, &farthest);
}

void begin_blending(Blending how) {
    glEnable(GL_BLEND);
    glBlendEquation(GL_FUNC_ADD);
    glBlendFunc(how == Blending::kUnder ? GL_ONE_MINUS_DST_ALPHA : GL_ONE,
                how == Blending::kOver ? GL_ONE_MINUS_SRC_ALPHA : GL_ONE);
}

} // namespace ramus::render
