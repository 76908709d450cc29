#include "app/picture/place_marks.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace ramus::app {

namespace {

constexpr double kLeastPoints = 9.0; // radius of a ring, of 1/96 inch
constexpr double kDotPoints = 3.4;   // radius of a dot
constexpr int kCorners = 40;

// Millimetres that one pixel spans where `at` is.
double mm_per_pixel_at(const render::Frame& frame, const glm::dvec3& at) {
    const render::Camera& camera = frame.camera;
    const double at_focus = render::mm_per_pixel(camera, frame.size);
    if (camera.orthographic) return at_focus;
    const glm::dvec3 forward = render::axes_of(camera).forward;
    const double focus = glm::dot(camera.focal_point - camera.position, forward);
    const double depth = glm::dot(at - camera.position, forward);
    return focus > 0.0 ? at_focus * std::max(depth, 0.0) / focus : at_focus;
}

std::vector<glm::dvec3> circle(const render::CameraAxes& axes, const glm::dvec3& centre, double radius_mm) {
    std::vector<glm::dvec3> points;
    for (int i = 0; i <= kCorners; ++i) {
        const double angle = 2.0 * std::numbers::pi * (i % kCorners) / kCorners;
        points.push_back(centre + radius_mm * (std::cos(angle) * axes.right + std::sin(angle) * axes.up));
    }
    return points;
}

} // namespace

render::MarkLine ring_facing_eye(const render::Frame& frame, const glm::dvec3& at, double radius_mm,
                                 const glm::vec3& colour, bool strong) {
    const double least = kLeastPoints * static_cast<double>(frame.pixel_ratio) * mm_per_pixel_at(frame, at);
    const double radius = std::max(radius_mm, strong ? 1.5 * least : least);
    return {circle(render::axes_of(frame.camera), at, radius), colour, strong ? 3.4F : 1.8F};
}

render::MarkLine dot_at(const render::Frame& frame, const glm::dvec3& at, const glm::vec3& colour) {
    // A ring whose radius equals half its line width has no hole.
    const double radius = 0.5 * kDotPoints * static_cast<double>(frame.pixel_ratio) * mm_per_pixel_at(frame, at);
    return {circle(render::axes_of(frame.camera), at, radius), colour, static_cast<float>(kDotPoints)};
}

} // namespace ramus::app
