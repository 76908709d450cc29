// OrientationCube: a cube seen from the camera's direction with the name of an axis on each face: R L A P S I, or +x -x
// +y -y +z -z if the patient's sides are unknown. Painted without GL.
#pragma once

#include "render/image/image.h"
#include "render/image/text.h"
#include "render/scene/camera.h"

#include <array>

namespace ramus::render {

class OrientationCube {
public:
    OrientationCube(); // draws the letters once, since the cube is painted every frame
    // `side` in pixels. Names must come from side_letters() or plain_axes(), in any order.
    [[nodiscard]] Image paint(const Camera& camera, int side, const AxisNames& axes = side_letters()) const;

private:
    class Rays;
    static void paint_pixel(const Rays& rays, int px, int py, std::uint8_t* out);
    [[nodiscard]] const Coverage& tile_of(const std::string& name) const;
    std::array<Coverage, 12> tiles_; // by name: letters, then plain axes
};

} // namespace ramus::render
