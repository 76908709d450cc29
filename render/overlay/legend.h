// The legend of a picture's colours: a bar with ticks, or swatches, on a dark plate. Painted without GL, so that it is
// the same bytes in the window and without one.
#pragma once

#include "render/image/image.h"
#include "render/image/text.h"
#include "render/scene/scene.h"

namespace ramus::render {

// Not wider or higher than `most` pixels: a bar gets shorter, swatches that have no room are counted in a last line.
[[nodiscard]] Image paint_legend(const Legend& legend, double pixel_ratio, glm::ivec2 most, const Font& font);

} // namespace ramus::render
