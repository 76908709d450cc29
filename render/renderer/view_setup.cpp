#include "render/renderer/view_setup.h"

#include "render/scene/colour.h"
#include "render/scene/seen_plane.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

namespace ramus::render {

namespace {

// Shifts of the views of a refined picture, in sixteenths of a pixel. Found by search: with the four conventional
// sample positions, these estimate the coverage of a pixel by a half-plane or by a stripe best.
constexpr std::array<glm::vec2, kFineViews> kShifts{{{0.0F, 0.0F}, {-3.0F, -1.0F}, {1.0F, 3.0F}, {2.0F, -2.0F}}};
constexpr double kOcclusionShare =
    0.055; // of the picture's height: the reach of the occlusion (tuned by eye on brain and airway trees)

// The near plane if the eye is among vessels, relative to the focal distance and to the far plane.
constexpr double kShareOfFocus = 0.02, kLeastNearPlane = 1e-6, kMostNearPlane = 1e-4;

} // namespace

glm::dmat4 eye_matrix(const Camera& camera) {
    return glm::scale(glm::dmat4(1.0), {1.0, 1.0, -1.0}) * view_matrix(camera);
}

glm::dmat4 ViewSetup::clip_from(const glm::dvec3& origin) const { return glm::translate(to_clip, origin); }

void ViewSetup::look(const Frame& frame, const Box& box, const std::vector<Ball>& others) {
    const Camera& camera = frame.camera;
    const CameraAxes axes = axes_of(camera);
    const double middle = glm::dot(box.centre() - camera.position, axes.forward), radius = 1.001 * box.radius();
    double far = middle + radius, near = middle - radius;
    for (const Ball& ball : others) {
        const double along = glm::dot(ball.centre - camera.position, axes.forward);
        near = std::min(near, along - 1.001 * ball.radius);
        far = std::max(far, along + 1.001 * ball.radius);
    }
    const bool flat = camera.orthographic;
    if (!flat) {
        far = std::max(far, 1e-3 * radius);
        // Nearer than the focal point, also between vessels, but not so near that depths lose precision on some
        // drivers.
        const double focus = glm::distance(camera.position, camera.focal_point);
        near = std::max(near, std::clamp(kShareOfFocus * focus, kLeastNearPlane * far, kMostNearPlane * far));
    }
    projection = projection_matrix(camera, frame.size, near, far);
    projection[2][2] = flat ? 1.0 / (far - near) : near / (far - near);
    projection[3][2] = flat ? far / (far - near) : near * far / (far - near);
    const glm::vec2 pixels(size), off = kShifts.at(static_cast<std::size_t>(shift)) / 16.0F;
    projection = glm::translate(glm::dmat4(1.0), glm::dvec3(2.0F * off / pixels, 0.0)) * projection;
    to_clip = projection * view_matrix(camera);
    to_eye = glm::mat3(view_matrix(camera));

    const double mm_at_unit_depth =
        flat ? mm_per_pixel(camera, size) : 2.0 * std::tan(glm::radians(0.5 * camera.view_angle)) / pixels.y;
    const double reach = std::max(4.0, kOcclusionShare * pixels.y);
    // The depth cue spans the box's own depth.
    const glm::dvec3 half = 0.5 * (box.empty() ? glm::dvec3(1.0) : box.upper - box.lower);
    const double depth = std::max(glm::dot(half, glm::abs(axes.forward)), 1e-3 * radius);
    block.clip_to_eye = flat ? glm::vec4(0.0F, -(far - near), far / (far - near), 0.0F)
                             : glm::vec4(0.0F, projection[2][2], projection[3][2], 0.0F);
    block.pixel_to_eye = {0.5F * pixels.x + off.x, 0.5F * pixels.y + off.y, mm_at_unit_depth, 0.0F};
    block.depth_range = {middle - depth, middle + depth, reach, reach * mm_at_unit_depth};
    block.picture = {pixels.x, pixels.y, samples, flat ? 1.0F : 0.0F};
    cap_values = frame.cut_away ? cap_values_of(*frame.cut_away, camera, block) : std::nullopt;
}

LookBlock look_of(const Frame& frame, const ViewSetup& view, bool has_glass, bool outlined) {
    const Appearance& a = frame.appearance;
    const Background& b = frame.background;
    const float point = view.pixels_a_point(frame);
    return {glm::vec4(b.top, b.transparent ? 1.0F : 0.0F),
            glm::vec4(b.bottom, a.depth_cue),
            linear(a.glass, has_glass ? 1.0F : 0.0F),
            linear(a.selection, outlined ? std::max(1.0F, 1.6F * point) : 0.0F),
            {a.key, a.fill, a.rim, a.specular},
            {a.occlusion, std::clamp(a.glass_opacity, 0.0F, 2.0F), std::max(1.0F, point), a.shadows},
            linear(a.centerline, 1.0F),
            linear(a.lost, 1.0F),
            linear(0.5F * (b.top + b.bottom), 1.0F),
            {a.halos, a.contours, a.chromadepth, std::max(1.0F, 2.6F * point)}};
}

} // namespace ramus::render
