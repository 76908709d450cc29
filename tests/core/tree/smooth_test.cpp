// Smoothing by arc length, against the paper's filter, the second derivative of a circle, and its limits.
#include "core/tree/build_tree.h"
#include "core/tree/smooth.h"
#include "core/tree/voxels.h"
#include "tests/support/built_tree.h"

#include <cmath>
#include <doctest/doctest.h>
#include <glm/geometric.hpp>
#include <numbers>
#include <random>
#include <vector>

using namespace ramus;
using tree::Point;
using tree::VesselTree;

namespace {

tree::Voxels box(double x, double y, double z) {
    return {glm::dmat3(glm::dvec3(x, 0, 0), glm::dvec3(0, y, 0), glm::dvec3(0, 0, z)), false};
}

VesselTree run_of(std::vector<Point> points, std::optional<tree::Voxels> voxels) {
    std::vector<tree::Edge> edges;
    for (std::uint32_t i = 1; i < points.size(); ++i) edges.emplace_back(i - 1, i);
    VesselTree tree = tree::assemble(std::move(points), {}, edges, {0});
    tree.voxels = voxels;
    return tree;
}

// From voxel to adjacent voxel along the edges of voxels, which are `size` long, in no regular order.
std::vector<Point> stairs(std::size_t count, const glm::dvec3& size, unsigned seed) {
    std::mt19937 random(seed);
    std::vector<Point> points;
    glm::dvec3 at(0.0);
    for (std::size_t i = 0; i < count; ++i) {
        points.push_back({at, 4.0 + 0.05 * static_cast<double>(random() % 10)});
        const int axis = static_cast<int>(random() % 3);
        at[axis] += size[axis];
    }
    return points;
}

// The paper's filter.
std::vector<Point> binomial(std::vector<Point> points) {
    const std::vector<Point> before = points;
    for (std::size_t i = 1; i + 1 < points.size(); ++i) {
        points[i].position = 0.25 * (before[i - 1].position + 2.0 * before[i].position + before[i + 1].position);
        points[i].radius = 0.25 * (before[i - 1].radius + 2.0 * before[i].radius + before[i + 1].radius);
    }
    return points;
}

} // namespace

TEST_CASE("where points are a voxel apart smoothing is the paper's filter, voxels of any proportions") {
    for (const glm::dvec3 size : {glm::dvec3(1.0), glm::dvec3(0.7), glm::dvec3(0.8, 0.8, 2.5)}) {
        std::vector<Point> wanted = stairs(200, size, 3);
        const VesselTree tree = run_of(wanted, box(size.x, size.y, size.z));
        // A second pass has steps that are no voxels any more.
        const VesselTree smooth = tree::smooth(tree, 1);
        wanted = binomial(wanted);
        for (std::size_t i = 0; i < wanted.size(); ++i) {
            CHECK(glm::distance(smooth.points[i].position, wanted[i].position) < 1e-12);
            CHECK(smooth.points[i].radius == doctest::Approx(wanted[i].radius).epsilon(1e-12));
        }
        CHECK(smooth.branches == tree.branches);
    }
}

TEST_CASE("a branching node a voxel from its neighbours leans to the thick ones") {
    std::vector<Point> points{{{0, 0, -1}, 4.0}, {{0, 0, 0}, 3.0}, {{1, 0, 0}, 2.0}, {{0, 1, 0}, 2.0}};
    VesselTree tree = tree::assemble(std::move(points), {}, {{0, 1}, {1, 2}, {1, 3}}, {0});
    tree.voxels = box(1.0, 1.0, 1.0);
    // sum r x / sum r = (4 (0,0,-1) + 2 (1,0,0) + 2 (0,1,0)) / 8 = (1, 1, -2) / 4; sum r r / sum r = 24 / 8 = 3
    const VesselTree smooth = tree::smooth(tree, 1);
    CHECK(glm::distance(smooth.points[1].position, glm::dvec3(0.125, 0.125, -0.25)) < 1e-12);
    CHECK(smooth.points[1].radius == doctest::Approx(3.0));
    for (const std::size_t end : {0, 2, 3}) CHECK(smooth.points[end] == tree.points[end]);
}

// The second derivative of a circle of radius R by its length is 1 / R, toward its middle. The chord of points that are
// h apart makes that (1 - cos(h / R)) R / (2 sin^2(h / 2R) R^2) = 1 / R as well, to within (h / R)^2.
TEST_CASE("a point of a circle moves by h^2 / 4R, however far apart the points are") {
    constexpr double kRadius = 50.0;
    for (const double apart : {0.2, 0.5, 1.0, 2.0, 5.0}) {
        CAPTURE(apart);
        std::vector<Point> points;
        for (double along = -0.4 * kRadius; along < 0.4 * kRadius; along += apart) // along y in the middle
            points.push_back({{kRadius * std::cos(along / kRadius), kRadius * std::sin(along / kRadius), 0}, 2.0});
        const VesselTree tree = run_of(points, box(1.0, 1.0, 1.0));
        const VesselTree smooth = tree::smooth(tree, 1);
        const auto middle = points.size() / 2;
        const double moved = kRadius - glm::length(smooth.points[middle].position);
        CHECK(moved == doctest::Approx(1.0 / (4.0 * kRadius)).epsilon(0.03));
        CHECK(glm::distance(smooth.points[middle].position, points[middle].position) == doctest::Approx(moved));
    }
}

