// A camera that looks along no axis.
#pragma once

#include "render/scene/camera.h"

namespace ramus::test {

inline render::Camera aslant_camera(bool orthographic = false) {
    render::Camera camera;
    camera.position = {120.0, 340.0, -70.0};
    camera.focal_point = {10.0, -20.0, 30.0};
    camera.view_up = {0.1, 0.2, 0.97};
    camera.orthographic = orthographic;
    camera.scale = 55.0;
    return camera;
}

} // namespace ramus::test
