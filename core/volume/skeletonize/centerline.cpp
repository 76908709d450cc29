#include "core/volume/skeletonize/centerline.h"

#include "core/base/bounds.h"
#include "core/volume/skeletonize/sampled_line.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <numbers>
#include <oneapi/tbb/parallel_for.h>

namespace ramus::volume {

namespace {

// How far a tube with the volume of an end extends beyond its last point, in radii. The surface of a tree ends as a
// dome 0.707 radii beyond the last point (the paper's kernel: half of a line's sum), with the volume of 0.277 radii of
// the tube. A value between the two keeps the surface near to both flat and round ends.
constexpr double kBeyondEnd = 0.66;
// Tuned on grown trees and masks of patients: how far positions, their corrections and areas are smoothed along a
// vessel, in its radii.
constexpr double kSmoothPositions = 1.0, kSmoothShifts = 0.6, kSmoothAreas = 0.25;
constexpr double kFlat = 1.255; // see radius_of()
// The radius at a node, in radii of its inscribed ball: where vessels meet, the wall is farther out than the ball.
constexpr double kNode = 1.165;
// No point is clear within kTip radii of an end, in radii of the largest ball there. A ball counts if its centre is
// within kReach of its radii.
constexpr double kTip = 0.75, kReach = 1.2;
// An end that extends farther than a tube of its volume by this factor is treated as a cone.
constexpr double kLonger = 1.15;
constexpr int kCentrings = 2;

// The ellipse with the second moments of a cross-section. Half axes are at least `least`, the value for one voxel.
struct Ellipse {
    double longer = 0.0, shorter = 0.0; // half axes, mm
};
Ellipse ellipse_of(const Slab& slab, const glm::dvec3& along, double least) {
    const glm::dvec3 aside = std::abs(along.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    const glm::dvec3 u = glm::normalize(glm::cross(along, aside)), v = glm::cross(along, u);
    const glm::dvec3 centre = slab.moment / slab.volume;
    const glm::dmat3 spread = slab.second / slab.volume - glm::outerProduct(centre, centre);
    const double uu = glm::dot(u, spread * u), vv = glm::dot(v, spread * v), uv = glm::dot(u, spread * v);
    const double mean = 0.5 * (uu + vv), half = std::hypot(0.5 * (uu - vv), uv);
    return {std::max(2.0 * std::sqrt(mean + half), least),
            std::max(2.0 * std::sqrt(std::max(mean - half, 0.0)), least)};
}

// The radius of the circle with the area of the cross-section. For a flat cross-section, where the border of the volume
// cuts the vessel or several vessels are side by side, that circle would extend beyond the mask. Then the radius is
// limited by kFlat and the ratio of the ellipse's half axes.
double radius_of(const Slab& slab, const glm::dvec3& along, double least) {
    const Ellipse ellipse = ellipse_of(slab, along, least);
    return std::sqrt(slab.volume / slab.length / std::numbers::pi) *
           std::min(1.0, kFlat * std::sqrt(ellipse.shorter / std::max(ellipse.longer, 1e-12)));
}

class Tracer {
public:
    Tracer(const VoxelGraph& graph, const VoxelSet& set, const BranchVoxels& branch_voxels)
        : graph_(graph), set_(set), branch_voxels_(branch_voxels), degrees_(graph.degrees()),
          sampled_lines_(graph.lines.size()) {
        const glm::dvec3& s = set.spacing();
        voxel_ = std::cbrt(s.x * s.y * s.z);
        largest_ = std::max({s.x, s.y, s.z});
    }

    // Stops early when `job` is cancelled.
    void run(const JobRange& job) {
        const auto for_lines = [&](int step, const auto& call) {
            std::atomic<std::size_t> done = 0;
            tbb::parallel_for(std::size_t{0}, sampled_lines_.size(), [&](std::size_t l) {
                if (job.cancelled()) return;
                call(l);
                job.report((static_cast<float>(step) +
                            static_cast<float>(++done) / static_cast<float>(sampled_lines_.size())) /
                           (kCentrings + 1.0F));
            });
        };
        for (int n = 0; n < kCentrings; ++n) {
            for_lines(n, [&](std::size_t l) {
                if (n == 0) begin(l);
                const std::vector<Slab> slabs = slabs_of(sampled_lines_[l], branch_voxels_.of(l), set_);
                shift(l, shifts_to_centroids(sampled_lines_[l], slabs));
            });
        }
        for_lines(kCentrings, [&](std::size_t l) { finish(l); });
    }
    [[nodiscard]] const std::vector<SampledLine>& sampled_lines() const { return sampled_lines_; }
    [[nodiscard]] bool is_end(int n) const { return degrees_[static_cast<std::size_t>(n)] == 1; }
    [[nodiscard]] int degree(std::size_t n) const { return degrees_[n]; }

private:
    [[nodiscard]] const MidPoint& node(int n) const { return graph_.nodes[static_cast<std::size_t>(n)]; }

    void begin(std::size_t l) {
        SampledLine& sampled = sampled_lines_[l];
        sampled = resampled(graph_, graph_.lines[l], voxel_);
        smooth_positions(sampled,
                         [&](std::size_t i) { return std::max(largest_, kSmoothPositions * sampled.radius[i]); });
        mark_clear(sampled, graph_.lines[l]);
    }

    // The distance from a node within which no point is clear. At a node of several lines: the radius of its ball. At
    // an end, which the line may approach obliquely: kTip times the largest ball of this vessel that reaches there.
    [[nodiscard]] double unclear_around(int node_number, int other, const SampledLine& sampled) const {
        const MidPoint& here = node(node_number);
        if (!is_end(node_number)) return here.distance;
        double ball = 0.0;
        for (std::size_t i = 0; i < sampled.at.size(); ++i) {
            const bool of_other =
                !is_end(other) && glm::distance(sampled.at[i], node(other).position) < node(other).distance;
            if (!of_other && glm::distance(sampled.at[i], here.position) < kReach * sampled.radius[i])
                ball = std::max(ball, sampled.radius[i]);
        }
        return kTip * ball;
    }

    // If no point of a short leaf line is clear, tries half and a quarter of the distances, then the middle point.
    void mark_clear(SampledLine& sampled, const VoxelGraph::Line& line) const {
        const bool leaf = is_end(line.from) || is_end(line.to);
        const std::array<std::pair<glm::dvec3, double>, 2> around = {
            std::pair(node(line.from).position, unclear_around(line.from, line.to, sampled)),
            std::pair(node(line.to).position, unclear_around(line.to, line.from, sampled))};
        for (const double part : {1.0, 0.5, 0.25}) {
            if (part < 1.0 && !leaf) return;
            sampled.clear.assign(sampled.at.size(), 1);
            for (const auto& [middle, reach] : around)
                for (std::size_t i = 0; i < sampled.at.size(); ++i)
                    if (glm::distance(sampled.at[i], middle) < part * reach) sampled.clear[i] = 0;
            sampled.clear.front() = sampled.clear.back() = 0;
            if (std::ranges::find(sampled.clear, 1) != sampled.clear.end()) return;
        }
        if (leaf) sampled.clear[sampled.last() / 2] = 1;
    }

    // The weighted sum of the slabs of clear points around point `i`; `sigma` in mm.
    [[nodiscard]] static Slab clear_sum(const SampledLine& sampled, const std::vector<Slab>& slabs, std::size_t i,
                                        double sigma) {
        Slab sum;
        for_weights(i, sampled.at.size(), sigma / sampled.step, [&](std::size_t j, double weight) {
            if (sampled.clear[j] == 0) return;
            sum.volume += weight * slabs[j].volume;
            sum.length += weight * slabs[j].length;
            sum.moment += weight * slabs[j].moment;
            sum.second += weight * slabs[j].second;
        });
        return sum;
    }

    // The shift of each point to the centroid of its cross-section, perpendicular to the line. 0 for points not clear.
    [[nodiscard]] std::vector<glm::dvec3> shifts_to_centroids(const SampledLine& sampled,
                                                              const std::vector<Slab>& slabs) const {
        std::vector<glm::dvec3> shifts(sampled.at.size(), glm::dvec3(0.0));
        for (std::size_t i = 0; i < sampled.at.size(); ++i) {
            if (sampled.clear[i] == 0) continue;
            const Slab sum = clear_sum(sampled, slabs, i, std::max(largest_, kSmoothShifts * sampled.radius[i]));
            if (sum.volume <= 0.0) continue;
            const glm::dvec3 along = direction(sampled, i), shift = sum.moment / sum.volume;
            shifts[i] = shift - glm::dot(shift, along) * along;
        }
        return shifts;
    }
    [[nodiscard]] glm::dvec3 direction(const SampledLine& sampled, std::size_t i) const {
        const double reach = std::max(largest_, 0.5 * sampled.radius[i]);
        const auto away = std::max<std::size_t>(1, static_cast<std::size_t>(std::lround(reach / sampled.step)));
        return unit(sampled.at[std::min(i + away, sampled.last())] - sampled.at[i > away ? i - away : 0]);
    }
    [[nodiscard]] static glm::dvec3 unit(const glm::dvec3& v) { return v / std::max(glm::length(v), 1e-12); }

    [[nodiscard]] static std::size_t first_clear(const SampledLine& sampled) {
        return static_cast<std::size_t>(std::ranges::find(sampled.clear, 1) - sampled.clear.begin());
    }
    [[nodiscard]] static std::size_t last_clear(const SampledLine& sampled) {
        std::size_t i = sampled.last();
        while (sampled.clear[i] == 0) --i;
        return i;
    }

    // The bounding box of a line and its voxels. Shifted points are clamped to it, because for very anisotropic voxels
    // the centroid of an oblique cross-section can be outside of the mask.
    [[nodiscard]] Bounds<glm::dvec3> room_of(std::size_t l) const {
        Bounds<glm::dvec3> room;
        for (const glm::dvec3& at : sampled_lines_[l].at) room.hold(at);
        for (const BranchVoxels::Member& member : branch_voxels_.of(l)) {
            const glm::dvec3 middle = set_.spacing() * glm::dvec3(set_.voxel(member.at));
            room.hold({middle - 0.5 * set_.spacing(), middle + 0.5 * set_.spacing()});
        }
        return room;
    }

    // Points that are not clear follow the nearest clear point: completely at an end, and less and less toward a node,
    // which stays.
    void shift(std::size_t l, std::vector<glm::dvec3> shifts) {
        SampledLine& sampled = sampled_lines_[l];
        const VoxelGraph::Line& line = graph_.lines[l];
        const std::size_t first = first_clear(sampled);
        if (first == sampled.at.size()) return;
        const std::size_t last = last_clear(sampled);
        const glm::dvec3 from = is_end(line.from) ? shifts[first] : glm::dvec3(0.0);
        const glm::dvec3 to = is_end(line.to) ? shifts[last] : glm::dvec3(0.0);
        for (std::size_t i = 0; i < first; ++i) shifts[i] = glm::mix(from, shifts[first], part(i, first));
        for (std::size_t i = last + 1; i <= sampled.last(); ++i)
            shifts[i] = glm::mix(shifts[last], to, part(i - last, sampled.last() - last));
        const Bounds<glm::dvec3> room = room_of(l);
        for (std::size_t i = 0; i < sampled.at.size(); ++i)
            sampled.at[i] = glm::clamp(sampled.at[i] + shifts[i], room.least, room.most);
        smooth_positions(sampled, [&](std::size_t i) { return std::max(voxel_, kSmoothShifts * sampled.radius[i]); });
    }

    void finish(std::size_t l) {
        SampledLine& sampled = sampled_lines_[l];
        const VoxelGraph::Line& line = graph_.lines[l];
        std::vector<Slab> slabs = slabs_of(sampled, branch_voxels_.of(l), set_);
        measure_radii(sampled, slabs, line);
        if (line.from == line.to) return;
        if (is_end(line.to)) reach_end(sampled, slabs);
        if (is_end(line.from)) {
            const auto turn = [&] {
                std::ranges::reverse(sampled.at), std::ranges::reverse(sampled.radius);
                std::ranges::reverse(sampled.clear), std::ranges::reverse(slabs);
            };
            slabs.resize(sampled.at.size());
            turn();
            reach_end(sampled, slabs);
            turn();
        }
    }

    [[nodiscard]] static double part(std::size_t i, std::size_t of) {
        return static_cast<double>(i) / static_cast<double>(of);
    }
    // Interpolates from the radius of the last clear point to the radius at a node, never below the former. A thin
    // vessel keeps its own radius for most of the way, because the volume around it belongs to the thicker vessel.
    [[nodiscard]] static double toward_node(double clear, double node, double part) {
        return node > clear ? glm::mix(node, clear, std::pow(1.0 - part, clear / node)) : clear;
    }

    void measure_radii(SampledLine& sampled, const std::vector<Slab>& slabs, const VoxelGraph::Line& line) const {
        std::vector<double> radii(sampled.at.size(), 0.0);
        std::vector<std::size_t> known;
        for (std::size_t i = 0; i < sampled.at.size(); ++i) {
            if (sampled.clear[i] == 0) continue;
            const Slab sum = clear_sum(sampled, slabs, i, std::max(2.0 * voxel_, kSmoothAreas * sampled.radius[i]));
            if (sum.volume <= 0.0) continue;
            radii[i] = radius_of(sum, direction(sampled, i), voxel_ / std::sqrt(3.0));
            known.push_back(i);
        }
        if (known.empty()) return; // keeps the radii of the balls
        const std::size_t first = known.front(), last = known.back();
        const auto ball = [&](int node, double radius) { return is_end(node) ? 0.0 : kNode * radius; };
        for (std::size_t i = 0; i < first; ++i)
            radii[i] = toward_node(radii[first], ball(line.from, sampled.radius.front()), part(first - i, first));
        for (std::size_t i = last + 1; i <= sampled.last(); ++i)
            radii[i] =
                toward_node(radii[last], ball(line.to, sampled.radius.back()), part(i - last, sampled.last() - last));
        std::size_t before = first;
        for (const std::size_t i : known) {
            for (std::size_t j = before + 1; j < i; ++j)
                radii[j] = glm::mix(radii[before], radii[i], part(j - before, i - before));
            before = i;
        }
        for (std::size_t i = 0; i < sampled.at.size(); ++i)
            sampled.radius[i] = std::max(radii[i], 0.8 * sampled.radius[i]);
    }

    // Replaces the points after the last clear point by one end point straight ahead. Its distance follows from the
    // volume there, as of a tube, or as of a cone if the volume extends farther than a tube.
    void reach_end(SampledLine& sampled, const std::vector<Slab>& slabs) const {
        const std::size_t last = sampled.last();
        std::size_t base = last;
        while (base > 0 && sampled.clear[base] == 0) --base;
        if (base == 0) base = last / 2;
        const glm::dvec3 onward = direction_behind(sampled, base);
        double volume = 0.5 * slabs[base].volume, first = 0.25 * sampled.step * volume, second = 0.0;
        for (std::size_t i = base + 1; i <= last; ++i) {
            const Slab& slab = slabs[i];
            const double away = glm::dot(sampled.at[i] - sampled.at[base], onward),
                         moment = glm::dot(slab.moment, onward);
            volume += slab.volume;
            first += moment + away * slab.volume;
            second += glm::dot(onward, slab.second * onward) + 2.0 * away * moment + away * away * slab.volume;
        }
        const double radius = sampled.radius[base], area = std::numbers::pi * radius * radius;
        double length = volume / area, end_radius = radius;
        if (volume > 0.0) { // a tube has a uniform density: mean and deviation give its extent
            const double middle = first / volume;
            const double extent = middle + std::sqrt(3.0 * std::max(second / volume - middle * middle, 0.0));
            if (extent > kLonger * length) {
                length = extent;
                // The volume of a truncated cone with radii r and e is pi/3 L (r^2 + r e + e^2).
                const double inner = 12.0 * volume / (std::numbers::pi * length) - 3.0 * radius * radius;
                end_radius = std::clamp(0.5 * (std::sqrt(std::max(inner, 0.0)) - radius), 0.3 * radius, radius);
            }
        }
        const double reach = std::clamp(length - kBeyondEnd * end_radius, 0.5 * sampled.step, 5.0 * radius);
        sampled.at.resize(base + 2), sampled.radius.resize(base + 2), sampled.clear.resize(base + 2);
        sampled.at[base + 1] = sampled.at[base] + reach * onward;
        sampled.radius[base + 1] = end_radius;
    }
    [[nodiscard]] glm::dvec3 direction_behind(const SampledLine& sampled, std::size_t base) const {
        const auto away = std::max<std::size_t>(
            1, static_cast<std::size_t>(std::lround(std::max(largest_, sampled.radius[base]) / sampled.step)));
        return unit(sampled.at[base] - sampled.at[base > away ? base - away : 0]);
    }

    const VoxelGraph& graph_;
    const VoxelSet& set_;
    const BranchVoxels& branch_voxels_;
    std::vector<int> degrees_;
    std::vector<SampledLine> sampled_lines_;
    double voxel_, largest_;
};
// A vessel needs two points.
void add_lone_voxel(tree::Graph& graph, const MidPoint& node, const glm::dvec3& spacing) {
    const int axis = spacing.x >= spacing.y && spacing.x >= spacing.z ? 0 : spacing.y >= spacing.z ? 1 : 2;
    const double radius = std::cbrt(0.75 / std::numbers::pi * spacing.x * spacing.y * spacing.z);
    glm::dvec3 offset(0.0);
    offset[axis] = 0.25 * spacing[axis];
    const auto first = static_cast<std::uint32_t>(graph.points.size());
    graph.points.push_back({node.position - offset, radius});
    graph.points.push_back({node.position + offset, radius});
    graph.edges.emplace_back(first, first + 1);
}

// Adds the points of a sampled line to the graph, about one for each half radius.
void add_sampled_line(tree::Graph& graph, const SampledLine& sampled, std::uint32_t from, std::uint32_t to) {
    std::uint32_t before = from;
    double gone = 0.0;
    const std::size_t last = sampled.at.size() - 1, middle = last / 2;
    for (std::size_t i = 1; i < last; ++i) {
        gone += glm::distance(sampled.at[i], sampled.at[i - 1]);
        if (gone < 0.5 * sampled.radius[i] && i != middle &&
            !(from == to && i % std::max<std::size_t>(1, last / 4) == 0))
            continue;
        gone = 0.0;
        graph.points.push_back({sampled.at[i], sampled.radius[i]});
        const auto next = static_cast<std::uint32_t>(graph.points.size()) - 1;
        graph.edges.emplace_back(before, next);
        before = next;
    }
    graph.edges.emplace_back(before, to);
}

} // namespace

tree::Graph centerlines_of(const VoxelGraph& graph, const VoxelSet& set, const BranchVoxels& branch_voxels,
                           const JobRange& job) {
    Tracer tracer(graph, set, branch_voxels);
    tracer.run(job);
    tree::Graph result;
    if (job.cancelled()) return result;
    for (const MidPoint& node : graph.nodes) result.points.push_back({node.position, 0.0});
    const auto widen = [&](int node, const glm::dvec3& at, double radius) {
        tree::Point& point = result.points[static_cast<std::size_t>(node)];
        point.radius = std::max(point.radius, radius);
        point.position = at;
    };
    for (std::size_t l = 0; l < graph.lines.size(); ++l) {
        const VoxelGraph::Line& line = graph.lines[l];
        const SampledLine& sampled = tracer.sampled_lines()[l];
        widen(line.from, sampled.at.front(), sampled.radius.front());
        widen(line.to, sampled.at.back(), sampled.radius.back());
        add_sampled_line(result, sampled, static_cast<std::uint32_t>(line.from), static_cast<std::uint32_t>(line.to));
    }
    for (std::size_t n = 0; n < graph.nodes.size(); ++n)
        if (tracer.degree(n) == 0) add_lone_voxel(result, graph.nodes[n], set.spacing());
    return result;
}

} // namespace ramus::volume