TEST_CASE("no point moves by more than half a voxel or half of its radius, whatever the passes") {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> any(-1.0, 1.0), radius(0.05, 3.0);
    for (const int passes : {1, 3, 100}) {
        std::vector<Point> points;
        glm::dvec3 at(0.0);
        for (int i = 0; i < 400; ++i) {
            points.push_back({at, radius(random)});
            at += glm::dvec3(any(random), any(random), any(random)) * (i % 50 == 0 ? 40.0 : 1.5);
        }
        const VesselTree tree = run_of(points, box(0.8, 0.8, 2.0));
        const VesselTree smooth = tree::smooth(tree, passes);
        const glm::dvec3 size = tree::sizes_mm(*tree.voxels);
        double farthest = 0.0;
        for (std::size_t i = 0; i < points.size(); ++i) {
            const glm::dvec3 way = smooth.points[i].position - points[i].position;
            CHECK(glm::length(way / size) <= 0.5 + 1e-9);
            CHECK(glm::length(way) <= 0.5 * points[i].radius + 1e-9);
            CHECK(std::abs(smooth.points[i].radius - points[i].radius) <= 0.5 * points[i].radius + 1e-9);
            CHECK(smooth.points[i].radius > 0.0);
            farthest = std::max(farthest, glm::length(way));
        }
        const tree::Displacement moved = tree::displacement_of(tree, smooth);
        CHECK(moved.largest_mm == farthest);
        CHECK(moved.largest_radii <= 0.5 + 1e-9);
        CHECK(moved.median_mm > 0.0);
    }
}

TEST_CASE("a tree without voxels stays as it is") {
    const VesselTree tree = run_of(stairs(50, glm::dvec3(1.0), 7), std::nullopt);
    CHECK(tree::smooth(tree, 5) == tree);
    CHECK(tree::displacement_of(tree, tree).largest_mm == 0.0);
}

TEST_CASE("a voxel as large as a file may claim takes no longer") {
    std::vector<Point> points;
    for (int i = 0; i < 200000; ++i) points.push_back({{1e-3 * i, 1e-3 * (i % 2), 0}, 1.0});
    const VesselTree tree = run_of(std::move(points), box(1e9, 1e9, 1e9));
    CHECK(tree::smooth(tree, 1).points.size() == tree.points.size());
}

TEST_CASE("voxels are estimated where centerlines go from voxel to voxel, and nowhere else") {
    const auto estimated = [](std::vector<Point> points) {
        return tree::estimated_voxels(run_of(std::move(points), std::nullopt));
    };
    const auto found = estimated(stairs(100, {0.7, 0.7, 1.5}, 2));
    REQUIRE(found);
    CHECK(found->estimated);
    CHECK(glm::distance(tree::sizes_mm(*found), glm::dvec3(0.7, 0.7, 1.5)) < 1e-12);
    CHECK(tree::mean_size_mm(*found) == doctest::Approx(std::cbrt(0.7 * 0.7 * 1.5)));

    std::vector<Point> rounded = stairs(100, {0.7812, 0.7812, 0.7}, 2); // as files have them
    for (Point& point : rounded) point.position = glm::round(point.position * 1e2) / 1e2;
    CHECK(estimated(rounded));

    std::vector<Point> flat = stairs(100, {1, 1, 1}, 2);
    for (Point& point : flat) point.position.z = 0.0;
    std::erase_if(
        flat, [&](const Point& point) { return &point != flat.data() && point.position == (&point - 1)->position; });
    CHECK(estimated(flat));

    std::vector<Point> straight, sparse, between = stairs(100, {1, 1, 1}, 2), thin = stairs(100, {1, 1, 1}, 2);
    for (int i = 0; i < 100; ++i) straight.push_back({{0.0, 0.0, 1.0 * i}, 1.0});
    std::mt19937 random(5);
    glm::ivec3 at(0); // on a grid, but many of its steps apart
    for (int i = 0; i < 100; ++i) {
        sparse.push_back({glm::dvec3(at), 1.0});
        at += glm::ivec3(random() % 9, random() % 9, random() % 9);
    }
    std::uniform_real_distribution<double> any(-0.4, 0.4);
    for (Point& point : between) point.position += glm::dvec3(any(random), any(random), any(random));
    for (Point& point : thin) point.radius *= 0.05; // no vessel is so much thinner than its voxels
    for (const std::vector<Point>& points : {straight, sparse, between, thin, stairs(12, {1, 1, 1}, 2)})
        CHECK_FALSE(estimated(points));
}
