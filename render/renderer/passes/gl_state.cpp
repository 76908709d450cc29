#include "render/renderer/passes/gl_state.h"

#include <array>
#include <glm/geometric.hpp>

namespace ramus::render {

void begin_passes(glm::ivec2 size) {
    end_cut();
    glDisable(GL_SCISSOR_TEST);
    glDisable(GL_BLEND);
    glDisable(GL_STENCIL_TEST);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
    glViewport(0, 0, size.x, size.y);
    glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
}

void end_passes() {
    end_cut();
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

// The plane is set in any case: Mesa's rasteriser was seen to clip by the last one although clip distances were off.
void begin_cut(const Frame& frame, const glm::dvec3& origin, double scale) {
    if (!frame.cut_away) return glUniform4f(kUniformCut, 0.0F, 0.0F, 0.0F, 1.0F);
    const glm::vec3 normal(-scale * frame.cut_away->normal);
    const double away = glm::dot(frame.cut_away->normal, frame.cut_away->point - origin);
    glEnable(GL_CLIP_DISTANCE0);
    glUniform4f(kUniformCut, normal.x, normal.y, normal.z, static_cast<float>(away));
}

void end_cut() { glDisable(GL_CLIP_DISTANCE0); }

void clear_caps(const SampleTarget& target) {
    glBindFramebuffer(GL_FRAMEBUFFER, target.caps_framebuffer);
    glDepthMask(GL_TRUE);
    glStencilMask(~GLuint{0});
    glClearBufferfi(GL_DEPTH_STENCIL, 0, 0.0F, 0);
}

void begin_caps(const SampleTarget& target, CapStep step, bool values) {
    const bool count = step == CapStep::kCount;
    const GLboolean colour = count ? GL_FALSE : GL_TRUE;
    glBindFramebuffer(GL_FRAMEBUFFER, values ? target.valued_caps_framebuffer : target.caps_framebuffer);
    draw_front_faces(!count);
    glColorMask(colour, colour, colour, colour);
    glEnable(GL_STENCIL_TEST);
    glStencilFunc(count ? GL_ALWAYS : GL_NOTEQUAL, 0, ~GLuint{0});
    glStencilOpSeparate(GL_FRONT, GL_KEEP, GL_KEEP, count ? GL_DECR_WRAP : GL_KEEP);
    glStencilOpSeparate(GL_BACK, GL_KEEP, GL_KEEP, count ? GL_INCR_WRAP : GL_KEEP);
    glCullFace(GL_FRONT);
    if (!count) return;
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
}

void end_caps() {
    glDisable(GL_STENCIL_TEST);
    glStencilOp(GL_KEEP, GL_KEEP, GL_KEEP);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glDepthMask(GL_TRUE);
    glCullFace(GL_BACK);
}

void use_cap_normal(const Frame& frame, const ViewSetup& view) {
    const glm::vec3 normal = view.to_eye * glm::vec3(frame.cut_away->normal);
    glUniform4f(kUniformCap, normal.x, normal.y, normal.z, 1.0F);
}

void use_no_caps() { glUniform4f(kUniformCap, 0.0F, 0.0F, 0.0F, 0.0F); }

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
