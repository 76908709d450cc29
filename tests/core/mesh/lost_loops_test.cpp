// Loops of a tree that its field has no hole for: opened.
#include "core/measure/mesh_distance.h"
#include "core/mesh/connectivity.h"
#include "core/mesh/loops/open_lost_loops.h"
#include "core/mesh/loops/tree_cycles.h"
#include "core/mesh/surface.h"
#include "tests/support/built_tree.h"
#include "tests/support/mesh_intersections.h"
#include "tests/support/mesh_topology.h"

#include <cmath>
#include <doctest/doctest.h>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <numbers>
#include <vector>

namespace ramus::mesh {

namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

// Vessels of 1 mm radius: a ring in the plane z = 0, with a vessel outward on both sides.
tree::VesselTree ring(double radius) {
    constexpr std::uint32_t kCorners = 24;
    std::vector<tree::Point> points;
    std::vector<tree::Edge> edges;
    for (std::uint32_t n = 0; n < kCorners; ++n) {
        const double angle = kTurn * n / kCorners;
        points.push_back({{radius * std::cos(angle), radius * std::sin(angle), 0.0}, 1.0});
        edges.push_back({n, (n + 1) % kCorners});
    }
    for (const double side : {1.0, -1.0}) {
        points.push_back({{side * (radius + 8.0), 0.0, 0.0}, 1.0});
        edges.push_back({static_cast<std::uint32_t>(points.size() - 1), side > 0.0 ? 0U : kCorners / 2});
    }
    return test::built_tree(std::move(points), std::move(edges), {kCorners});
}

// A vessel of 1 mm radius that splits in two, which are at most so far apart and meet again 12 mm on.
tree::VesselTree split(double apart) {
    constexpr std::uint32_t kSteps = 20;
    std::vector<tree::Point> points{
        {{-14.0, 0.0, 0.0}, 1.0}, {{-6.0, 0.0, 0.0}, 1.0}, {{6.0, 0.0, 0.0}, 1.0}, {{14.0, 0.0, 0.0}, 1.0}};
    std::vector<tree::Edge> edges{{0, 1}, {2, 3}};
    for (const double side : {0.5, -0.5}) {
        std::uint32_t before = 1;
        for (std::uint32_t n = 1; n < kSteps; ++n) {
            const double share = static_cast<double>(n) / kSteps;
            points.push_back({{12.0 * share - 6.0, side * apart * std::sin(0.5 * kTurn * share), 0.0}, 1.0});
            edges.push_back({before, static_cast<std::uint32_t>(points.size() - 1)});
            before = edges.back().second;
        }
        edges.push_back({before, 2});
    }
    return test::built_tree(std::move(points), std::move(edges));
}

Surface surface_of(const tree::VesselTree& tree, int detail) {
    SurfaceOptions options;
    options.detail = detail;
    Job job;
    auto surface = make_untangled_surface(tree, options, job);
    REQUIRE(surface);
    return std::move(*surface);
}

// `hole`: half of the size of what is between the centerlines of its cycle, mm.
void check_loop(const tree::VesselTree& tree, const glm::dvec2& hole, int detail, std::size_t opened) {
    CAPTURE(detail);
    const Surface surface = surface_of(tree, detail);
    CHECK(connectivity_of(surface.mesh) == Connectivity{1, 1});
    CHECK(surface.statistics.matched.lost_loops.opened == opened);
    CHECK(surface.statistics.matched.lost_loops.closed.empty());
    CHECK(test::topology(surface.mesh).open_edges == 0);
    CHECK(test::intersecting_triangles(surface.mesh).empty());
    // There is a way through the plane of the cycle, between its centerlines.
    const measure::MeshDistance solid(surface.mesh);
    bool open = false;
    constexpr int kPlaces = 120;
    for (int i = -kPlaces; i <= kPlaces && !open; ++i)
        for (int k = -kPlaces; k <= kPlaces && !open; ++k)
            open = !solid.inside({hole.x * i / kPlaces, hole.y * k / kPlaces, 0.0});
    CHECK(open);
}

} // namespace

TEST_CASE("a ring that is nearly as thick as wide, or thicker, keeps its loop" * doctest::test_suite("slow")) {
    for (const double radius : {0.5, 0.9, 1.0, 1.05, 1.2})
        for (const int detail : {8, 16, 24}) check_loop(ring(radius), glm::dvec2(0.7 * radius), detail, 1);
    for (const int detail : {8, 16, 24}) check_loop(ring(1.5), glm::dvec2(1.0), detail, 0); // the field has this hole
}

TEST_CASE("vessels that part and meet again keep their loop, however close they are" * doctest::test_suite("slow")) {
    for (const double apart : {0.4, 1.0, 2.0, 2.2})
        for (const int detail : {8, 16, 24}) check_loop(split(apart), {5.0, 0.25 * apart}, detail, 1);
    for (const int detail : {8, 16, 24}) check_loop(split(3.0), {5.0, 0.75}, detail, 0);
}

TEST_CASE("a lost loop is said where nothing can be opened, and left where the paper's sum is asked for") {
    Surface surface = surface_of(ring(1.5), 8);
    const tree::VesselTree twice = [] {
        tree::VesselTree tree = ring(1.5);
        // The tree of a surface that lacks a loop altogether: a second cycle, far from the surface.
        tree::VesselTree other = tree;
        const auto first = static_cast<std::uint32_t>(tree.points.size());
        for (tree::Point point : other.points) point.position.z += 100.0, tree.points.push_back(point);
        for (tree::Branch branch : other.branches) {
            for (std::uint32_t& point : branch.points) point += first;
            tree.branches.push_back(branch);
        }
        return tree;
    }();
    Job job;
    const std::size_t triangles = surface.mesh.triangles.size();
    CHECK(open_lost_loops(surface.mesh, twice, 0, 1e9, job).opened == 0);
    CHECK(surface.mesh.triangles.size() == triangles);

    SurfaceOptions paper;
    paper.blend = Blend::kPaper;
    auto plain = make_surface(ring(1.0), paper, job);
    REQUIRE(plain);
    CHECK(connectivity_of(plain->mesh) == Connectivity{1, 0});
}

TEST_CASE("short cycles: one for each loop, around the smallest meshes of a net") {
    // A net of 3 x 3 squares of 1 mm.
    constexpr std::uint32_t kSide = 4;
    std::vector<tree::Point> points;
    std::vector<tree::Edge> edges;
    for (std::uint32_t y = 0; y < kSide; ++y)
        for (std::uint32_t x = 0; x < kSide; ++x) {
            points.push_back({{static_cast<double>(x), static_cast<double>(y), 0.0}, 0.1});
            if (x > 0) edges.push_back({y * kSide + x - 1, y * kSide + x});
            if (y > 0) edges.push_back({(y - 1) * kSide + x, y * kSide + x});
        }
    const tree::VesselTree net = test::built_tree(std::move(points), std::move(edges));
    const auto cycles = short_cycles(net);
    CHECK(cycles.size() == 9);
    for (const auto& cycle : cycles)
        for (std::size_t n = 0; n < cycle.size(); ++n)
            CHECK(glm::distance(cycle[n].position, cycle[(n + 1) % cycle.size()].position) == doctest::Approx(1.0));
    const auto around = short_cycles(ring(1.0));
    REQUIRE(around.size() == 1);
    CHECK(around[0].size() == 24);
}

} // namespace ramus::mesh
