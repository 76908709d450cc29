#include "render/renderer/picture_target.h"

#include <algorithm>

namespace ramus::render {

void PictureTarget::make(glm::ivec2 pixels) {
    size = glm::ivec2(0);
    colour = make_texture(GL_RGBA8, pixels.x, pixels.y);
    framebuffer = make_framebuffer({colour});
    size = pixels;
}

void PictureTarget::bind() const {
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glViewport(0, 0, size.x, size.y);
}

Image PictureTarget::read_premultiplied() const {
    Image image(size.x, size.y);
    if (size.x == 0) return image;
    Image upside_down(size.x, size.y);
    glPixelStorei(GL_PACK_ALIGNMENT, 4);
    glGetTextureImage(colour, 0, GL_RGBA, GL_UNSIGNED_BYTE, static_cast<GLsizei>(upside_down.rgba.size()),
                      upside_down.rgba.data());
    const std::size_t row = 4 * static_cast<std::size_t>(size.x);
    for (int y = 0; y < size.y; ++y) std::copy_n(upside_down.pixel(0, size.y - 1 - y), row, image.pixel(0, y));
    return image;
}

Image PictureTarget::read() const {
    Image image = read_premultiplied();
    straighten(image);
    return image;
}

void PictureTarget::present(GLuint to, int x, int y) const {
    if (size.x == 0) return;
    glDisable(GL_SCISSOR_TEST);
    glBlitNamedFramebuffer(framebuffer, to, 0, 0, size.x, size.y, x, y, x + size.x, y + size.y, GL_COLOR_BUFFER_BIT,
                           GL_NEAREST);
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, to);
}

} // namespace ramus::render
