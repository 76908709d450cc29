#include "render/scene/seen_plane.h"

#include "core/base/across.h"
#include "render/image/image.h"
#include "render/scene/late_picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>

namespace ramus::render {

namespace {

constexpr double kBehind = 0.05, kLaterBehind = 0.01; // pixels by which planes are moved away from the eye
constexpr double kLeastDepth = 1e-4; // where edges that reach behind the eye end, of the plane's largest depth

double applied(const glm::dvec3& row, const glm::dvec2& pixel) { return row.x * pixel.x + row.y * pixel.y + row.z; }

Sight sight_of(const ViewBlock& view) {
    const glm::vec4& pixel = view.pixel_to_eye;
    return {{pixel.x, pixel.y}, pixel.z, view.picture.w > 0.5F};
}

// Values in the depth buffer, of (x, y, 1) of a pixel: the inverse of eye_depth() in view.glsl. `behind`: pixels by
// which the plane is moved away from the eye.
glm::dvec3 values_of(const SeenPlane& seen, const ViewBlock& view, double behind) {
    const double y = view.clip_to_eye.y, z = view.clip_to_eye.z, away = behind * double(view.pixel_to_eye.z);
    return seen.flat ? seen.depth / y + glm::dvec3(0.0, 0.0, away / y + z)
                     : z * (1.0 - away) * seen.inverse - glm::dvec3(0.0, 0.0, y);
}

// The most by which they differ between a pixel's middle and a sample.
double change_of(const glm::dvec3& values) { return 0.5 * (std::abs(values.x) + std::abs(values.y)); }

glm::dmat4 eye_of(const Camera& camera) { // depth is +z
    return glm::scale(glm::dmat4(1.0), {1.0, 1.0, -1.0}) * view_matrix(camera);
}

glm::vec4 as_row(const glm::dvec3& row, double last) { return {glm::vec3(row), static_cast<float>(last)}; }

// The edges of a plane in the picture.
struct SeenEdges {
    std::array<glm::dvec2, 4> from, to;   // pixels
    std::array<double, 4> from_mm, to_mm; // depths; negative: the edge is behind the eye
    glm::dvec2 least{1e30}, most{-1e30};
};

SeenEdges edges_of(const ScanPlane& plane, const glm::dmat4& to_eye, const Sight& sight) {
    std::array<glm::dvec3, 4> corners{plane.corner, plane.corner + plane.right, plane.corner + plane.right + plane.down,
                                      plane.corner + plane.down};
    double farthest = 0.0;
    for (glm::dvec3& corner : corners) {
        corner = glm::dvec3(to_eye * glm::dvec4(corner, 1.0));
        farthest = std::max(farthest, corner.z);
    }
    SeenEdges edges;
    for (std::size_t k = 0; k < 4; ++k) {
        glm::dvec3 a = corners.at(k), b = corners.at((k + 1) % 4);
        const double least = kLeastDepth * farthest;
        if (!sight.flat && std::max(a.z, b.z) <= least) {
            edges.from.at(k) = edges.to.at(k) = glm::dvec2(-1e6);
            edges.from_mm.at(k) = edges.to_mm.at(k) = -1.0;
            continue;
        }
        if (!sight.flat && a.z < least) a += (least - a.z) / (b.z - a.z) * (b - a);
        if (!sight.flat && b.z < least) b += (least - b.z) / (a.z - b.z) * (a - b);
        const auto pixel = [&](const glm::dvec3& p) {
            const glm::dvec2 at = sight.centre + glm::dvec2(p) / (sight.mm_a_pixel * (sight.flat ? 1.0 : p.z));
            edges.least = glm::min(edges.least, at);
            edges.most = glm::max(edges.most, at);
            return at;
        };
        edges.from.at(k) = pixel(a);
        edges.to.at(k) = pixel(b);
        edges.from_mm.at(k) = a.z;
        edges.to_mm.at(k) = b.z;
    }
    return edges;
}

} // namespace

const Image* picture_of(const ScanPlane& plane) {
    const Image* image = plane.picture ? &plane.picture->image() : nullptr;
    const bool whole = image != nullptr && image->width > 0 && image->height > 0 &&
                       image->rgba.size() == 4 * std::size_t(image->width) * std::size_t(image->height);
    return whole ? image : nullptr;
}

Sight sight_of(const Camera& camera, glm::ivec2 size) {
    return {0.5 * glm::dvec2(size),
            camera.orthographic ? mm_per_pixel(camera, size)
                                : 2.0 * std::tan(glm::radians(0.5 * camera.view_angle)) / size.y,
            camera.orthographic};
}

// In perspective a pixel's ray is z q with q = (x, y, 1). From z q = c + u r + v d follows (u, v, 1) / z = M q, where M
// inverts the matrix of r, d and c. Without perspective u and v follow from x and y alone.
SeenPlane SeenPlane::of(const ScanPlane& plane, const glm::dmat4& to_eye, const Sight& sight) {
    const glm::dvec3 c(to_eye * glm::dvec4(plane.corner, 1.0));
    const glm::dvec3 r(to_eye * glm::dvec4(plane.right, 0.0)), d(to_eye * glm::dvec4(plane.down, 0.0));
    const auto of_pixel = [&](const glm::dvec3& row) { // from one applied to (x, y, 1)
        const glm::dvec2 per_pixel = sight.mm_a_pixel * glm::dvec2(row);
        return glm::dvec3(per_pixel, row.z - glm::dot(per_pixel, sight.centre));
    };
    SeenPlane seen;
    seen.flat = sight.flat;
    const double size = glm::length(glm::cross(r, d));
    if (sight.flat) {
        const double area = r.x * d.y - r.y * d.x;
        if (!(std::abs(area) > 1e-9 * size)) return seen;
        const glm::dvec3 across = glm::dvec3(d.y, -d.x, d.x * c.y - d.y * c.x) / area;
        const glm::dvec3 down = glm::dvec3(-r.y, r.x, r.y * c.x - r.x * c.y) / area;
        seen.across = of_pixel(across);
        seen.down = of_pixel(down);
        seen.inverse = {0.0, 0.0, 1.0};
        seen.depth = of_pixel(r.z * across + d.z * down + glm::dvec3(0.0, 0.0, c.z));
        return seen;
    }
    const glm::dmat3 edges(r, d, c);
    if (!(std::abs(glm::determinant(edges)) > 1e-9 * size * glm::length(c))) return seen;
    const glm::dmat3 rows = glm::transpose(glm::inverse(edges));
    seen.across = of_pixel(rows[0]);
    seen.down = of_pixel(rows[1]);
    seen.inverse = of_pixel(rows[2]);
    return seen;
}

std::optional<double> SeenPlane::depth_at(glm::dvec2 pixel, const Image& picture) const {
    const double weight = applied(inverse, pixel);
    if (!(weight > 0.0)) return {};
    const glm::dvec2 at = glm::dvec2(applied(across, pixel), applied(down, pixel)) / weight;
    if (!(at.x >= 0.0 && at.y >= 0.0 && at.x <= 1.0 && at.y <= 1.0)) return {};
    const int x = std::min(static_cast<int>(at.x * picture.width), picture.width - 1);
    const int y = std::min(static_cast<int>(at.y * picture.height), picture.height - 1);
    if (picture.pixel(x, y)[3] < 128) return {};
    return flat ? applied(depth, pixel) : 1.0 / weight;
}

SeenPlanes::SeenPlanes(const std::vector<ScanPlane>& planes, const Camera& camera, glm::ivec2 size) {
    const glm::dmat4 to_eye = eye_of(camera);
    const Sight sight = sight_of(camera, size);
    for (std::size_t i = 0; i < std::min(planes.size(), std::size_t{kMostPlanes}); ++i) {
        seen_.push_back(SeenPlane::of(planes[i], to_eye, sight));
        pictures_.push_back(picture_of(planes[i]));
    }
}

PlaneHit SeenPlanes::at(glm::dvec2 pixel) const {
    PlaneHit nearest;
    for (std::size_t i = 0; i < seen_.size(); ++i) {
        if (!pictures_[i]) continue;
        const auto depth = seen_[i].depth_at(pixel, *pictures_[i]);
        if (depth && (nearest.plane == kNoPlane || *depth < nearest.depth_mm)) nearest = {static_cast<int>(i), *depth};
    }
    return nearest;
}

void add_planes(const std::vector<ScanPlane>& planes, DepthMap& map) {
    const SeenPlanes seen(planes, map.camera, map.picture);
    if (seen.empty()) return;
    const glm::dvec2 step = glm::dvec2(map.picture) / glm::dvec2(map.size);
    float* depth = map.depths.data();
    for (int y = 0; y < map.size.y; ++y)
        for (int x = 0; x < map.size.x; ++x, ++depth)
            if (const PlaneHit hit = seen.at(step * (glm::dvec2(x, y) + 0.5)); hit.plane != kNoPlane)
                *depth = std::min(*depth, static_cast<float>(hit.depth_mm));
}

std::optional<glm::vec4> cap_values_of(const CutAway& cut, const Camera& camera, const ViewBlock& view) {
    const glm::dvec3 to_viewer =
        camera.orthographic ? -axes_of(camera).forward : glm::normalize(camera.position - cut.point);
    if (!(glm::dot(cut.normal, to_viewer) > 1e-9)) return {};
    ScanPlane plane;
    plane.corner = cut.point;
    const auto [right, down] = axes_across(cut.normal);
    plane.right = right;
    plane.down = down;
    const SeenPlane seen = SeenPlane::of(plane, eye_of(camera), sight_of(view));
    if (seen.inverse == glm::dvec3(0.0)) return {};
    const glm::dvec3 values = values_of(seen, view, 0.0);
    return as_row(values, change_of(values));
}

PlanesBlock planes_block(const std::vector<ScanPlane>& planes, const glm::dmat4& to_eye, const ViewBlock& view,
                         float pixels_a_point) {
    const Sight sight = sight_of(view);
    const glm::vec4& to_depth = view.clip_to_eye;
    const glm::dvec2 shift = sight.centre - 0.5 * glm::dvec2(view.picture);
    PlanesBlock block{};
    const std::size_t count = std::min(planes.size(), std::size_t{kMostPlanes});
    block.plane_counts = {static_cast<float>(count), glm::vec2(shift), 0.0F};
    for (std::size_t i = 0; i < count; ++i) {
        const ScanPlane& plane = planes[i];
        const SeenPlane seen = SeenPlane::of(plane, to_eye, sight);
        const SeenEdges edges = edges_of(plane, to_eye, sight);
        const glm::dvec3 values = values_of(seen, view, kBehind + kLaterBehind * static_cast<double>(i));
        const auto value_of = [&](double mm) {
            return sight.flat ? mm / double(to_depth.y) + double(to_depth.z)
                              : double(to_depth.z) / mm - double(to_depth.y);
        };
        const float width = plane.outline_width > 0.0F ? std::max(1.0F, plane.outline_width * pixels_a_point) : 0.0F;
        const Image* picture = picture_of(plane);
        const glm::dvec2 size = picture != nullptr ? glm::dvec2(picture->width, picture->height) : glm::dvec2(0.0);
        glm::vec4* rows = block.plane_rows + kPlaneRows * i;
        rows[0] = as_row(seen.across, size.x);
        rows[1] = as_row(seen.down, size.y);
        rows[2] = as_row(seen.inverse, 0.0);
        rows[3] = as_row(values, double(width));
        rows[4] = glm::vec4(plane.outline, 0.0F);
        rows[5] = glm::vec4(edges.least - double(width) - 1.0, edges.most + double(width) + 1.0);
        for (int k = 0; k < 4; ++k) {
            const auto edge = static_cast<std::size_t>(k);
            const bool there = edges.from_mm.at(edge) > 0.0 || sight.flat;
            rows[6][k] = there ? static_cast<float>(value_of(edges.from_mm.at(edge))) : kNoSlice;
            rows[7][k] = there ? static_cast<float>(value_of(edges.to_mm.at(edge))) : kNoSlice;
            rows[8 + k] = glm::vec4(edges.from.at(edge), edges.to.at(edge));
        }
        const glm::dvec3 lines[] = {seen.across, seen.down, seen.inverse - seen.across, seen.inverse - seen.down};
        for (int k = 0; k < 4; ++k) {
            const double slope = std::max(glm::length(glm::dvec2(lines[k])), 1e-300);
            rows[12 + k] = as_row(lines[k] / slope, change_of(values));
        }
    }
    return block;
}

} // namespace ramus::render
