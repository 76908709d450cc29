#include "render/scene/camera.h"

#include "render/scene/camera_moves.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <limits>

namespace ramus::render {

namespace {

constexpr double kMargin = 1.06;           // of fitted(): room around the tree
constexpr double kSmallestDistance = 1e-6; // mm, eye to focal point

double tan_half_angle(const Camera& camera) { return std::tan(glm::radians(0.5 * camera.view_angle)); }

// Half the height in mm of what the picture shows in the plane through the focal point.
double half_height_mm(const Camera& camera) {
    if (camera.orthographic) return camera.scale;
    return glm::distance(camera.position, camera.focal_point) * tan_half_angle(camera);
}

double aspect(glm::ivec2 size) { return double(std::max(size.x, 1)) / double(std::max(size.y, 1)); }

// RAS: +x is the patient's right, +y anterior, +z superior.
struct NamedView {
    View view;
    std::string_view name, axis;
    glm::dvec3 towards_viewer, up;
};
constexpr std::array<NamedView, kViews.size()> kNamedViews{{
    {View::kAnterior, "anterior", "+y", {0, 1, 0}, {0, 0, 1}},
    {View::kPosterior, "posterior", "-y", {0, -1, 0}, {0, 0, 1}},
    {View::kLeft, "left", "-x", {-1, 0, 0}, {0, 0, 1}},
    {View::kRight, "right", "+x", {1, 0, 0}, {0, 0, 1}},
    {View::kSuperior, "superior", "+z", {0, 0, 1}, {0, 1, 0}},
    {View::kInferior, "inferior", "-z", {0, 0, -1}, {0, 1, 0}},
}};
const NamedView& named(View view) { return *std::ranges::find(kNamedViews, view, &NamedView::view); }

} // namespace

CameraAxes axes_of(const Camera& camera) {
    glm::dvec3 forward = camera.focal_point - camera.position;
    const double distance = glm::length(forward);
    forward = distance > 0.0 ? forward / distance : glm::dvec3(0.0, -1.0, 0.0);
    glm::dvec3 right = glm::cross(forward, camera.view_up);
    if (glm::length(right) <
        1e-9 * std::max(1e-300, glm::length(camera.view_up))) // looking along view-up: any right vector is valid
        right = glm::cross(forward, std::abs(forward.z) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(0, 1, 0));
    right = glm::normalize(right);
    return {right, glm::cross(right, forward), forward};
}

glm::dmat4 view_matrix(const Camera& camera) {
    const CameraAxes axes = axes_of(camera);
    glm::dmat4 view(1.0);
    for (int i = 0; i < 3; ++i) {
        view[i][0] = axes.right[i];
        view[i][1] = axes.up[i];
        view[i][2] = -axes.forward[i];
    }
    view[3][0] = -glm::dot(axes.right, camera.position);
    view[3][1] = -glm::dot(axes.up, camera.position);
    view[3][2] = glm::dot(axes.forward, camera.position);
    return view;
}

glm::dmat4 projection_matrix(const Camera& camera, glm::ivec2 size, double near_mm, double far_mm) {
    if (camera.orthographic) {
        const double h = camera.scale, w = h * aspect(size);
        return glm::ortho(-w, w, -h, h, near_mm, far_mm);
    }
    return glm::perspective(glm::radians(camera.view_angle), aspect(size), near_mm, far_mm);
}

double mm_per_pixel(const Camera& camera, glm::ivec2 size) {
    return 2.0 * half_height_mm(camera) / std::max(size.y, 1);
}

Projector::Projector(const Camera& camera, glm::ivec2 size)
    : axes_(axes_of(camera)), position_(camera.position), half_width_px_(0.5 * size.x), half_height_px_(0.5 * size.y),
      half_height_mm_(camera.orthographic ? camera.scale : tan_half_angle(camera)), orthographic_(camera.orthographic) {
}

std::optional<glm::dvec3> Projector::operator()(const glm::dvec3& point) const {
    const glm::dvec3 v = point - position_;
    const double depth = glm::dot(v, axes_.forward);
    if (!orthographic_ && depth <= 0.0) return std::nullopt;
    const double half = orthographic_ ? half_height_mm_ : depth * half_height_mm_;
    const double pixels_per_mm = half_height_px_ / half;
    return glm::dvec3(half_width_px_ + glm::dot(v, axes_.right) * pixels_per_mm,
                      half_height_px_ - glm::dot(v, axes_.up) * pixels_per_mm, depth);
}

std::optional<glm::dvec3> project(const Camera& camera, glm::ivec2 size, const glm::dvec3& point) {
    return Projector(camera, size)(point);
}

glm::dvec3 unproject(const Camera& camera, glm::ivec2 size, glm::dvec2 pixel, double depth_mm) {
    const CameraAxes axes = axes_of(camera);
    const double half = camera.orthographic ? camera.scale : depth_mm * tan_half_angle(camera);
    const double mm = 2.0 * half / std::max(size.y, 1);
    return camera.position + depth_mm * axes.forward + (pixel.x - 0.5 * size.x) * mm * axes.right +
           (0.5 * size.y - pixel.y) * mm * axes.up;
}

std::string_view name_of(View view) { return named(view).name; }
std::string_view axis_name_of(View view) { return named(view).axis; }

std::string title_of(View view, bool sides_known) {
    if (!sides_known) return "From " + std::string(axis_name_of(view));
    std::string title(name_of(view));
    title.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(title.front())));
    return title;
}

