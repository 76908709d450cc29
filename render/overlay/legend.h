// Text on small plates: labels of lines, and the legend of a picture's colours as a bar with ticks or as swatches.
// Painted without GL, so that the window and headless commands get the same bytes.
#pragma once

#include "render/image/image.h"
#include "render/image/text.h"
#include "render/scene/scene.h"

#include <cstdint>
#include <string>

namespace ramus::render {

enum class PlateInk : std::uint8_t { kLight, kDark }; // dark: on a light plate, for a light background

// One line of text on a plate.
[[nodiscard]] Image paint_label(const std::string& text, double pixel_ratio, PlateInk ink = PlateInk::kLight);

// At most `most` pixels. If necessary the bar is shortened, and swatches without room are counted in a last line.
[[nodiscard]] Image paint_legend(const Legend& legend, double pixel_ratio, glm::ivec2 most,
                                 PlateInk ink = PlateInk::kLight);

} // namespace ramus::render
