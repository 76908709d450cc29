// Blend: two pictures of one size, one fading into the other in linear light. At 0 it is the first, at 1 the second, to
// the bit. It keeps what it made: equal pictures in equal shares are mixed once.
//
// All calls need the GL context current that was current at create(), the destructor too.
#pragma once

#include "core/base/error.h"
#include "render/gl/fullscreen.h"
#include "render/renderer/picture_target.h"

namespace ramus::render {

class Blend {
public:
    [[nodiscard]] static Result<Blend> create();

    // `heading` lies in the middle, `top` pixels from the edge; of no size: none. Throws OutOfGraphicsMemory.
    void draw(unsigned first, unsigned second, double share, glm::ivec2 size, const Image& heading, int top);

    [[nodiscard]] const PictureTarget& picture() const { return picture_; }

private:
    Fullscreen mix_, overlay_;
    PictureTarget picture_;
};

} // namespace ramus::render
