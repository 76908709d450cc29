// SliceScreen: the picture of a slice on the card, for a viewport of a sheet. The pixels are painted without GL
// (render/slice/slice_painter.h); this sends them and answers what is at a pixel.
//
// All calls, including the destructor, need the GL context of the first draw().
#pragma once

#include "render/renderer/drawn.h"
#include "render/renderer/targets.h"
#include "render/slice/slice_painter.h"

#include <optional>

namespace ramus::render {

class SliceScreen {
public:
    // True: the picture has changed. Throws OutOfGraphicsMemory.
    bool draw(const Frame& frame, const SliceView& view);
    [[nodiscard]] const Image& image() const { return image_; }
    void present(unsigned framebuffer, int x, int y, glm::ivec2 filled) const {
        picture_.present(framebuffer, x, y, filled);
    }
    // The vessel whose outline, or inside, is at a pixel from the top left. The place is in the plane.
    [[nodiscard]] Pick pick(glm::dvec2 at) const;

private:
    // What determines the picture: the parts of the frame that a section shows.
    struct Drawn {
        Frame frame;
        SliceView view;
    };
    std::optional<Drawn> drawn_;
    SlicePainter painter_;
    Image image_;
    PictureTarget picture_;
};

} // namespace ramus::render
