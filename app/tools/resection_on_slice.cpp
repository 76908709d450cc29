#include "app/tools/resection_on_slice.h"

#include "core/slice/level_lines.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace ramus::app {

namespace {

using HeightField = std::function<double(const glm::dvec3&)>;

// The height above a plane or a sheet; null for the other kinds.
HeightField heights_above(const Resection& resection) {
    if (resection.kind == Resection::Kind::kPlane)
        return [plane = slice::Plane{resection.point, resection.normal}](const glm::dvec3& at) {
            return plane.height(at);
        };
    if (resection.kind == Resection::Kind::kSheet)
        return [&sheet = resection.sheet](const glm::dvec3& at) { return organ::height_above(sheet, at); };
    return {};
}

// The nearest place of the section line, by Newton's method; none: the line is not there.
std::optional<glm::dvec3> foot_on_section(const slice::PixelGrid& grid, const HeightField& heights, glm::dvec3 at) {
    constexpr int kSteps = 8;
    constexpr double kFlat = 1e-3; // the slice is parallel to the surface
    for (int n = 0; n < kSteps; ++n) {
        const double height = heights(at);
        const glm::dvec3 slope = (heights(at + grid.right) - height) * grid.right / glm::dot(grid.right, grid.right) +
                                 (heights(at + grid.down) - height) * grid.down / glm::dot(grid.down, grid.down);
        const double squared = glm::dot(slope, slope);
        if (squared < kFlat * kFlat) return {};
        at -= height / squared * slope;
    }
    if (std::abs(heights(at)) > 0.5 * glm::length(grid.right)) return {};
    return at;
}

} // namespace

std::optional<SectionHold> section_under(const Pointing& pointing, double reach, bool sheets_only) {
    const slice::PixelGrid& grid = pointing.slice->grid;
    const glm::dvec3 at = grid.place(pointing.at - 0.5);
    const std::vector<Resection>& all = pointing.document.marks().resections;
    std::optional<SectionHold> found;
    for (std::size_t n = 0; n < all.size(); ++n) {
        const bool left_out = !all[n].visible || (sheets_only && all[n].kind != Resection::Kind::kSheet);
        const HeightField heights = left_out ? HeightField() : heights_above(all[n]);
        const auto foot = heights ? foot_on_section(grid, heights, at) : std::nullopt;
        if (!foot) continue;
        const double pixels = glm::distance(*foot, at) / glm::length(grid.right);
        if (pixels < (found ? found->pixels : reach)) found = SectionHold{n, *foot, pixels};
    }
    return found;
}

std::vector<ToolDrawing::Line> section_lines(const Pointing& pointing, const Resection& resection,
                                             const glm::vec4& colour) {
    const HeightField heights = heights_above(resection);
    if (!heights) return {};
    constexpr int kCoarse = 6; // pixels
    const slice::PixelGrid& grid = pointing.slice->grid;
    const slice::PixelGrid coarse{grid.corner, double{kCoarse} * grid.right, double{kCoarse} * grid.down,
                                  grid.size / kCoarse + 2};
    double steepest = 1.0;
    if (resection.kind == Resection::Kind::kSheet) {
        Bounds<glm::dvec3> box;
        for (const glm::dvec2& corner :
             {glm::dvec2(0.0), glm::dvec2(coarse.size.x, 0.0), glm::dvec2(0.0, coarse.size.y), glm::dvec2(coarse.size)})
            box.hold(coarse.place(corner));
        steepest = organ::steepest_in(resection.sheet, box);
    }
    const auto loops = slice::level_lines(coarse, std::array{0.0}, heights, steepest);
    std::vector<ToolDrawing::Line> lines;
    for (const slice::Loop& loop : loops.front()) {
        ToolDrawing::Line line{.points = {}, .colour = colour, .width = 1.5F, .closed = loop.closed};
        for (const slice::EdgePoint& point : loop.points) line.points.push_back(grid.pixel(point.at) + 0.5);
        lines.push_back(std::move(line));
    }
    return lines;
}

} // namespace ramus::app
