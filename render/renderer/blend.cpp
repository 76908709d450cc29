#include "render/renderer/blend.h"

#include "render/renderer/passes/gl_state.h"
#include "render/renderer/passes/overlay_passes.h"

namespace ramus::render {

Result<Blend> Blend::create() {
    Blend blend;
    if (auto made = blend.mix_.make("blend.frag"); !made) return tl::unexpected(made.error());
    if (auto made = blend.overlay_.make("overlay.frag"); !made) return tl::unexpected(made.error());
    return blend;
}

void Blend::draw(unsigned first, unsigned second, double share, glm::ivec2 size, const Image& heading, int top) {
    if (size != picture_.size) picture_.make(size);
    begin_passes(size);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
    picture_.bind();
    glProgramUniform1f(mix_, kUniformShare, static_cast<float>(share));
    glBindTextureUnit(kUnitImage, first);
    glBindTextureUnit(kUnitOtherImage, second);
    mix_.draw();
    if (heading.width > 0) {
        begin_blending(Blending::kOver);
        draw_sprite(overlay_, heading, {(size.x - heading.width) / 2, size.y - top - heading.height}, {{}, size});
        glDisable(GL_BLEND);
    }
    end_passes();
}

} // namespace ramus::render
