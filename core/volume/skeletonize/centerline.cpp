#include "core/volume/skeletonize/centerline.h"

#include "core/base/bounds.h"
#include "core/volume/skeletonize/course.h"

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

// A tube of the volume of an end ends this part of the radius beyond the last point that stands for it. The surface of
// a tree ends 0.707 radii beyond it (the paper's kernel: half a line's sum), as a dome that holds as much as 0.277
// radii of the tube. Between the two the surface is nearest to ends that are flat and to those that are round.
constexpr double kBeyondEnd = 0.66;
// Tuned on grown trees and masks of patients: how far positions, their corrections and areas are smoothed along a
// vessel, in its radii.
constexpr double kSmoothPositions = 1.0, kSmoothShifts = 0.6, kSmoothAreas = 0.25;
constexpr double kFlat = 1.255; // see radius_of()
// Where vessels meet, the wall is farther out than the ball between them reaches.
constexpr double kNode = 1.165;
// How near an end nothing is clear, in radii of the largest ball there; which balls count: those that come within so
// many of their radii.
constexpr double kEnd = 0.75, kReach = 1.2;
// An end that reaches so much farther than a tube of its volume is that of a cone.
constexpr double kLonger = 1.15;
constexpr int kCentrings = 2;

// The ellipse with the second moments of the middles of a cross-section's voxels; no half axis is less than `least`,
// which is that of a single voxel.
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

// Of the circle with the area of the cross-section. Where that is flat, as where the picture's border cuts a vessel or
// several run side by side, the circle would stand out of the mask; then it is one with `kFlat` times the width of the
// ellipse with the same second moments.
double radius_of(const Slab& slab, const glm::dvec3& along, double least) {
    const Ellipse ellipse = ellipse_of(slab, along, least);
    return std::sqrt(slab.volume / slab.length / std::numbers::pi) *
           std::min(1.0, kFlat * std::sqrt(ellipse.shorter / std::max(ellipse.longer, 1e-12)));
}

class Tracer {
public:
    Tracer(const VoxelGraph& graph, const VoxelSet& set, const BranchVoxels& branch_voxels)
        : graph_(graph), set_(set), branch_voxels_(branch_voxels), degrees_(graph.degrees()),
          courses_(graph.lines.size()) {
        const glm::dvec3& s = set.spacing();
        voxel_ = std::cbrt(s.x * s.y * s.z);
        largest_ = std::max({s.x, s.y, s.z});
    }

    // Stops early when `job` is cancelled.
    void run(const JobRange& job) {
        const auto for_lines = [&](int step, const auto& call) {
            std::atomic<std::size_t> done = 0;
            tbb::parallel_for(std::size_t{0}, courses_.size(), [&](std::size_t l) {
                if (job.cancelled()) return;
                call(l);
                job.report(
                    (static_cast<float>(step) + static_cast<float>(++done) / static_cast<float>(courses_.size())) /
                    (kCentrings + 1.0F));
            });
        };
        for (int n = 0; n < kCentrings; ++n) {
            for_lines(n, [&](std::size_t l) {
                if (n == 0) begin(l);
                const std::vector<Slab> slabs = slabs_of(courses_[l], branch_voxels_.of(l), set_);
                shift(l, shifts_to_centroids(courses_[l], slabs));
            });
        }
        for_lines(kCentrings, [&](std::size_t l) { finish(l); });
    }
    [[nodiscard]] const std::vector<Course>& courses() const { return courses_; }
    [[nodiscard]] bool is_end(int n) const { return degrees_[static_cast<std::size_t>(n)] == 1; }
    [[nodiscard]] int degree(std::size_t n) const { return degrees_[n]; }

private:
    [[nodiscard]] const MidPoint& node(int n) const { return graph_.nodes[static_cast<std::size_t>(n)]; }

    void begin(std::size_t l) {
        Course& course = courses_[l];
        course = resampled(graph_, graph_.lines[l], voxel_);
        smooth_positions(course,
                         [&](std::size_t i) { return std::max(largest_, kSmoothPositions * course.radius[i]); });
        mark_clear(course, graph_.lines[l]);
    }

