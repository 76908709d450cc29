#include "render/renderer/passes/picture_passes.h"

#include "render/renderer/passes/gl_state.h"

#include <algorithm>
#include <array>

namespace ramus::render {

void CopyPass::draw(const ViewSetup& view, const LitTarget& from, const PictureTarget& to, const Region& region) const {
    if (view.enlarged()) {
        glBindTextureUnit(kUnitImage, from.colour);
        enlarge_.draw();
        return;
    }
    const glm::ivec2 at = region.at, end = region.end();
    glBlitNamedFramebuffer(from.framebuffer, to.framebuffer, at.x, at.y, end.x, end.y, at.x, at.y, end.x, end.y,
                           GL_COLOR_BUFFER_BIT, GL_NEAREST);
}

void MeanTarget::make(glm::ivec2 size) {
    sum = make_texture(GL_RGBA16F, size.x, size.y);
    framebuffer = make_framebuffer({sum});
}

Result<void> MeanPass::make() {
    if (auto made = add_.make("add_view.frag"); !made) return made;
    return mean_.make("mean_view.frag");
}

void MeanPass::add(const ViewSetup& view, const LitTarget& from, MeanTarget& to) const {
    glBindFramebuffer(GL_FRAMEBUFFER, to.framebuffer);
    if (to.views == 0) {
        const std::array<GLfloat, 4> nothing{};
        glClearBufferfv(GL_COLOR, 0, nothing.data());
    }
    glViewport(0, 0, view.size.x, view.size.y);
    begin_blending(Blending::kAdded);
    glBindTextureUnit(kUnitImage, from.colour);
    add_.draw_in(glm::ivec2(0), view.size);
    glDisable(GL_BLEND);
    ++to.views;
}

void MeanPass::show(const ViewSetup& view, const MeanTarget& from, const LitTarget& to) const {
    glBindFramebuffer(GL_FRAMEBUFFER, to.framebuffer);
    glViewport(0, 0, view.size.x, view.size.y);
    glBindTextureUnit(kUnitImage, from.sum);
    glProgramUniform1f(mean_, kUniformShare, 1.0F / static_cast<float>(from.views));
    mean_.draw_in(glm::ivec2(0), view.size);
}

} // namespace ramus::render
