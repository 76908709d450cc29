#include "app/picture/slice_marks.h"

#include "app/assets/assets.h"
#include "app/picture/lesion_lines.h"
#include "app/picture/scene_objects.h"
#include "app/picture/slices.h"
#include "core/base/lines.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <utility>

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

void add_seed(std::vector<MarkPath>& lines, const glm::dvec3& at, const slice::PixelGrid& grid, double pixels) {
    for (const glm::dvec3& arm : {pixels * grid.right, pixels * grid.down}) lines.push_back({at - arm, at + arm});
}

// What a cut leaves on a plane: a circle, or the line where a disc meets the plane.
void add_cut(std::vector<MarkPath>& lines, const RegionCut& cut, const slice::PixelGrid& grid) {
    const slice::Plane plane = grid.plane();
    const double height = plane.height(cut.centre_mm);
    const glm::dvec3 foot = cut.centre_mm - height * plane.normal;
    if (!cut.normal) {
        const double left = cut.radius_mm * cut.radius_mm - height * height;
        if (left <= 0.0) return;
        constexpr int kCornersOfCircle = 48;
        const glm::dvec3 right = std::sqrt(left) * glm::normalize(grid.right);
        const glm::dvec3 down = std::sqrt(left) * glm::normalize(grid.down);
        MarkPath& circle = lines.emplace_back();
        for (int n = 0; n <= kCornersOfCircle; ++n) {
            const double angle = 2.0 * glm::pi<double>() * n / kCornersOfCircle;
            circle.push_back(foot + std::cos(angle) * right + std::sin(angle) * down);
        }
        return;
    }
    // The disc's plane meets the slice in a line, whose nearest point to the centre lies up or down the disc.
    const glm::dvec3 normal = glm::normalize(*cut.normal);
    const glm::dvec3 along = glm::cross(normal, plane.normal);
    const double sine = glm::length(along);
    if (sine < 1e-6) return;
    const glm::dvec3 steepest = glm::cross(along, normal) / sine; // within the disc
    const glm::dvec3 nearest = cut.centre_mm - height / glm::dot(steepest, plane.normal) * steepest;
    const double left = cut.radius_mm * cut.radius_mm - glm::dot(nearest - cut.centre_mm, nearest - cut.centre_mm);
    if (left <= 0.0) return;
    lines.push_back({nearest - std::sqrt(left) / sine * along, nearest + std::sqrt(left) / sine * along});
}

// Seeds and cuts of the region that a person grows.
void draw_region_marks(render::Frame& frame, const Assets& assets, const SceneObjects& objects,
                       const slice::PixelGrid& grid) {
    constexpr double kArmPoints = 5.0;
    const glm::vec3 seed_colour(0.25F, 0.84F, 0.88F);
    const glm::vec3 cut_colour(0.98F, 0.55F, 0.30F);
    const RegionOf& region = assets.region.now();
    const auto grown_in = scan_to_grow_in(objects);
    if (region.seeds.empty() || !grown_in || source_of(*grown_in) != region.scan) return;
    const auto scan = assets.scan(*grown_in);
    if (!scan) return;
    const auto draw = [&](std::vector<MarkPath> lines, const glm::vec3& colour) {
        for (MarkPath& line : lines) frame.lines.push_back({std::move(line), colour, 2.0F});
    };
    for (const glm::ivec3& seed : region.seeds) {
        std::vector<MarkPath> lines;
        add_seed(lines, place_of(*scan->volume, seed), grid, kArmPoints * double(frame.pixel_ratio));
        draw(std::move(lines), seed_colour);
    }
    for (const RegionCut& cut : region.cuts) {
        std::vector<MarkPath> lines;
        add_cut(lines, cut, grid);
        draw(std::move(lines), cut_colour);
    }
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
    draw_region_marks(frame, assets, session.marks, view.grid);
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
