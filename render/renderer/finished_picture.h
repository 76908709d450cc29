// A picture that is finished, in a texture: back to memory, or on to a framebuffer.
#pragma once

#include "render/image/image.h"

#include <glad/gl.h>
#include <glm/vec2.hpp>

namespace ramus::render {

// RGBA8 with premultiplied alpha, rows from the bottom up; the image has straight alpha, rows from the top down.
[[nodiscard]] Image read_picture(GLuint texture, glm::ivec2 size);
// Copies what is in framebuffer `from` into `to` (0 = the window's), its lower left corner at (x, y). Leaves `to` bound
// for drawing.
void present_picture(GLuint from, glm::ivec2 size, GLuint to, int x, int y);

} // namespace ramus::render