    // How far around a node of a line nothing is clear: at a node of several lines the ball there; at an end, to which
    // the way may be askew, part of the largest ball of this vessel that reaches there.
    [[nodiscard]] double unclear_around(int node_number, int other, const Course& course) const {
        const MidPoint& here = node(node_number);
        if (!is_end(node_number)) return here.distance;
        double ball = 0.0;
        for (std::size_t i = 0; i < course.at.size(); ++i) {
            const bool of_other =
                !is_end(other) && glm::distance(course.at[i], node(other).position) < node(other).distance;
            if (!of_other && glm::distance(course.at[i], here.position) < kReach * course.radius[i])
                ball = std::max(ball, course.radius[i]);
        }
        return kEnd * ball;
    }

    // Where a line is so short that nothing is clear, closer to its nodes has to do.
    void mark_clear(Course& course, const VoxelGraph::Line& line) const {
        const bool leaf = is_end(line.from) || is_end(line.to);
        const std::array<std::pair<glm::dvec3, double>, 2> around = {
            std::pair(node(line.from).position, unclear_around(line.from, line.to, course)),
            std::pair(node(line.to).position, unclear_around(line.to, line.from, course))};
        for (const double part : {1.0, 0.5, 0.25}) {
            if (part < 1.0 && !leaf) return;
            course.clear.assign(course.at.size(), 1);
            for (const auto& [middle, reach] : around)
                for (std::size_t i = 0; i < course.at.size(); ++i)
                    if (glm::distance(course.at[i], middle) < part * reach) course.clear[i] = 0;
            course.clear.front() = course.clear.back() = 0;
            if (std::ranges::find(course.clear, 1) != course.clear.end()) return;
        }
        if (leaf) course.clear[course.last() / 2] = 1;
    }

    // What is clear around a point, `sigma` in mm.
    [[nodiscard]] static Slab clear_sum(const Course& course, const std::vector<Slab>& slabs, std::size_t i,
                                        double sigma) {
        Slab sum;
        for_weights(i, course.at.size(), sigma / course.step, [&](std::size_t j, double weight) {
            if (course.clear[j] == 0) return;
            sum.volume += weight * slabs[j].volume;
            sum.length += weight * slabs[j].length;
            sum.moment += weight * slabs[j].moment;
            sum.second += weight * slabs[j].second;
        });
        return sum;
    }

    // At right angles to the course; 0 where it is not clear.
    [[nodiscard]] std::vector<glm::dvec3> shifts_to_centroids(const Course& course,
                                                              const std::vector<Slab>& slabs) const {
        std::vector<glm::dvec3> shifts(course.at.size(), glm::dvec3(0.0));
        for (std::size_t i = 0; i < course.at.size(); ++i) {
            if (course.clear[i] == 0) continue;
            const Slab sum = clear_sum(course, slabs, i, std::max(largest_, kSmoothShifts * course.radius[i]));
            if (sum.volume <= 0.0) continue;
            const glm::dvec3 along = direction(course, i), shift = sum.moment / sum.volume;
            shifts[i] = shift - glm::dot(shift, along) * along;
        }
        return shifts;
    }
    [[nodiscard]] glm::dvec3 direction(const Course& course, std::size_t i) const {
        const double reach = std::max(largest_, 0.5 * course.radius[i]);
        const auto away = std::max<std::size_t>(1, static_cast<std::size_t>(std::lround(reach / course.step)));
        return unit(course.at[std::min(i + away, course.last())] - course.at[i > away ? i - away : 0]);
    }
    [[nodiscard]] static glm::dvec3 unit(const glm::dvec3& v) { return v / std::max(glm::length(v), 1e-12); }

    [[nodiscard]] static std::size_t first_clear(const Course& course) {
        return static_cast<std::size_t>(std::ranges::find(course.clear, 1) - course.clear.begin());
    }
    [[nodiscard]] static std::size_t last_clear(const Course& course) {
        std::size_t i = course.last();
        while (course.clear[i] == 0) --i;
        return i;
    }

