#include "app/picture/framing.h"

#include "render/scene/camera_moves.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

namespace ramus::app {

namespace {

double aspect_of(glm::ivec2 size) { return static_cast<double>(size.x) / std::max(1, size.y); }

} // namespace

render::Camera reframed(const render::Camera& camera, glm::ivec2 from, glm::ivec2 to,
                        std::span<const glm::vec3> points) {
    const double before = aspect_of(from);
    const double after = aspect_of(to);
    if (camera.inside || !(after < before)) return camera;
    constexpr double kNearSide = 0.95; // of the way from the middle to a side: points may come as near as that
    const double most = before / after;
    const double distance = render::depth_of(camera, camera.focal_point);
    const double slope = std::tan(0.5 * glm::radians(camera.view_angle));
    const render::CameraAxes axes = render::axes_of(camera);
    double factor = points.empty() ? most : 1.0;
    for (const glm::vec3& point : points) {
        const double depth = render::depth_of(camera, point);
        if (!camera.orthographic && depth <= 0.0) continue;
        const double aside = std::abs(glm::dot(glm::dvec3(point) - camera.position, axes.right));
        const double half_height = camera.orthographic ? camera.scale : depth * slope;
        const double was = aside / (half_height * before);
        if (was > 1.0) { // it is cut off already
            factor = most;
            break;
        }
        const double room = after * std::max(kNearSide, was);
        const double needed = camera.orthographic ? aside / (camera.scale * room)
                                                  : (aside / (slope * room) - (depth - distance)) / distance;
        factor = std::max(factor, needed);
    }
    render::Camera farther = camera;
    farther.position = camera.focal_point + factor * (camera.position - camera.focal_point);
    farther.scale *= factor;
    return farther;
}

std::optional<render::Camera> Framing::follow(const render::Camera& camera, glm::ivec2 size, const PointsSeen& points) {
    const bool chosen = !wanted_ || camera != camera_;
    const bool reshaped = size != size_;
    camera_ = camera;
    size_ = size;
    if (chosen) wanted_ = Wanted{camera, size};
    if (chosen || !reshaped) return {};
    camera_ = size == wanted_->size
                  ? wanted_->camera
                  : reframed(wanted_->camera, wanted_->size, size, points(wanted_->camera, wanted_->size));
    return camera_ == camera ? std::nullopt : std::optional(camera_);
}

} // namespace ramus::app
