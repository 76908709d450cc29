#include "render/renderer/targets.h"

#include "render/gl/gl_context.h"

namespace ramus::render {

namespace {

std::array<glm::vec2, kMostSamples> sample_positions(GLuint framebuffer, int samples) {
    std::array<glm::vec2, kMostSamples> positions{};
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    for (int s = 0; s < samples; ++s) {
        glm::vec2 at(0.5F);
        if (samples > 1) glGetMultisamplefv(GL_SAMPLE_POSITION, static_cast<GLuint>(s), &at.x);
        positions.at(static_cast<std::size_t>(s)) = at - 0.5F;
    }
    return positions;
}

} // namespace

bool ViewTargets::fit(glm::ivec2 size, int samples_a_pixel) const {
    return size == made_for_ && samples_a_pixel == view.samples;
}

void ViewTargets::make(int samples_a_pixel) {
    const int w = view.size.x, h = view.size.y;
    samples.id_normal = make_texture(GL_RG32UI, w, h, samples_a_pixel);
    samples.depth = make_texture(GL_DEPTH_COMPONENT32F, w, h, samples_a_pixel);
    resolved.covered = make_texture(GL_DEPTH_COMPONENT32F, w, h);
    resolved.id_normal = make_texture(GL_RG32UI, w, h);
    resolved.opaque_depth = make_texture(GL_R32F, w, h);
    resolved.picked_depth = make_texture(GL_R32F, w, h);
    occlusion.raw = make_texture(GL_R8, w, h);
    occlusion.half_blurred = make_texture(GL_R8, w, h);
    occlusion.blurred = make_texture(GL_R8, w, h);
    lit.colour = make_texture(GL_RGBA8, w, h);
    glTextureParameteri(lit.colour, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    samples.framebuffer = make_framebuffer({samples.id_normal}, samples.depth);
    resolved.framebuffer =
        make_framebuffer({resolved.id_normal, resolved.opaque_depth, resolved.picked_depth}, resolved.covered);
    occlusion.raw_target = make_framebuffer({occlusion.raw}, resolved.covered);
    occlusion.half_target = make_framebuffer({occlusion.half_blurred}, resolved.covered);
    occlusion.blurred_target = make_framebuffer({occlusion.blurred}, resolved.covered);
    lit.framebuffer = make_framebuffer({lit.colour}, resolved.covered);
    if (gl_has_lists()) lists.framebuffer = make_framebuffer({}, samples.depth);
    layers.fragments = {}; // makes the others anew when they are needed
    samples.positions = sample_positions(samples.framebuffer, samples_a_pixel);
    view.samples = samples_a_pixel;
    made_for_ = view.size;
}

} // namespace ramus::render
