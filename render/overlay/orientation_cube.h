// OrientationCube: a cube seen from the camera's direction, with one letter a face (R L A P S I). Painted without GL.
#pragma once

#include "render/image/image.h"
#include "render/image/text.h"
#include "render/scene/camera.h"

#include <array>

namespace ramus::render {

class OrientationCube {
public:
    OrientationCube(); // draws the letters once: the cube turns in every frame
    [[nodiscard]] Image paint(const Camera& camera, int side) const; // `side` in pixels

private:
    class Rays;
    static void paint_pixel(const Rays& rays, int px, int py, std::uint8_t* out);
    std::array<Coverage, 6> letters_;
};

} // namespace ramus::render
