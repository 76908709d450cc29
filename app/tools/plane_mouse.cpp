#include "app/tools/plane_mouse.h"

#include "app/tools/viewport_mouse.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace ramus::app {

namespace {

constexpr double kEdgeReach = 6.0; // points by which the pointer may miss an edge
constexpr int kPiecesOfEdge = 24;  // each short enough to be straight, and before or behind the eye as a whole

struct SeenPlace {
    glm::dvec2 pixel;
    glm::dvec3 place;
};

// Calls `use(from, to)` for the pieces of the plane's edges that are before the eye.
template <class Use> void for_pieces(const render::ScanPlane& plane, const PlaneSight& sight, const Use& use) {
    const render::Projector project(sight.camera, sight.size);
    const std::array corners{plane.corner, plane.corner + plane.right, plane.corner + plane.right + plane.down,
                             plane.corner + plane.down};
    for (std::size_t side = 0; side < corners.size(); ++side) {
        std::optional<SeenPlace> before;
        for (int n = 0; n <= kPiecesOfEdge; ++n) {
            const glm::dvec3 place =
                glm::mix(corners[side], corners[(side + 1) % corners.size()], static_cast<double>(n) / kPiecesOfEdge);
            const auto pixel = project(place);
            const auto here = pixel ? std::optional(SeenPlace{glm::dvec2(*pixel), place}) : std::nullopt;
            if (before && here) use(*before, *here);
            before = here;
        }
    }
}

} // namespace

std::vector<slice::Direction> slices_among_vessels(const SliceViews& views) {
    std::vector<slice::Direction> slices;
    for (const auto& known : slice::kDirections)
        if (views.in_picture[slice_index(known.first)]) slices.push_back(known.first);
    return slices;
}

std::optional<PlaneEdge> edge_under(std::span<const render::ScanPlane> planes, const PlaneSight& sight, glm::dvec2 at) {
    std::optional<PlaneEdge> found;
    double nearest = kEdgeReach * static_cast<double>(sight.pixel_ratio);
    for (std::size_t n = 0; n < planes.size(); ++n)
        for_pieces(planes[n], sight, [&](const SeenPlace& from, const SeenPlace& to) {
            const glm::dvec2 along = to.pixel - from.pixel;
            const double length = glm::dot(along, along);
            const double t = length > 0.0 ? glm::clamp(glm::dot(at - from.pixel, along) / length, 0.0, 1.0) : 0.0;
            const double away = glm::distance(at, from.pixel + t * along);
            if (away >= nearest) return;
            nearest = away;
            found = PlaneEdge{n, glm::mix(from.place, to.place, t),
                              glm::normalize(glm::cross(planes[n].down, planes[n].right))};
        });
    return found;
}

std::vector<glm::dvec2> outline_of(const render::ScanPlane& plane, const PlaneSight& sight) {
    std::vector<glm::dvec2> outline;
    for_pieces(plane, sight, [&](const SeenPlace& from, const SeenPlace& to) {
        if (outline.empty()) outline.push_back(from.pixel);
        outline.push_back(to.pixel);
    });
    return outline;
}

double slid_mm(const glm::dvec3& place, const glm::dvec3& normal, const PlaneSight& sight, glm::dvec2 from,
               glm::dvec2 to) {
    const render::Projector project(sight.camera, sight.size);
    const auto at = project(place);
    const double pixel_mm = render::mm_per_pixel(sight.camera, sight.size);
    const auto ahead = project(place + pixel_mm * normal);
    if (!at || !ahead) return 0.0;
    constexpr double kFromFront = 0.2; // a normal that is seen shorter than this share of its length has no direction
    const glm::dvec2 seen = glm::dvec2(*ahead) - glm::dvec2(*at);
    if (glm::length(seen) < kFromFront) {
        const double sign = glm::dot(normal, render::axes_of(sight.camera).forward) < 0.0 ? 1.0 : -1.0;
        return sign * pixel_mm * (to.y - from.y);
    }
    // The place of the normal's line that is nearest to the line of sight through the pixel.
    const glm::dvec2 pixel = glm::dvec2(*at) + to - from;
    const glm::dvec3 eye = render::unproject(sight.camera, sight.size, pixel, 0.0);
    const glm::dvec3 ray = glm::normalize(render::unproject(sight.camera, sight.size, pixel, at->z) - eye);
    const double both = glm::dot(normal, ray);
    const glm::dvec3 between = eye - place;
    return (glm::dot(between, normal) - both * glm::dot(between, ray)) / (1.0 - both * both);
}

void PlaneMouse::grab(const PlaneEdge& edge, slice::Direction direction, const glm::dvec3& crosshair, glm::dvec2 at) {
    held_ = Held{edge, direction, crosshair, at};
}

glm::dvec3 PlaneMouse::move(const PlaneSight& sight, const Bounds<glm::dvec3>& bounds, glm::dvec2 to) {
    Held& held = *held_;
    held.dragged |=
        glm::distance(held.at, to) >= ViewportMouse::kDragThreshold * static_cast<double>(sight.pixel_ratio);
    if (!held.dragged) return held.crosshair;
    const glm::dvec3& normal = held.edge.normal;
    const double by = slid_mm(held.edge.place, normal, sight, held.at, to);
    if (bounds.is_empty()) return held.crosshair + by * normal;
    const double middle = glm::dot(0.5 * (bounds.least + bounds.most), normal);
    const double half = glm::dot(0.5 * bounds.size(), glm::abs(normal));
    const double now = glm::dot(held.crosshair, normal);
    return held.crosshair + (glm::clamp(now + by, middle - half, middle + half) - now) * normal;
}

} // namespace ramus::app
