#include "app/picture/fit.h"

#include <algorithm>

namespace ramus::app {

render::Camera with_room(render::Camera camera, const Comparison& comparison) {
    constexpr double kRoom = 1.12; // tuned on masks of a liver, an aorta and a circle of Willis
    const std::vector<mesh::Method>& shown = comparison.surfaces;
    if (comparison.mode != Comparison::Mode::kSideBySide ||
        std::ranges::find(shown, mesh::Method::kIsosurface) == shown.end())
        return camera;
    camera.position = camera.focal_point + kRoom * (camera.position - camera.focal_point);
    camera.scale *= kRoom;
    return camera;
}

} // namespace ramus::app
