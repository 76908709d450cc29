#include "app/picture/fit.h"

#include <algorithm>

namespace ramus::app {

render::Camera with_room(render::Camera camera, const Comparison& comparison) {
    constexpr double kRoom = 1.12; // tuned on masks of a liver, an aorta and a circle of Willis
    const std::vector<Compared>& shown = comparison.surfaces;
    if (comparison.mode != Comparison::Mode::kSideBySide ||
        std::ranges::find(shown, Compared::kIsosurface) == shown.end())
        return camera;
    camera.position = camera.focal_point + kRoom * (camera.position - camera.focal_point);
    camera.scale *= kRoom;
    return camera;
}

render::Camera looking_at(const render::Camera& camera, const glm::dvec3& at, double radius_mm, glm::ivec2 size) {
    constexpr double kAround = 15.0; // radii, from the middle of the picture to its edge
    render::Camera near = render::centred_on(camera, at);
    const double half_height = 0.5 * size.y * render::mm_per_pixel(near, size);
    const double nearer = std::min(1.0, kAround * radius_mm / half_height);
    near.position = at + nearer * (near.position - at);
    near.scale *= nearer;
    return near;
}

} // namespace ramus::app
