#include "render/image/text.h"
#include "render/overlay/overlay.h"
#include "render/renderer/renderer_impl.h"

#include <utility>

namespace ramus::render {

void Renderer::Impl::draw_overlays(const Frame& frame, const std::vector<Layer>& layers) {
    glBindFramebuffer(GL_FRAMEBUFFER, picture_target_);
    glViewport(0, 0, size_.x, size_.y);
    if (cast_) {
        glTextureSubImage2D(picture_, 0, 0, 0, size_.x, size_.y, GL_RGBA, GL_UNSIGNED_BYTE, caster_.rgba());
        if (frame.skeleton || !frame.lines.empty()) send_cast_depths();
    } else if (inner_ == size_) {
        // Only what was shaded: the rest has its overlays already.
        const glm::ivec2 end = region_at_ + region_size_;
        glBlitNamedFramebuffer(lit_target_, picture_target_, region_at_.x, region_at_.y, end.x, end.y, region_at_.x,
                               region_at_.y, end.x, end.y, GL_COLOR_BUFFER_BIT, GL_NEAREST);
    } else {
        glBindTextureUnit(kUnitImage, lit_);
        fullscreen(enlarge_);
    }
    glEnable(GL_BLEND);
    glBlendEquation(GL_FUNC_ADD);
    glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    draw_skeleton(frame, layers);
    draw_marks(frame);
    glEnable(GL_SCISSOR_TEST);
    // Painting takes longer than shading: pointing at things paints nothing anew.
    SpriteSource source(frame);
    if (!sprites_of_ || *sprites_of_ != source) {
        sprites_ = overlays_of(source, default_font());
        sprites_of_ = std::move(source);
    }
    for (const Sprite& sprite : sprites_) {
        const Image& image = sprite.image;
        const int x = sprite.corner.x, y = frame.size.y - sprite.corner.y - image.height;
        glm::ivec2 from(x, y), to(x + image.width, y + image.height);
        if (inner_ == size_) from = glm::max(from, region_at_), to = glm::min(to, region_at_ + region_size_);
        if (from.x >= to.x || from.y >= to.y) continue;
        const Texture texture = make_texture(GL_RGBA8, image.width, image.height);
        glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
        glTextureSubImage2D(texture, 0, 0, 0, image.width, image.height, GL_RGBA, GL_UNSIGNED_BYTE, image.rgba.data());
        glScissor(from.x, from.y, to.x - from.x, to.y - from.y);
        glBindTextureUnit(kUnitImage, texture);
        glProgramUniform2i(overlay_, kUniformOrigin, x, y);
        fullscreen(overlay_);
    }
    glDisable(GL_BLEND);
    glDisable(GL_SCISSOR_TEST);
}

} // namespace ramus::render
