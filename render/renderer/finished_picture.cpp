#include "render/renderer/finished_picture.h"

#include <algorithm>

namespace ramus::render {

Image read_picture(GLuint texture, glm::ivec2 size) {
    Image image(size.x, size.y);
    if (size.x == 0) return image;
    Image upside_down(size.x, size.y);
    glPixelStorei(GL_PACK_ALIGNMENT, 4);
    glGetTextureImage(texture, 0, GL_RGBA, GL_UNSIGNED_BYTE, static_cast<GLsizei>(upside_down.rgba.size()),
                      upside_down.rgba.data());
    const std::size_t row = 4 * static_cast<std::size_t>(size.x);
    for (int y = 0; y < size.y; ++y) std::copy_n(upside_down.pixel(0, size.y - 1 - y), row, image.pixel(0, y));
    straighten(image);
    return image;
}

void present_picture(GLuint from, glm::ivec2 size, GLuint to, int x, int y) {
    if (size.x == 0) return;
    glDisable(GL_SCISSOR_TEST);
    glBlitNamedFramebuffer(from, to, 0, 0, size.x, size.y, x, y, x + size.x, y + size.y, GL_COLOR_BUFFER_BIT,
                           GL_NEAREST);
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, to);
}

} // namespace ramus::render
