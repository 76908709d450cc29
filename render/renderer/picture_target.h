// PictureTarget: a picture in a texture, and the way from there to memory or to another framebuffer.
#pragma once

#include "render/gl/gl_objects.h"
#include "render/image/image.h"

#include <glm/vec2.hpp>

namespace ramus::render {

struct PictureTarget {
    glm::ivec2 size{0};
    Texture colour; // RGBA8, 4 bytes a pixel: sRGB, premultiplied, rows from below
    Framebuffer framebuffer;

    void make(glm::ivec2 pixels); // of no size until it is there
    void bind() const;
    // Straight alpha, rows from above. Of no size: an empty image.
    [[nodiscard]] Image read() const;
    [[nodiscard]] Image read_premultiplied() const;
    // Copies the picture into framebuffer `to` (0 = the window's), its lower left corner at (x, y). Leaves `to` bound
    // for drawing.
    void present(GLuint to, int x, int y) const;
};

} // namespace ramus::render