    // Around the voxels of a line and its course: no middle of them is outside, though one seen aslant may seem to be,
    // where voxels are many times longer than wide.
    [[nodiscard]] Bounds<glm::dvec3> room_of(std::size_t l) const {
        Bounds<glm::dvec3> room;
        for (const glm::dvec3& at : courses_[l].at) room.hold(at);
        for (const BranchVoxels::Member& member : branch_voxels_.of(l)) {
            const glm::dvec3 middle = set_.spacing() * glm::dvec3(set_.voxel(member.at));
            room.hold({middle - 0.5 * set_.spacing(), middle + 0.5 * set_.spacing()});
        }
        return room;
    }

    // What is not clear goes along with what is next to it: at an end all the way, at a node not at all.
    void shift(std::size_t l, std::vector<glm::dvec3> shifts) {
        Course& course = courses_[l];
        const VoxelGraph::Line& line = graph_.lines[l];
        const std::size_t first = first_clear(course);
        if (first == course.at.size()) return;
        const std::size_t last = last_clear(course);
        const glm::dvec3 from = is_end(line.from) ? shifts[first] : glm::dvec3(0.0);
        const glm::dvec3 to = is_end(line.to) ? shifts[last] : glm::dvec3(0.0);
        for (std::size_t i = 0; i < first; ++i) shifts[i] = glm::mix(from, shifts[first], part(i, first));
        for (std::size_t i = last + 1; i <= course.last(); ++i)
            shifts[i] = glm::mix(shifts[last], to, part(i - last, course.last() - last));
        const Bounds<glm::dvec3> room = room_of(l);
        for (std::size_t i = 0; i < course.at.size(); ++i)
            course.at[i] = glm::clamp(course.at[i] + shifts[i], room.least, room.most);
        smooth_positions(course, [&](std::size_t i) { return std::max(voxel_, kSmoothShifts * course.radius[i]); });
    }

    void finish(std::size_t l) {
        Course& course = courses_[l];
        const VoxelGraph::Line& line = graph_.lines[l];
        std::vector<Slab> slabs = slabs_of(course, branch_voxels_.of(l), set_);
        measure_radii(course, slabs, line);
        if (line.from == line.to) return;
        if (is_end(line.to)) reach_end(course, slabs);
        if (is_end(line.from)) {
            const auto turn = [&] {
                std::ranges::reverse(course.at), std::ranges::reverse(course.radius);
                std::ranges::reverse(course.clear), std::ranges::reverse(slabs);
            };
            slabs.resize(course.at.size());
            turn();
            reach_end(course, slabs);
            turn();
        }
    }

    [[nodiscard]] static double part(std::size_t i, std::size_t of) {
        return static_cast<double>(i) / static_cast<double>(of);
    }
    // From the radius of the last clear part to that of a node, never thinner on the way. A thin vessel keeps to its
    // own radius for long: what is around it there is the thicker one's.
    [[nodiscard]] static double toward_node(double clear, double node, double part) {
        return node > clear ? glm::mix(node, clear, std::pow(1.0 - part, clear / node)) : clear;
    }

    void measure_radii(Course& course, const std::vector<Slab>& slabs, const VoxelGraph::Line& line) const {
        std::vector<double> radii(course.at.size(), 0.0);
        std::vector<std::size_t> known;
        for (std::size_t i = 0; i < course.at.size(); ++i) {
            if (course.clear[i] == 0) continue;
            const Slab sum = clear_sum(course, slabs, i, std::max(2.0 * voxel_, kSmoothAreas * course.radius[i]));
            if (sum.volume <= 0.0) continue;
            radii[i] = radius_of(sum, direction(course, i), voxel_ / std::sqrt(3.0));
            known.push_back(i);
        }
        if (known.empty()) return; // the ball has to do
        const std::size_t first = known.front(), last = known.back();
        const auto ball = [&](int node, double radius) { return is_end(node) ? 0.0 : kNode * radius; };
        for (std::size_t i = 0; i < first; ++i)
            radii[i] = toward_node(radii[first], ball(line.from, course.radius.front()), part(first - i, first));
        for (std::size_t i = last + 1; i <= course.last(); ++i)
            radii[i] =
                toward_node(radii[last], ball(line.to, course.radius.back()), part(i - last, course.last() - last));
        std::size_t before = first;
        for (const std::size_t i : known) {
            for (std::size_t j = before + 1; j < i; ++j)
                radii[j] = glm::mix(radii[before], radii[i], part(j - before, i - before));
            before = i;
        }
        for (std::size_t i = 0; i < course.at.size(); ++i)
            course.radius[i] = std::max(radii[i], 0.8 * course.radius[i]);
    }

