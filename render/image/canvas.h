// Canvas: draws lines, areas and small pictures into an opaque Image, without GL. Positions are in pixels; (0, 0) is
// the middle of the upper left pixel. Colours are sRGB. Lines have antialiased edges; where a line meets itself it is
// not darker.
#pragma once

#include "render/image/image.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace ramus::render {

struct Stroke {
    glm::vec3 colour{1.0F};
    float width = 1.0F; // pixels
    float opacity = 1.0F;
};

class Canvas {
public:
    explicit Canvas(Image& image) : Canvas(image, glm::ivec2(0), {image.width, image.height}) {}
    // Draws only into the pixels from `low` to `high`, the latter not included.
    Canvas(Image& image, glm::ivec2 low, glm::ivec2 high);

    // A polyline with round ends and joints; one point is a dot.
    void line(std::span<const glm::dvec2> points, bool closed, const Stroke& stroke);
    void dot(const glm::dvec2& middle, const Stroke& stroke) { line({&middle, 1}, false, stroke); }
    // The area inside closed polygons, where one inside another is a hole.
    void area(std::span<const std::vector<glm::dvec2>> polygons, const glm::vec3& colour, float opacity);
    // A picture with transparency; what lies outside is cut off.
    void picture(const Image& picture, glm::ivec2 corner);

private:
    void blend(int x, int y, const glm::vec3& colour, float opacity);

    Image& image_;
    glm::ivec2 low_, high_;       // within the picture
    std::vector<float> coverage_; // of a line, by pixel of its box
};

} // namespace ramus::render
