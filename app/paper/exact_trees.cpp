#include "app/paper/exact_trees.h"

#include "core/tree/build_tree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <limits>
#include <numbers>
#include <utility>

namespace ramus::app::paper {

namespace {

// Points and edges, until they become a tree.
struct Skeleton {
    std::vector<tree::Point> points;
    std::vector<tree::Edge> edges;
    std::vector<std::uint32_t> roots;

    std::uint32_t begin(const tree::Point& point) {
        roots.push_back(static_cast<std::uint32_t>(points.size()));
        points.push_back(point);
        return roots.back();
    }
    std::uint32_t go_on(std::uint32_t from, const tree::Point& point) {
        const auto added = static_cast<std::uint32_t>(points.size());
        points.push_back(point);
        edges.emplace_back(from, added);
        return added;
    }
    // The whole line, from a root of its own.
    void add_line(const std::vector<tree::Point>& line) {
        std::uint32_t last = begin(line.front());
        for (std::size_t i = 1; i < line.size(); ++i) last = go_on(last, line[i]);
    }
    [[nodiscard]] tree::VesselTree tree() const { return tree::assemble(points, {}, edges, roots); }
};

constexpr double kWindingLength = 52.0; // mm along x

glm::dvec3 winding(double along) {
    const double turn = 2.0 * std::numbers::pi * along / 40.0;
    return {along, 3.0 * std::cos(turn), 7.0 * std::sin(turn) + 0.12 * along};
}

double winding_radius(double along) { return 2.4 - 0.9 * along / kWindingLength; }

using Curve = std::function<glm::dvec3(double)>;

// The voxels of 1 mm that a curve runs through, each adjacent to the one before, none that could be left out.
std::vector<glm::dvec3> voxels_along(const Curve& curve, double length) {
    constexpr double kStep = 0.01; // mm: no voxel is skipped
    const auto adjacent = [](const glm::dvec3& a, const glm::dvec3& b) {
        const glm::dvec3 off = glm::abs(a - b);
        return std::max({off.x, off.y, off.z}) < 1.5;
    };
    std::vector<glm::dvec3> path;
    for (double along = 0.0; along <= length; along += kStep) {
        const glm::dvec3 voxel = glm::floor(curve(along) + 0.5);
        if (!path.empty() && path.back() == voxel) continue;
        if (path.size() > 1 && adjacent(path[path.size() - 2], voxel)) path.pop_back();
        path.push_back(voxel);
    }
    return path;
}

tree::VesselTree of_voxels(const Skeleton& skeleton) {
    tree::VesselTree tree = skeleton.tree();
    tree.voxels = tree::Voxels{glm::dmat3(1.0), false};
    return tree;
}

} // namespace

tree::VesselTree star(std::span<const double> degrees, double radius_mm, double length_mm) {
    Skeleton skeleton;
    const auto end = [&](double angle) {
        const double turn = glm::radians(angle);
        // The viewer stands in front: the patient's right, +x, is at the left of the picture.
        return tree::Point{length_mm * glm::dvec3(-std::cos(turn), 0.0, std::sin(turn)), radius_mm};
    };
    const std::uint32_t joint = skeleton.go_on(skeleton.begin(end(degrees.front())), {glm::dvec3(0.0), radius_mm});
    for (const double angle : degrees.subspan(1)) skeleton.go_on(joint, end(angle));
    return skeleton.tree();
}

tree::VesselTree parallel_pair(double distance_mm, double radius_mm, double length_mm) {
    Skeleton skeleton;
    for (const double side : {-0.5, 0.5}) {
        const double x = side * distance_mm;
        skeleton.add_line({{{x, 0.0, -0.5 * length_mm}, radius_mm}, {{x, 0.0, 0.5 * length_mm}, radius_mm}});
    }
    return skeleton.tree();
}

// Two half circles, one below the other, as the letter; the vessels run on both sides of it.
tree::VesselTree s_shaped_pair(double distance_mm, double radius_mm) {
    constexpr double kBend = 8.0; // mm
    constexpr int kSteps = 64;    // of a half circle
    Skeleton skeleton;
    for (const double side : {-0.5, 0.5}) {
        std::vector<tree::Point> line;
        for (int step = 0; step <= 2 * kSteps; ++step) {
            const double below = step > kSteps ? -1.0 : 1.0;
            const double turn = std::numbers::pi * (step > kSteps ? step - kSteps : step) / kSteps;
            const double bend = kBend + below * side * distance_mm;
            line.push_back({{below * bend * std::sin(turn), 0.0, below * kBend + bend * std::cos(turn)}, radius_mm});
        }
        skeleton.add_line(line);
    }
    return skeleton.tree();
}

tree::VesselTree aslant_branching(double radius_mm) {
    Skeleton skeleton;
    const std::uint32_t bend =
        skeleton.go_on(skeleton.begin({{14.0, 0.0, -9.0}, radius_mm}), {{3.0, 0.0, -1.0}, radius_mm});
    skeleton.go_on(bend, {{-2.0, 0.0, 12.0}, radius_mm});
    skeleton.go_on(bend, {{-13.0, 0.0, -6.0}, radius_mm});
    return skeleton.tree();
}

tree::VesselTree winding_vessel() {
    constexpr int kSteps = 208;
    std::vector<tree::Point> line;
    for (int step = 0; step <= kSteps; ++step) {
        const double along = kWindingLength * step / kSteps;
        line.push_back({winding(along), winding_radius(along)});
    }
    Skeleton skeleton;
    skeleton.add_line(line);
    return skeleton.tree();
}

tree::VesselTree winding_vessel_of_voxels() {
    std::vector<tree::Point> line;
    for (const glm::dvec3& voxel : voxels_along(winding, kWindingLength))
        line.push_back({voxel, 0.5 * std::round(2.0 * winding_radius(voxel.x))});
    Skeleton skeleton;
    skeleton.add_line(line);
    return of_voxels(skeleton);
}

std::vector<double> distances_to_winding_vessel(const tree::VesselTree& tree) {
    constexpr double kStep = 0.01;
    std::vector<double> distances;
    for (const tree::Point& point : tree.points) {
        double nearest = std::numeric_limits<double>::infinity();
        for (double along = 0.0; along <= kWindingLength; along += kStep)
            nearest = std::min(nearest, glm::distance(point.position, winding(along)));
        distances.push_back(nearest);
    }
    return distances;
}

SpurredVessel spurred_vessel() {
    constexpr double kRadius = 2.0, kLength = 60.0;
    constexpr int kSpurVoxels = 3;
    const std::vector<glm::dvec3> trunk = voxels_along(
        [](double along) {
            return glm::dvec3(30.0 - along, 0.0, 4.0 * std::sin(2.0 * std::numbers::pi * along / 55.0));
        },
        kLength);
    SpurredVessel made;
    Skeleton skeleton;
    std::uint32_t last = skeleton.begin({trunk.front(), kRadius});
    const std::array<std::pair<std::size_t, double>, 4> spurs{{{10, 1.0}, {19, -1.0}, {41, 1.0}, {50, -1.0}}};
    constexpr std::size_t kFork = 30;
    for (std::size_t i = 1; i < trunk.size(); ++i) {
        last = skeleton.go_on(last, {trunk[i], kRadius});
        for (const auto& [place, side] : spurs) {
            if (place != i) continue;
            std::uint32_t tip = last;
            for (int step = 1; step <= kSpurVoxels; ++step)
                tip = skeleton.go_on(tip, {trunk[i] + glm::dvec3(0.0, 0.0, side * step), kRadius - 0.4 * step});
            ++made.spurs;
        }
        if (i != kFork) continue;
        const auto side_branch =
            voxels_along([&](double along) { return trunk[i] + glm::dvec3(-0.62 * along, 0.0, 0.78 * along); }, 24.0);
        std::uint32_t tip = last;
        for (std::size_t n = 1; n < side_branch.size(); ++n) tip = skeleton.go_on(tip, {side_branch[n], 0.8 * kRadius});
    }
    made.tree = of_voxels(skeleton);
    made.real_branches = 3;
    return made;
}

} // namespace ramus::app::paper
