#include "render/renderer/passes/overlay_passes.h"

#include <utility>

namespace ramus::render {

void draw_sprite(const Fullscreen& program, const Image& image, glm::ivec2 at, const Region& region) {
    const glm::ivec2 from = glm::max(at, region.at);
    const glm::ivec2 to = glm::min(at + glm::ivec2(image.width, image.height), region.end());
    if (from.x >= to.x || from.y >= to.y) return;
    const Texture texture = make_texture(GL_RGBA8, image.width, image.height);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    glTextureSubImage2D(texture, 0, 0, 0, image.width, image.height, GL_RGBA, GL_UNSIGNED_BYTE, image.rgba.data());
    glEnable(GL_SCISSOR_TEST);
    glScissor(from.x, from.y, to.x - from.x, to.y - from.y);
    glBindTextureUnit(kUnitImage, texture);
    glProgramUniform2i(program, kUniformOrigin, at.x, at.y);
    program.draw();
    glDisable(GL_SCISSOR_TEST);
}

void SpritePass::draw(const Frame& frame, const Region& region) {
    SpriteSource source(frame);
    if (!painted_of_ || *painted_of_ != source) {
        sprites_ = painter_.paint(source);
        painted_of_ = std::move(source);
    }
    for (const auto& [image, corner] : sprites_)
        draw_sprite(program_, image, {corner.x, frame.size.y - corner.y - image.height}, region);
}

} // namespace ramus::render