    // Straight on from the last clear point, as far as the volume there reaches: that of a tube, or, where it reaches
    // farther than a tube would, of a cone.
    void reach_end(Course& course, const std::vector<Slab>& slabs) const {
        const std::size_t last = course.last();
        std::size_t base = last;
        while (base > 0 && course.clear[base] == 0) --base;
        if (base == 0) base = last / 2;
        const glm::dvec3 onward = direction_behind(course, base);
        double volume = 0.5 * slabs[base].volume, first = 0.25 * course.step * volume, second = 0.0;
        for (std::size_t i = base + 1; i <= last; ++i) {
            const Slab& slab = slabs[i];
            const double away = glm::dot(course.at[i] - course.at[base], onward),
                         moment = glm::dot(slab.moment, onward);
            volume += slab.volume;
            first += moment + away * slab.volume;
            second += glm::dot(onward, slab.second * onward) + 2.0 * away * moment + away * away * slab.volume;
        }
        const double radius = course.radius[base], area = std::numbers::pi * radius * radius;
        double length = volume / area, end_radius = radius;
        if (volume > 0.0) { // of a tube: its middle, and the spread of a uniform density
            const double middle = first / volume;
            const double extent = middle + std::sqrt(3.0 * std::max(second / volume - middle * middle, 0.0));
            if (extent > kLonger * length) {
                length = extent;
                // pi/3 L (r^2 + r e + e^2) is the volume of a cone that goes from r to e.
                const double inner = 12.0 * volume / (std::numbers::pi * length) - 3.0 * radius * radius;
                end_radius = std::clamp(0.5 * (std::sqrt(std::max(inner, 0.0)) - radius), 0.3 * radius, radius);
            }
        }
        const double reach = std::clamp(length - kBeyondEnd * end_radius, 0.5 * course.step, 5.0 * radius);
        course.at.resize(base + 2), course.radius.resize(base + 2), course.clear.resize(base + 2);
        course.at[base + 1] = course.at[base] + reach * onward;
        course.radius[base + 1] = end_radius;
    }
    [[nodiscard]] glm::dvec3 direction_behind(const Course& course, std::size_t base) const {
        const auto away = std::max<std::size_t>(
            1, static_cast<std::size_t>(std::lround(std::max(largest_, course.radius[base]) / course.step)));
        return unit(course.at[base] - course.at[base > away ? base - away : 0]);
    }

    const VoxelGraph& graph_;
    const VoxelSet& set_;
    const BranchVoxels& branch_voxels_;
    std::vector<int> degrees_;
    std::vector<Course> courses_;
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

// Points of a course that are kept: about every half radius.
void add_course(tree::Graph& graph, const Course& course, std::uint32_t from, std::uint32_t to) {
    std::uint32_t before = from;
    double gone = 0.0;
    const std::size_t last = course.at.size() - 1, middle = last / 2;
    for (std::size_t i = 1; i < last; ++i) {
        gone += glm::distance(course.at[i], course.at[i - 1]);
        if (gone < 0.5 * course.radius[i] && i != middle &&
            !(from == to && i % std::max<std::size_t>(1, last / 4) == 0))
            continue;
        gone = 0.0;
        graph.points.push_back({course.at[i], course.radius[i]});
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
        const Course& course = tracer.courses()[l];
        widen(line.from, course.at.front(), course.radius.front());
        widen(line.to, course.at.back(), course.radius.back());
        add_course(result, course, static_cast<std::uint32_t>(line.from), static_cast<std::uint32_t>(line.to));
    }
    for (std::size_t n = 0; n < graph.nodes.size(); ++n)
        if (tracer.degree(n) == 0) add_lone_voxel(result, graph.nodes[n], set.spacing());
    return result;
}

} // namespace ramus::volume
