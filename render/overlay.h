// The small pictures that lie over the tree: the orientation cube with its letters, the scale bar, the legend and the
// labels of lines. Painted without
// GL, so that they are the same bytes in the window and without one, and can be tested alone.
#pragma once

#include "render/camera.h"
#include "render/frame.h"
#include "render/image.h"

#include <string>
#include <vector>

namespace ramus::render {

struct Sprite {
    Image image;
    glm::ivec2 corner{0}; // top left, in pixels of the picture
};

// A length of 1, 2 or 5 times a power of ten, at most `longest_mm`.
[[nodiscard]] double scale_bar_length_mm(double longest_mm);
// "500 um" (with the micro sign in Latin-1), "20 mm", "20 cm".
[[nodiscard]] std::string scale_bar_label(double length_mm);

// A cube seen from the camera's direction, one letter a face (R L A P S I), `side` pixels.
[[nodiscard]] Image paint_orientation_cube(const Camera& camera, int side, const std::string& font);
[[nodiscard]] Image paint_scale_bar(double length_mm, double length_pixels, double pixel_ratio,
                                    const std::string& font);

// What `frame` shows over the tree; nothing where the picture is too small to read it.
[[nodiscard]] std::vector<Sprite> overlays_of(const Frame& frame, const std::string& font);

} // namespace ramus::render
