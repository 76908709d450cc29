#include "core/slice/cross_section.h"

#include <algorithm>
#include <cmath>
#include <oneapi/tbb/parallel_for.h>

namespace ramus::slice {

namespace {

// A loop as a polygon.
struct Polygon {
    Outline outline;
    double twice_area;
};

// The smallest polygon around a point, of those for which `fits(index)`; none: kNoPolygon.
constexpr std::size_t kNoPolygon = static_cast<std::size_t>(-1);
template <class Fits>
std::size_t innermost(const std::vector<Polygon>& polygons, const glm::dvec2& at, const Fits& fits) {
    std::size_t found = kNoPolygon;
    for (std::size_t n = 0; n < polygons.size(); ++n)
        if (fits(n) && encloses(polygons[n].outline, at) &&
            (found == kNoPolygon || std::abs(polygons[n].twice_area) < std::abs(polygons[found].twice_area)))
            found = n;
    return found;
}

} // namespace

std::optional<Lumen> lumen_around(std::vector<Loop> loops, const Plane& plane, const glm::dvec3& at) {
    std::erase_if(loops, [](const Loop& loop) { return loop.points.size() < 3; });
    const PlaneAxes axes(plane);
    std::vector<Polygon> polygons;
    for (const Loop& loop : loops) {
        polygons.push_back({outline_of(loop, axes), 0.0});
        polygons.back().twice_area = twice_area(polygons.back().outline);
    }
    const glm::dvec2 middle = axes.on(at);
    std::size_t outer = innermost(polygons, middle, [&](std::size_t n) { return loops[n].closed; });
    if (outer == kNoPolygon) outer = innermost(polygons, middle, [&](std::size_t n) { return !loops[n].closed; });
    if (outer == kNoPolygon || polygons[outer].twice_area <= 0.0) return {};
    Lumen lumen{{}, loops[outer].closed, {}, {}};
    for (std::size_t n = 0; n < loops.size(); ++n) {
        if (polygons[n].twice_area >= 0.0 || !loops[n].closed) continue;
        const auto is_other = [&](std::size_t k) { return k != n && loops[k].closed == loops[outer].closed; };
        if (innermost(polygons, polygons[n].outline.front(), is_other) == outer)
            lumen.loops.push_back(std::move(loops[n]));
    }
    lumen.loops.insert(lumen.loops.begin(), std::move(loops[outer]));
    lumen.figures = figures_of(lumen.loops, plane);
    return lumen;
}

OtherBranches::OtherBranches(const tree::VesselTree& tree, const VesselPath& path) : tree_(&tree) {
    for (std::size_t b = 0; b < tree.branches.size(); ++b) {
        if (path.uses(static_cast<int>(b))) continue;
        Bounds<glm::dvec3> box;
        for (const std::uint32_t point : tree.branches[b].points) box.hold(tree.points[point].position);
        boxes_.emplace_back(static_cast<int>(b), box);
    }
}

std::vector<int> OtherBranches::through(const Lumen& lumen, const Plane& plane) const {
    const PlaneAxes axes(plane);
    const Outline outline = outline_of(lumen.loops.front(), axes);
    std::vector<int> found;
    for (const auto& [branch, box] : boxes_) {
        if (!plane_crosses(plane, box)) continue;
        const auto& points = tree_->branches[static_cast<std::size_t>(branch)].points;
        for (std::size_t i = 1; i < points.size(); ++i) {
            const glm::dvec3& a = tree_->points[points[i - 1]].position;
            const glm::dvec3& b = tree_->points[points[i]].position;
            const double from = plane.height(a), to = plane.height(b);
            if ((from >= 0.0) == (to >= 0.0)) continue;
            if (!encloses(outline, axes.on(a + from / (from - to) * (b - a)))) continue;
            found.push_back(branch);
            break;
        }
    }
    return found;
}

std::vector<std::optional<Lumen>> lumens_along(std::span<const PathSample> samples, const LoopsOfPlane& loops,
                                               const OtherBranches& others) {
    std::vector<std::optional<Lumen>> lumens(samples.size());
    tbb::parallel_for(std::size_t{0}, lumens.size(), [&](std::size_t n) {
        const PathSample& sample = samples[n];
        lumens[n] = lumen_around(loops(sample.plane()), sample.plane(), sample.at);
        if (lumens[n]) lumens[n]->shared_with = others.through(*lumens[n], sample.plane());
    });
    return lumens;
}

PixelGrid cross_grid(const PathSample& sample, double mm_per_pixel, int pixels) {
    return grid_around(sample.axes, sample.at, mm_per_pixel, glm::ivec2(pixels));
}

} // namespace ramus::slice
