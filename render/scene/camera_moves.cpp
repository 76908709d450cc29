#include "render/scene/camera_moves.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/trigonometric.hpp>

namespace ramus::render {

namespace {

constexpr double kDegreesPerPicture = 200.0; // 3D Slicer's rotation, over one picture width
constexpr double kFarthestDepth = 1e8;       // mm: no tree is visible from farther away

// Moves the focal point along the line of sight to the depth of `at`.
Camera focused(Camera camera, const glm::dvec3& at) {
    const double depth = depth_of(camera, at);
    if (depth > 0.0) camera.focal_point = camera.position + depth * axes_of(camera).forward;
    return camera;
}

Camera shifted(Camera camera, const glm::dvec3& by) {
    camera.position += by;
    camera.focal_point += by;
    return camera;
}

} // namespace

double depth_of(const Camera& camera, const glm::dvec3& at) {
    return glm::dot(at - camera.position, axes_of(camera).forward);
}

double mm_per_pixel_at(const Camera& camera, glm::ivec2 size, double depth_mm) {
    const double half = camera.orthographic ? camera.scale : depth_mm * std::tan(glm::radians(0.5 * camera.view_angle));
    return 2.0 * half / std::max(size.y, 1);
}

Camera turned_about(const Camera& camera, const glm::dvec3& at, double azimuth_deg, double elevation_deg) {
    const CameraAxes axes = axes_of(camera);
    const glm::dquat azimuth = glm::angleAxis(glm::radians(azimuth_deg), axes.up);
    const glm::dquat turn = glm::angleAxis(glm::radians(-elevation_deg), azimuth * axes.right) * azimuth;
    Camera result = camera;
    result.position = at + turn * (camera.position - at);
    result.focal_point = at + turn * (camera.focal_point - at);
    result.view_up = glm::normalize(turn * axes.up);
    return focused(result, at);
}

Camera rotated(const Camera& camera, glm::ivec2 size, const glm::dvec3& at, glm::dvec2 from, glm::dvec2 to) {
    const glm::dvec2 moved = to - from;
    return turned_about(camera, at, -kDegreesPerPicture * moved.x / std::max(size.x, 1),
                        kDegreesPerPicture * moved.y / std::max(size.y, 1));
}

Camera panned(const Camera& camera, glm::ivec2 size, const glm::dvec3& at, glm::dvec2 from, glm::dvec2 to) {
    const double depth = depth_of(camera, at);
    if (!camera.orthographic && depth <= 0.0) return camera;
    return focused(shifted(camera, unproject(camera, size, from, depth) - unproject(camera, size, to, depth)), at);
}

Camera zoomed_about(const Camera& camera, const glm::dvec3& at, double factor, double least_mm) {
    if (!(factor > 0.0) || !std::isfinite(factor)) return camera;
    const CameraAxes axes = axes_of(camera);
    const glm::dvec3 way = at - camera.position;
    const double depth = glm::dot(way, axes.forward);
    const double now = camera.orthographic ? camera.scale / std::tan(glm::radians(0.5 * camera.view_angle)) : depth;
    // If it is too near already, magnifying changes nothing; zooming out always works.
    const double then = std::min(factor > 1.0 ? std::max(now / factor, std::min(now, least_mm)) : now / factor,
                                 std::max(now, kFarthestDepth));
    if (!(now > 0.0) || then == now) return camera;
    const double share = 1.0 - then / now; // share of the distance to the point
    Camera result = camera;
    if (!camera.orthographic) return focused(shifted(result, share * way), at);
    result.scale *= then / now;
    return focused(shifted(result, share * (way - depth * axes.forward)), at);
}

double zoom_of_drag(glm::ivec2 size, glm::dvec2 from, glm::dvec2 to) {
    return std::pow(1.1, 10.0 * (from.y - to.y) / std::max(0.5 * size.y, 1.0));
}

} // namespace ramus::render
