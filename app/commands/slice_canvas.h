// SliceCanvas: paints slices of scans with lines and text, on the processor and without a display.
#pragma once

#include "core/slice/window.h"
#include "render/image/image.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <string>

namespace ramus::app {

class SliceCanvas {
public:
    SliceCanvas(int width, int height); // black

    // Paints values row by row, `columns` in each row, with the upper left at a pixel. NaN becomes dark grey.
    void put_values(std::span<const float> values, int columns, glm::ivec2 at, const slice::Window& window);
    // Paints a polyline with smooth edges; whole numbers are the centres of pixels. Parts outside of the box from `low`
    // to `high` (pixels, the latter not included) are cut off.
    void put_line(std::span<const glm::dvec2> points, const glm::vec3& srgb, double width, glm::ivec2 low,
                  glm::ivec2 high);
    // Paints a line of text with a dark halo; `at` is the upper left corner. UTF-8.
    void put_text(const std::string& text, glm::ivec2 at, double capital_height = 9.0);

    [[nodiscard]] const render::Image& image() const { return image_; }

private:
    render::Image image_;
};

} // namespace ramus::app
