#include "core/slice/vessel_path.h"

#include "core/measure/tree_measure.h"
#include "core/slice/path_curve.h"
#include "core/tree/voxels.h"

#include <algorithm>
#include <cmath>
#include <oneapi/tbb/parallel_for.h>
#include <string>

namespace ramus::slice {

namespace {

constexpr double kMostSamples = 1e6;
constexpr double kUsualStepMm = 0.5;

Result<void> check_branch_of(const tree::VesselTree& tree, int branch) {
    if (branch >= 0 && static_cast<std::size_t>(branch) < tree.branches.size()) return {};
    return fail("the tree has no branch " + std::to_string(branch), {},
                "branches are 0 to " + std::to_string(tree.branches.size() - 1));
}

double smallest_voxel_mm(const tree::VesselTree& tree) {
    if (!tree.voxels) return 0.0;
    const glm::dvec3 sizes = tree::sizes_mm(*tree.voxels);
    return std::min({sizes.x, sizes.y, sizes.z});
}

double length_of(const tree::VesselTree& tree, const std::vector<PathPart>& parts) {
    double length = 0.0;
    for (const PathPart& part : parts)
        length +=
            std::abs(part.to - part.from) * tree::length_mm(tree, tree.branches[static_cast<std::size_t>(part.branch)]);
    return length;
}

std::vector<glm::dvec3> smoothed_points(const PathCurve& curve, double voxel_mm) {
    if (voxel_mm == 0.0) return curve.points;
    std::vector<glm::dvec3> points(curve.points.size());
    const CurveFilter filter(curve.points);
    const double most_sigma = curve.length_mm() / 3.0;
    tbb::parallel_for(std::size_t{0}, points.size(), [&](std::size_t n) {
        const double sigma = std::min({0.5 * curve.radii[n], 2.0 * voxel_mm, most_sigma}) / curve.step_mm;
        const glm::dvec3 away = filter.mean(static_cast<double>(n), sigma) - curve.points[n];
        const double far = glm::length(away);
        points[n] = curve.points[n] + (far > 0.5 * voxel_mm ? 0.5 * voxel_mm / far : 1.0) * away;
    });
    return points;
}

// Rotates the axes of a sample to the next one without a turn about the tangent: two reflections.
Axes carried(const PathSample& from, const PathSample& to) {
    const glm::dvec3 way = to.at - from.at;
    const auto mirrored = [](const glm::dvec3& v, const glm::dvec3& across) {
        const double length2 = glm::dot(across, across);
        return length2 > 0.0 ? v - 2.0 / length2 * glm::dot(across, v) * across : v;
    };
    const glm::dvec3 tangent = mirrored(from.tangent, way);
    const glm::dvec3 turn = to.tangent - tangent;
    const double facing = glm::dot(from.axes.to_viewer(), from.tangent) < 0.0 ? -1.0 : 1.0;
    Axes axes{mirrored(mirrored(from.axes.right, way), turn), {}};
    axes.right = glm::normalize(axes.right - glm::dot(axes.right, to.tangent) * to.tangent); // rounding
    axes.down = glm::cross(axes.right, facing * to.tangent);
    return axes;
}

// The arc length of the file's centerline as a place.
measure::BranchPlace place_at(const std::vector<PathPart>& parts, double arc_mm) {
    const PathPart* part = &parts.front();
    for (const PathPart& one : parts)
        if (arc_mm > one.begin_mm) part = &one;
    const double length = part->end_mm - part->begin_mm;
    const double share = length > 0.0 ? std::clamp((arc_mm - part->begin_mm) / length, 0.0, 1.0) : 0.0;
    return {part->branch, part->from + share * (part->to - part->from)};
}

// Samples at equal steps of the smoothed curve. Sets the arc lengths of the parts to those of the smoothed curve.
void resample(const PathCurve& curve, const std::vector<glm::dvec3>& points, double step_mm, VesselPath& path) {
    std::vector<double> arcs{0.0};
    for (std::size_t n = 1; n < points.size(); ++n)
        arcs.push_back(arcs.back() + glm::distance(points[n - 1], points[n]));
    constexpr double kRoundingOfSteps = 1e-9;
    const auto steps = std::max(1.0, std::ceil(arcs.back() / step_mm - kRoundingOfSteps));
    path.step_mm = arcs.back() / steps;
    std::size_t segment = 1;
    for (double n = 0.0; n <= steps; ++n) {
        const double arc = n == steps ? arcs.back() : n * path.step_mm;
        while (segment + 1 < arcs.size() && arcs[segment] < arc) ++segment;
        const double share = std::clamp((arc - arcs[segment - 1]) / (arcs[segment] - arcs[segment - 1]), 0.0, 1.0);
        PathSample sample;
        sample.at = points[segment - 1] + share * (points[segment] - points[segment - 1]);
        sample.radius_mm = curve.radii[segment - 1] + share * (curve.radii[segment] - curve.radii[segment - 1]);
        sample.arc_mm = arc;
        sample.place = place_at(path.parts, curve.step_mm * (static_cast<double>(segment - 1) + share));
        path.samples.push_back(sample);
    }
    const auto smoothed_arc = [&](double file_arc) {
        const double at = file_arc / curve.step_mm;
        const std::size_t low = std::min(static_cast<std::size_t>(std::max(at, 0.0)), arcs.size() - 2);
        return arcs[low] + std::min(at - static_cast<double>(low), 1.0) * (arcs[low + 1] - arcs[low]);
    };
    for (PathPart& part : path.parts)
        part.begin_mm = smoothed_arc(part.begin_mm), part.end_mm = smoothed_arc(part.end_mm);
}

void set_frames(VesselPath& path, double voxel_mm) {
    std::vector<glm::dvec3> points;
    for (const PathSample& sample : path.samples) points.push_back(sample.at);
    const CurveFilter filter(points);
    tbb::parallel_for(std::size_t{0}, points.size(), [&](std::size_t n) {
        PathSample& sample = path.samples[n];
        const double least = std::max({0.25 * sample.radius_mm, 1.5 * voxel_mm, 2.0 * path.step_mm});
        const double from_end = std::min(sample.arc_mm, path.length_mm() - sample.arc_mm);
        const double wanted = std::max(least, std::min(sample.radius_mm, from_end / 3.0));
        const double sigma = std::max(1.0, std::min(wanted, path.length_mm() / 3.0) / path.step_mm);
        const glm::dvec3 direction = filter.direction(static_cast<double>(n), sigma);
        const double length = glm::length(direction);
        const std::size_t low = std::min(n, points.size() - 2);
        sample.tangent = length > 0.0 ? direction / length : glm::normalize(points[low + 1] - points[low]);
    });
    path.samples.front().axes = axes_across(path.samples.front().tangent);
    for (std::size_t n = 1; n < points.size(); ++n)
        path.samples[n].axes = carried(path.samples[n - 1], path.samples[n]);
}

Result<VesselPath> path_along(const tree::VesselTree& tree, std::vector<PathPart> parts, double step_mm) {
    const double voxel_mm = smallest_voxel_mm(tree);
    if (step_mm == 0.0) step_mm = voxel_mm > 0.0 ? 0.5 * voxel_mm : kUsualStepMm;
    if (!(step_mm > 0.0) || !std::isfinite(step_mm))
        return fail("the step along a vessel is not positive", {}, "use a step of about half a voxel");
    const double length = length_of(tree, parts);
    if (!(length > 0.0)) return fail("the way along the vessel begins where it ends", {}, "choose two places");
    if (length / step_mm > kMostSamples)
        return fail("the way along the vessel has more than a million steps", {}, "use a greater step");
    VesselPath path;
    path.parts = std::move(parts);
    // The curve is finer than the samples, so that corners of the centerline are not cut.
    const double fine_mm =
        std::max(std::min(0.5 * step_mm, voxel_mm > 0.0 ? 0.25 * voxel_mm : step_mm), length / (2.0 * kMostSamples));
    const PathCurve curve = curve_along(tree, path.parts, fine_mm);
    resample(curve, smoothed_points(curve, voxel_mm), step_mm, path);
    set_frames(path, voxel_mm);
    return path;
}

std::uint32_t end_point(const tree::VesselTree& tree, int branch, double fraction) {
    const auto& points = tree.branches[static_cast<std::size_t>(branch)].points;
    return fraction == 0.0 ? points.front() : points.back();
}

// The parts of a way through `branches` that leaves the first one at its end `leaves` and enters the last one at its
// end `enters`; empty if they are not connected so.
std::vector<PathPart> chained(const tree::VesselTree& tree, const std::vector<int>& branches, double from,
                              double leaves, double enters, double to) {
    std::vector<PathPart> parts{{branches.front(), from, leaves}};
    std::uint32_t node = end_point(tree, branches.front(), leaves);
    for (std::size_t b = 1; b + 1 < branches.size(); ++b) {
        const double begin = end_point(tree, branches[b], 0.0) == node ? 0.0 : 1.0;
        if (end_point(tree, branches[b], begin) != node) return {};
        parts.push_back({branches[b], begin, 1.0 - begin});
        node = end_point(tree, branches[b], 1.0 - begin);
    }
    if (end_point(tree, branches.back(), enters) != node) return {};
    parts.push_back({branches.back(), enters, to});
    return parts;
}

// The ends at which the shortest way leaves its first branch and enters its last one are those for which the lengths
// agree: between two nodes several branches may lead.
std::vector<PathPart> parts_of(const tree::VesselTree& tree, const measure::Path& way, double from, double to) {
    if (way.branches.size() == 1) return {{way.branches.front(), from, to}};
    std::vector<PathPart> best;
    for (const double leaves : {0.0, 1.0})
        for (const double enters : {0.0, 1.0}) {
            auto parts = chained(tree, way.branches, from, leaves, enters, to);
            const auto off = [&](const auto& those) { return std::abs(length_of(tree, those) - way.length_mm); };
            if (!parts.empty() && (best.empty() || off(parts) < off(best))) best = std::move(parts);
        }
    std::erase_if(best, [](const PathPart& part) { return part.from == part.to; });
    return best;
}

} // namespace

bool VesselPath::uses(int branch) const { return std::ranges::find(parts, branch, &PathPart::branch) != parts.end(); }

std::size_t VesselPath::nearest(double arc_mm) const {
    return std::min(static_cast<std::size_t>(std::lround(std::max(arc_mm / step_mm, 0.0))), samples.size() - 1);
}

PathSample VesselPath::at(double arc_mm) const {
    const double on = std::clamp(arc_mm, 0.0, length_mm());
    const auto low = std::min(static_cast<std::size_t>(on / step_mm), samples.size() - 2);
    const PathSample& a = samples[low];
    const PathSample& b = samples[low + 1];
    const double share = std::clamp(on / step_mm - static_cast<double>(low), 0.0, 1.0);
    PathSample sample = share < 0.5 ? a : b;
    sample.at = a.at + share * (b.at - a.at);
    sample.tangent = glm::normalize(a.tangent + share * (b.tangent - a.tangent));
    const double facing = glm::dot(a.axes.to_viewer(), a.tangent) < 0.0 ? -1.0 : 1.0;
    const glm::dvec3 right = a.axes.right + share * (b.axes.right - a.axes.right);
    sample.axes.right = glm::normalize(right - glm::dot(right, sample.tangent) * sample.tangent);
    sample.axes.down = glm::cross(sample.axes.right, facing * sample.tangent);
    sample.radius_mm = a.radius_mm + share * (b.radius_mm - a.radius_mm);
    sample.arc_mm = on;
    if (a.place.branch == b.place.branch) {
        sample.place.fraction = a.place.fraction + share * (b.place.fraction - a.place.fraction);
        return sample;
    }
    // Across a node: between a sample and the node.
    for (const PathPart& part : parts) {
        if (on < part.begin_mm || on > part.end_mm) continue;
        const double length = part.end_mm - part.begin_mm;
        sample.place = {part.branch,
                        part.from + (length > 0.0 ? (on - part.begin_mm) / length : 0.0) * (part.to - part.from)};
        break;
    }
    return sample;
}

std::optional<double> VesselPath::arc_of(const measure::BranchPlace& place) const {
    for (const PathPart& part : parts) {
        if (part.branch != place.branch || place.fraction < std::min(part.from, part.to) ||
            place.fraction > std::max(part.from, part.to))
            continue;
        // Knots: the samples of the part, and its ends.
        double fraction = part.from, arc = part.begin_mm;
        const auto reached = [&](double next_fraction, double next_arc) -> std::optional<double> {
            const double step = next_fraction - fraction;
            const double share = (place.fraction - fraction) / step; // not finite if the knots are equal
            if (place.fraction == fraction) return arc;
            if (share >= 0.0 && share <= 1.0) return arc + share * (next_arc - arc);
            fraction = next_fraction, arc = next_arc;
            return {};
        };
        auto sample = std::ranges::lower_bound(samples, part.begin_mm, {}, &PathSample::arc_mm);
        for (; sample != samples.end() && sample->arc_mm <= part.end_mm; ++sample)
            if (sample->place.branch == part.branch)
                if (const auto found = reached(sample->place.fraction, sample->arc_mm)) return found;
        if (const auto found = reached(part.to, part.end_mm)) return found;
    }
    return {};
}

Result<VesselPath> path_of_branch(const tree::VesselTree& tree, int branch, double step_mm) {
    if (auto there = check_branch_of(tree, branch); !there) return tl::unexpected(there.error());
    return path_along(tree, {{branch, 0.0, 1.0}}, step_mm);
}

Result<VesselPath> path_from_root(const tree::VesselTree& tree, int branch, double step_mm) {
    if (auto there = check_branch_of(tree, branch); !there) return tl::unexpected(there.error());
    std::vector<PathPart> parts;
    for (int at = branch; at != tree::kNoBranch; at = tree.branches[static_cast<std::size_t>(at)].parent)
        parts.push_back({at, 0.0, 1.0});
    std::ranges::reverse(parts);
    return path_along(tree, std::move(parts), step_mm);
}

Result<VesselPath> path_between(const tree::VesselTree& tree, const measure::BranchPlace& from,
                                const measure::BranchPlace& to, double step_mm) {
    for (const int branch : {from.branch, to.branch})
        if (auto there = check_branch_of(tree, branch); !there) return tl::unexpected(there.error());
    const double begin = std::clamp(from.fraction, 0.0, 1.0), end = std::clamp(to.fraction, 0.0, 1.0);
    const auto way = measure::path_between(tree, {from.branch, begin}, {to.branch, end});
    if (!way)
        return fail("branches " + std::to_string(from.branch) + " and " + std::to_string(to.branch) +
                        " are not connected",
                    {}, "choose two places of one vessel");
    std::vector<PathPart> parts = parts_of(tree, *way, begin, end);
    if (parts.empty()) return fail("the way along the vessel begins where it ends", {}, "choose two places");
    return path_along(tree, std::move(parts), step_mm);
}

} // namespace ramus::slice
