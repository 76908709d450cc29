#include "app/picture/fit.h"

#include "core/base/bounds.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

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

render::View opening_view(const tree::VesselTree& tree) {
    constexpr double kFlat = 0.1; // thickness by the middle side; tuned on mesentery and trees of organs
    Bounds<glm::dvec3> box;
    for (const tree::Point& point : tree.points) box.hold(point.position, point.radius);
    const glm::dvec3 size = box.size();
    const auto is_flat = [&](double side, double one, double other) { return side < kFlat * std::min(one, other); };
    if (is_flat(size.x, size.y, size.z)) return render::View::kLeft;
    return is_flat(size.z, size.x, size.y) ? render::View::kSuperior : render::View::kAnterior;
}

bool context_in_view(const render::Frame& frame) {
    return std::ranges::any_of(frame.context, [&](const render::ContextMesh& item) {
        if (!item.shown()) return false;
        const render::Box box = render::bounds_of(*item.mesh);
        Bounds<glm::dvec2> pixels;
        for (int corner = 0; corner < 8; ++corner) {
            const glm::bvec3 high((corner & 1) != 0, (corner & 2) != 0, (corner & 4) != 0);
            const auto pixel = render::project(frame.camera, frame.size, glm::mix(box.lower, box.upper, high));
            if (!pixel) return true; // the box surrounds the eye
            pixels.hold(glm::dvec2(*pixel));
        }
        return pixels.most.x >= 0.0 && pixels.most.y >= 0.0 && pixels.least.x < frame.size.x &&
               pixels.least.y < frame.size.y;
    });
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
