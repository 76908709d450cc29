#include "app/picture/slice_marks.h"

#include "app/assets/assets.h"
#include "app/picture/lesion_lines.h"
#include "app/picture/scene_objects.h"
#include "app/picture/slices.h"
#include "core/base/lines.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

namespace ramus::app {

namespace {

constexpr float kFaint = 0.35F; // opacity

using MarkPath = std::vector<glm::dvec3>;

// Where a segment enters and leaves the slab around a plane, as shares of its length; empty: it does not meet it.
std::optional<glm::dvec2> part_within(double from, double to, double reach) {
    const double way = to - from;
    if (way == 0.0) return std::abs(from) <= reach ? std::optional(glm::dvec2(0.0, 1.0)) : std::nullopt;
    double enters = (-reach - from) / way;
    double leaves = (reach - from) / way;
    if (enters > leaves) std::swap(enters, leaves);
    enters = std::max(enters, 0.0);
    leaves = std::min(leaves, 1.0);
    return enters <= leaves ? std::optional(glm::dvec2(enters, leaves)) : std::nullopt;
}

bool meets(const MarkPath& line, const slice::Plane& plane, double reach) {
    for (std::size_t n = 0; n + 1 < line.size(); ++n)
        if (part_within(plane.height(line[n]), plane.height(line[n + 1]), reach)) return true;
    return false;
}

// The parts of a line within reach of the plane.
std::vector<MarkPath> parts_of(const MarkPath& line, const slice::Plane& plane, double reach) {
    std::vector<MarkPath> parts;
    bool open = false; // the last part goes on
    for (std::size_t n = 0; n + 1 < line.size(); ++n) {
        const auto part = part_within(plane.height(line[n]), plane.height(line[n + 1]), reach);
        if (part) {
            if (!open) parts.push_back({glm::mix(line[n], line[n + 1], part->x)});
            parts.back().push_back(glm::mix(line[n], line[n + 1], part->y));
        }
        open = part && part->y == 1.0;
    }
    return parts;
}

double distance_to(const MarkPath& line, const glm::dvec3& at) {
    double nearest = HUGE_VAL;
    for (std::size_t n = 0; n + 1 < line.size(); ++n)
        nearest = std::min(nearest, distance_to_line(at, line[n], line[n + 1]));
    return nearest;
}

void add_line(render::SliceView& view, const render::MarkLine& line, const slice::Plane& plane, double reach) {
    view.marks.push_back({line.points, line.colour, line.width, kFaint});
    for (MarkPath& part : parts_of(line.points, plane, reach))
        view.marks.push_back({std::move(part), line.colour, line.width, 1.0F});
}

} // namespace

double slice_reach_mm(const Session& session, const Assets& assets, slice::Direction direction) {
    return 0.5 * std::max(session.slices.sampling.slab_mm, step_mm(session, assets, direction));
}

void draw_marks(render::SliceView& view, const Session& session, const Assets& assets, slice::Direction direction,
                const Viewing& viewing) {
    // As in a picture of the tree that looks across the slice; what is not lines is left out.
    render::Frame frame;
    frame.camera = render::camera_of(view.grid);
    frame.size = view.grid.size;
    frame.pixel_ratio = viewing.pixel_ratio;
    draw_objects({frame, assets, viewing}, session.marks);
    if (assets.plan && assets.tree)
        draw_shortest_distances(frame, *assets.plan, session.marks, viewing.lesion, assets.tree->claims);
    draw_margins(frame, assets, session.marks);
    const slice::Plane plane = view.grid.plane();
    const double reach = slice_reach_mm(session, assets, direction);
    view.marks.clear();
    view.labels.clear();
    for (const render::MarkLine& line : frame.lines)
        if (meets(line.points, plane, reach)) add_line(view, line, plane, reach);
    // A label belongs to the line next to it.
    for (const render::MarkLabel& label : frame.labels) {
        const auto nearest = std::ranges::min_element(
            frame.lines, {}, [&](const render::MarkLine& line) { return distance_to(line.points, label.at); });
        if (nearest != frame.lines.end() && meets(nearest->points, plane, reach)) view.labels.push_back(label);
    }
}

} // namespace ramus::app
