// Surfaces of vessels that just merge, or just do not: closed, whatever the width, the radius and the cells, and where
// vessels are kept apart in the pieces and loops of their tree.
#include "core/io/trees/tree_file.h"
#include "core/mesh/connectivity.h"
#include "core/mesh/surface.h"
#include "core/tree/build_tree.h"
#include "tests/support/built_tree.h"
#include "tests/support/merging_vessels.h"
#include "tests/support/mesh_topology.h"
#include "tests/support/packed_trees.h"
#include "tests/support/shared_data.h"
#include "tests/support/surface_shape.h"

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

namespace ramus::mesh {

namespace {

constexpr test::Shape kOneVessel{1, 0};

SurfaceOptions plain_options(double width, int detail) {
    SurfaceOptions options;
    options.smooth_passes = 0;
    options.width = width;
    options.detail = detail;
    return options;
}

void check_one_vessel(const tree::VesselTree& tree, const SurfaceOptions& options) {
    Job job;
    const auto surface = make_untangled_surface(tree, options, job);
    REQUIRE_MESSAGE(surface, (surface ? "" : surface.error().message()));
    CHECK(test::topology(surface->mesh).closed_manifold());
    if (options.blend == Blend::kTree) CHECK(test::shape_of(test::pieces_of(surface->mesh)) == kOneVessel);
}

// A vessel from the first point to the second, and its daughters from there, two points each, of another radius at
// their ends.
tree::VesselTree fork_of(const std::vector<glm::dvec3>& places, double radius, double end_radius) {
    std::vector<tree::Point> points{{places[0], radius}, {places[1], radius}};
    std::vector<tree::Edge> edges{{0, 1}};
    for (std::uint32_t n = 2; n + 1 < places.size(); n += 2) {
        points.push_back({places[n], radius});
        points.push_back({places[n + 1], end_radius});
        edges.emplace_back(1, n), edges.emplace_back(n, n + 1);
    }
    return test::built_tree(points, edges);
}

} // namespace

// Fine cells take most of the time. Away from the radius at which vessels merge they show no more than coarse cells.
TEST_CASE("a surface is closed, and in one piece without loops, near the radius at which vessels merge" *
          doctest::test_suite("slow")) {
    constexpr int kFine = 24;
    for (const test::MergingShape& shape : test::merging_shapes())
        for (const auto centerline : {tree::Centerline::kLines, tree::Centerline::kSmooth})
            for (const Blend blend : {Blend::kTree, Blend::kPaper})
                for (const double width : {1.0, 1.5, 2.0, 3.0, 5.0})
                    for (const double factor : {0.97, 0.99, 0.999, 0.9995, 1.0, 1.01})
                        for (const int detail : {6, 8, 12, 16, 20, kFine, 32, 48}) {
                            if (detail >= kFine && factor != 0.9995 && factor != 1.0) continue;
                            CAPTURE(shape.name);
                            CAPTURE(centerline);
                            CAPTURE(blend);
                            CAPTURE(width);
                            CAPTURE(factor);
                            CAPTURE(detail);
                            SurfaceOptions options = plain_options(width, detail);
                            options.centerline = centerline;
                            options.blend = blend;
                            check_one_vessel(shape.tree(factor * test::merging_radius(width)), options);
                        }
}

TEST_CASE("a wall that ends on two sides of an edge of the grid leaves no edge with four triangles") {
    check_one_vessel(fork_of({{1.22, -4.47, 4.19},
                              {-0.27, -0.37, -0.16},
                              {-0.77, 0.8, -4.44},
                              {-2.75, 7.66, -11.4},
                              {-2.8, 1.34, -2.39},
                              {-5.04, 8.58, -10.12},
                              {-1.39, 4.16, -1.62},
                              {-3.26, 10.83, -8.36},
                              {0.97, 2.64, -2.91},
                              {-1.03, 9.66, -10.18}},
                             1.67, 1.67),
                     plain_options(5.0, 14));
}

TEST_CASE("a cavity between the daughters of a fork is filled") {
    SurfaceOptions options = plain_options(7.0, 14);
    options.centerline = tree::Centerline::kLines;
    check_one_vessel(fork_of({{-3.3, -2.9, -4},
                              {0.7, 0, -0.7},
                              {4.7, 0.9, 2.3},
                              {10.9, 5.4, 7.4},
                              {3.1, 2.6, -0.2},
                              {10.4, 7.9, 5.9},
                              {1.2, 1.8, 2},
                              {8.8, 7.2, 8.4}},
                             1.4, 1.7),
                     options);
}

TEST_CASE("a speck is left out as a whole or not at all") {
    check_one_vessel(fork_of({{-1.95, -5.39, 1.79},
                              {0, 0, 0},
                              {0.2, 4.53, -0.22},
                              {3.39, 13.33, -3.13},
                              {3, 3.54, -0.7},
                              {6.13, 12.19, -3.57},
                              {1.11, 3.84, -3.04},
                              {4.13, 12.18, -5.8}},
                             1.39, 1.39),
                     plain_options(5.0, 12));
}

TEST_CASE("bricks agree on what is cut off where many vessels press on each other" * doctest::test_suite("slow")) {
    const auto path = test::shared_file("trees", "kidney_77922_segments.swc");
    if (!path) return;
    const auto kidney = io::read_tree(*path);
    REQUIRE(kidney);
    const glm::dvec3 middle(8.42058, 7.4696, 16.8831);
    std::vector<tree::Edge> edges; // of what is near, with larger radii
    std::vector<std::uint32_t> number(kidney->points.size(), 0);
    const auto is_near = [&](std::uint32_t point) {
        return glm::distance(kidney->points[point].position, middle) < 0.7;
    };
    std::vector<tree::Point> points;
    for (std::uint32_t n = 0; n < number.size(); ++n) {
        if (!is_near(n)) continue;
        number[n] = static_cast<std::uint32_t>(points.size());
        points.push_back({kidney->points[n].position, 1.6 * kidney->points[n].radius});
    }
    for (const tree::Branch& branch : kidney->branches)
        for (std::size_t i = 1; i < branch.points.size(); ++i)
            if (is_near(branch.points[i - 1]) && is_near(branch.points[i]))
                edges.emplace_back(number[branch.points[i - 1]], number[branch.points[i]]);
    REQUIRE(points.size() > 300);
    const std::vector<std::uint32_t> roots = tree::complete_roots(points, edges, {});
    const tree::VesselTree crowded = tree::assemble(std::move(points), {}, edges, roots);
    for (const int detail : {12, 16, 20}) {
        CAPTURE(detail);
        Job job;
        const auto surface = make_untangled_surface(crowded, plain_options(5.0, detail), job);
        REQUIRE_MESSAGE(surface, (surface ? "" : surface.error().message()));
        CHECK(test::topology(surface->mesh).closed_manifold());
    }
}

TEST_CASE("a fork that another vessel threads keeps the loops of its tree" * doctest::test_suite("slow")) {
    int cut = 0;
    for (std::uint64_t seed = 20; seed < 60; ++seed) {
        CAPTURE(seed);
        const tree::VesselTree tree = test::packed_trees(seed);
        SurfaceOptions options;
        options.detail = 8;
        Job job;
        const auto surface = make_surface(tree, options, job);
        REQUIRE(surface);
        if (surface->statistics.matched.false_loops.cut == 0) continue;
        ++cut;
        CHECK(test::topology(surface->mesh).closed_manifold());
        CHECK(connectivity_of(surface->mesh) == connectivity_of(tree));
    }
    CHECK(cut > 0);
}

} // namespace ramus::mesh