const AxisNames& side_letters() {
    static const AxisNames letters{"R", "L", "A", "P", "S", "I"};
    return letters;
}

const AxisNames& plain_axes() {
    static const AxisNames names{"+x", "-x", "+y", "-y", "+z", "-z"};
    return names;
}

std::optional<View> view_named(std::string_view name) {
    const auto found = std::ranges::find_if(
        kNamedViews, [&](const NamedView& each) { return each.name == name || each.axis == name; });
    return found != kNamedViews.end() ? std::optional(found->view) : std::nullopt;
}

Camera looking(const Camera& camera, View view) {
    Camera result = camera;
    const double distance = std::max(kSmallestDistance, glm::distance(camera.position, camera.focal_point));
    result.position = camera.focal_point + distance * named(view).towards_viewer;
    result.view_up = named(view).up;
    return result;
}

Camera outside(Camera camera) {
    if (!camera.inside) return camera;
    camera.inside = false;
    camera.view_angle = Camera().view_angle;
    return camera;
}

Camera fitted(const Camera& from, std::span<const glm::vec3> points, glm::ivec2 size) {
    const Camera camera = outside(from);
    Box box;
    for (const glm::vec3& point : points) box.include(glm::dvec3(point));
    const CameraAxes axes = axes_of(camera);
    const glm::dvec3 centre = box.centre();
    const double radius = box.radius(), t = tan_half_angle(camera) / kMargin, wide = aspect(size);

    // A point at offset (x, y, z) from the centre (z along the line of sight) is visible from an eye at (cx, cy, -d) if
    // |x - cx| <= t wide (z + d) and |y - cy| <= t (z + d): each side of the picture needs one maximum over the points.
    constexpr double kNone = std::numeric_limits<double>::lowest();
    double right = kNone, left = kNone, top = kNone, bottom = kNone;
    for (const glm::vec3& point : points) {
        const glm::dvec3 v = glm::dvec3(point) - centre;
        const double x = glm::dot(v, axes.right), y = glm::dot(v, axes.up);
        const double z = camera.orthographic ? 0.0 : t * glm::dot(v, axes.forward);
        right = std::max(right, x - wide * z);
        left = std::max(left, -x - wide * z);
        top = std::max(top, y - z);
        bottom = std::max(bottom, -y - z);
    }
    if (points.empty()) right = left = top = bottom = 0.5;
    // Half the visible height in the plane through the centre.
    const double half = std::max({0.5 * (top + bottom), 0.5 * (right + left) / wide, 0.05 * radius});
    Camera result = camera;
    result.scale = kMargin * half;
    result.focal_point = centre + 0.5 * (right - left) * axes.right + 0.5 * (top - bottom) * axes.up;
    double distance = half / t;
    if (camera.orthographic)
        distance = std::max(distance, 1.5 * radius); // outside the tree, in case the projection changes
    result.position = result.focal_point - distance * axes.forward;
    result.view_up = axes.up;
    return result;
}

