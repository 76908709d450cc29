#include "render/overlay.h"
#include "render/renderer_impl.h"
#include "render/text.h"

#include <utility>

namespace ramus::render {

void Renderer::Impl::draw_overlays(const Frame& frame) {
    glBindFramebuffer(GL_FRAMEBUFFER, picture_target_);
    glViewport(0, 0, size_.x, size_.y);
    if (inner_ == size_) {
        glBlitNamedFramebuffer(lit_target_, picture_target_, 0, 0, size_.x, size_.y, 0, 0, size_.x, size_.y,
                               GL_COLOR_BUFFER_BIT, GL_NEAREST);
    } else {
        glBindTextureUnit(0, lit_);
        fullscreen(enlarge_);
    }
    glEnable(GL_BLEND);
    glBlendEquation(GL_FUNC_ADD);
    glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
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
        const Texture texture = make_texture(GL_RGBA8, image.width, image.height);
        glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
        glTextureSubImage2D(texture, 0, 0, 0, image.width, image.height, GL_RGBA, GL_UNSIGNED_BYTE, image.rgba.data());
        const int x = sprite.corner.x, y = frame.size.y - sprite.corner.y - image.height;
        glScissor(x, y, image.width, image.height);
        glBindTextureUnit(0, texture);
        glProgramUniform2i(overlay_, 0, x, y);
        fullscreen(overlay_);
    }
    glDisable(GL_BLEND);
    glDisable(GL_SCISSOR_TEST);
}

} // namespace ramus::render
