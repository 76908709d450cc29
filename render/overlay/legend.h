// Words on small dark plates: labels of lines, and the legend of a picture's colours, a bar with ticks or swatches.
// Painted without GL, so that they are the same bytes in the window and without one.
#pragma once

#include "render/image/image.h"
#include "render/image/text.h"
#include "render/scene/scene.h"

#include <string>

namespace ramus::render {

// One line of text on a plate.
[[nodiscard]] Image paint_label(const std::string& text, double pixel_ratio);

// Not wider or higher than `most` pixels: a bar gets shorter, swatches that have no room are counted in a last line.
[[nodiscard]] Image paint_legend(const Legend& legend, double pixel_ratio, glm::ivec2 most);

} // namespace ramus::render
