#include "render/renderer/blend.h"

#include "render/gl/bindings.h"
#include "render/renderer/finished_picture.h"

namespace ramus::render {

Result<Blend> Blend::create() {
    Blend blend;
    for (auto [program, fragment] : {std::pair{&blend.mix_, "blend.frag"}, {&blend.overlay_, "overlay.frag"}}) {
        auto made = make_program("fullscreen.vert", fragment);
        if (!made) return tl::unexpected(made.error());
        *program = std::move(*made);
    }
    blend.no_vertices_ = make_vertex_array();
    return blend;
}

void Blend::draw(unsigned first, unsigned second, double share, glm::ivec2 size, const Image& heading, int top) {
    if (size != size_) {
        size_ = glm::ivec2(0);
        picture_ = make_texture(GL_RGBA8, size.x, size.y);
        target_ = make_framebuffer({picture_});
        size_ = size;
    }
    glDisable(GL_SCISSOR_TEST);
    glDisable(GL_BLEND);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glBindFramebuffer(GL_FRAMEBUFFER, target_);
    glViewport(0, 0, size.x, size.y);
    glBindVertexArray(no_vertices_);
    glUseProgram(mix_);
    glUniform2f(kUniformShare, static_cast<float>(share), 0.0F);
    glBindTextureUnit(kUnitImage, first);
    glBindTextureUnit(kUnitOtherImage, second);
    glDrawArrays(GL_TRIANGLES, 0, 3);
    if (heading.width > 0) {
        const glm::ivec2 at((size.x - heading.width) / 2, size.y - top - heading.height);
        const Texture sprite = make_texture(GL_RGBA8, heading.width, heading.height);
        glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
        glTextureSubImage2D(sprite, 0, 0, 0, heading.width, heading.height, GL_RGBA, GL_UNSIGNED_BYTE,
                            heading.rgba.data());
        glEnable(GL_BLEND);
        glBlendEquation(GL_FUNC_ADD);
        glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
        glEnable(GL_SCISSOR_TEST);
        glScissor(at.x, at.y, heading.width, heading.height);
        glBindTextureUnit(kUnitImage, sprite);
        glProgramUniform2i(overlay_, kUniformOrigin, at.x, at.y);
        glUseProgram(overlay_);
        glDrawArrays(GL_TRIANGLES, 0, 3);
        glDisable(GL_SCISSOR_TEST);
        glDisable(GL_BLEND);
    }
    glBindTextureUnit(kUnitImage, 0);
    glBindTextureUnit(kUnitOtherImage, 0);
    glBindVertexArray(0);
    glUseProgram(0);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
}

Image Blend::read_image() const { return read_picture(picture_, size_); }

void Blend::present(unsigned framebuffer, int x, int y) const { present_picture(target_, size_, framebuffer, x, y); }

} // namespace ramus::render