// Directions of the box, and of the four sides of the picture.
std::array<glm::dvec3, 10> fitting_directions(const Camera& camera, glm::ivec2 size) {
    const CameraAxes axes = axes_of(camera);
    const double t = camera.orthographic ? 0.0 : tan_half_angle(camera) / kMargin, wide = aspect(size);
    std::array<glm::dvec3, 10> directions{axes.right - wide * t * axes.forward, -axes.right - wide * t * axes.forward,
                                          axes.up - t * axes.forward, -axes.up - t * axes.forward};
    for (int i = 0; i < 3; ++i)
        for (const int side : {0, 1}) {
            directions.at(static_cast<std::size_t>(4 + 2 * i + side)) = glm::dvec3(0.0);
            directions.at(static_cast<std::size_t>(4 + 2 * i + side))[i] = side == 0 ? -1.0 : 1.0;
        }
    return directions;
}

Camera fitted(const Camera& camera, const Box& box, glm::ivec2 size) {
    const glm::vec3 lower(box.empty() ? glm::dvec3(-0.5) : box.lower), upper(box.empty() ? glm::dvec3(0.5) : box.upper);
    std::array<glm::vec3, 8> corners;
    for (std::size_t i = 0; i < corners.size(); ++i)
        corners[i] = {i & 1 ? upper.x : lower.x, i & 2 ? upper.y : lower.y, i & 4 ? upper.z : lower.z};
    return fitted(camera, std::span<const glm::vec3>(corners), size);
}

Camera camera_for(std::span<const glm::vec3> points, View view, glm::ivec2 size, bool orthographic) {
    return fitted(looking(Camera{.orthographic = orthographic}, view), points, size);
}

Camera camera_for(const Box& box, View view, glm::ivec2 size, bool orthographic) {
    return fitted(looking(Camera{.orthographic = orthographic}, view), box, size);
}

Camera with_projection(const Camera& camera, bool orthographic) {
    if (camera.orthographic == orthographic) return camera;
    Camera result = camera;
    const double half = half_height_mm(camera);
    result.orthographic = orthographic;
    result.scale = half;
    if (!orthographic) result.position = camera.focal_point - half / tan_half_angle(camera) * axes_of(camera).forward;
    return result;
}

Camera turned(const Camera& camera, double azimuth_deg, double elevation_deg) {
    Camera result = turned_about(camera, camera.focal_point, azimuth_deg, elevation_deg);
    result.focal_point = camera.focal_point; // to the last bit
    return result;
}

Camera zoomed(const Camera& camera, double factor) {
    if (!(factor > 0.0) || !std::isfinite(factor)) return camera;
    Camera result = camera;
    const CameraAxes axes = axes_of(camera);
    const double distance = glm::distance(camera.position, camera.focal_point);
    if (camera.orthographic)
        result.scale = std::max(camera.scale / factor, kSmallestDistance);
    else
        result.position = camera.focal_point - std::max(distance / factor, kSmallestDistance) * axes.forward;
    return result;
}

Camera centred_on(const Camera& camera, const glm::dvec3& point) {
    Camera result = camera;
    result.position += point - camera.focal_point;
    result.focal_point = point;
    return result;
}

Camera interpolated(const Camera& from, const Camera& to, double t) {
    if (t <= 0.0) return from;
    if (t >= 1.0) return to;
    const auto orientation = [](const Camera& camera) {
        const CameraAxes axes = axes_of(camera);
        return glm::quat_cast(glm::dmat3(axes.right, axes.up, -axes.forward));
    };
    const auto geometric = [t](double a, double b) { return std::exp(glm::mix(std::log(a), std::log(b), t)); };
    const glm::dquat turn = glm::slerp(orientation(from), orientation(to), t);
    Camera result = to;
    result.view_angle = glm::mix(from.view_angle, to.view_angle, t);
    result.scale = geometric(from.scale, to.scale);
    result.focal_point = glm::mix(from.focal_point, to.focal_point, t);
    const double distance = geometric(std::max(kSmallestDistance, glm::distance(from.position, from.focal_point)),
                                      std::max(kSmallestDistance, glm::distance(to.position, to.focal_point)));
    result.position = result.focal_point + distance * (turn * glm::dvec3(0.0, 0.0, 1.0));
    result.view_up = turn * glm::dvec3(0.0, 1.0, 0.0);
    return result;
}

} // namespace ramus::render
