// Places where surfaces of centerlines go wrong easily: joints of very different or of many vessels, narrow angles, and
// segments that are much shorter or longer than their radius.
#include "core/mesh/surface.h"
#include "core/mesh/tree_field.h"
#include "tests/support/built_tree.h"
#include "tests/support/mesh_topology.h"
#include "tests/support/surface_shape.h"

#include <algorithm>
#include <cmath>
#include <doctest/doctest.h>
#include <glm/geometric.hpp>
#include <numbers>

namespace ramus::mesh {

namespace {

// Vessels that begin at one point.
struct Vessels {
    std::vector<tree::Point> points{{{0, 0, 0}, 1.0}};
    std::vector<tree::Edge> edges;

    std::uint32_t run(std::uint32_t from, const glm::dvec3& to, double radius, int steps) {
        const glm::dvec3 begin = points[from].position;
        for (int n = 1; n <= steps; ++n) {
            points.push_back({begin + (double(n) / steps) * (to - begin), radius});
            edges.emplace_back(n == 1 ? from : static_cast<std::uint32_t>(points.size() - 2),
                               static_cast<std::uint32_t>(points.size() - 1));
        }
        return static_cast<std::uint32_t>(points.size() - 1);
    }
    [[nodiscard]] tree::VesselTree tree() const { return test::built_tree(points, edges, {0}); }
};

// How deep the deepest dent of a surface is: its least distance from the vessels, in their radii there; but for what is
// near a free end, where a surface becomes narrower and ends.
double least_radii(const TriangleMesh& mesh, const tree::VesselTree& tree) {
    std::vector<int> segments_at(tree.points.size(), 0);
    for (const tree::Branch& branch : tree.branches)
        for (std::size_t n = 1; n < branch.points.size(); ++n)
            ++segments_at[branch.points[n - 1]], ++segments_at[branch.points[n]];
    std::vector<tree::Point> ends;
    for (std::size_t n = 0; n < tree.points.size(); ++n)
        if (segments_at[n] == 1) ends.push_back(tree.points[n]);
    double least = 1e300;
    for (const glm::vec3& vertex : mesh.positions) {
        const glm::dvec3 at(vertex);
        if (std::ranges::any_of(
                ends, [&](const tree::Point& end) { return glm::distance(at, end.position) < 2.0 * end.radius; }))
            continue;
        for (const tree::Branch& branch : tree.branches)
            for (std::size_t n = 1; n < branch.points.size(); ++n) {
                const tree::Point &a = tree.points[branch.points[n - 1]], &b = tree.points[branch.points[n]];
                const glm::dvec3 line = b.position - a.position, to = at - a.position;
                const double share = std::clamp(glm::dot(to, line) / glm::dot(line, line), 0.0, 1.0);
                least = std::min(least, glm::distance(to, share * line) / (a.radius + share * (b.radius - a.radius)));
            }
    }
    return least;
}

// One closed piece without tunnels, without dents, in which all branches have a part.
void check(const Vessels& vessels) {
    const tree::VesselTree tree = vessels.tree();
    for (const int smooth_passes : {0, 1}) {
        CAPTURE(smooth_passes);
        SurfaceOptions options;
        options.smooth_passes = smooth_passes;
        Job job;
        const auto surface = make_surface(tree, options, job);
        REQUIRE(surface.has_value());
        CHECK(test::topology(surface->mesh).closed_manifold());
        CHECK(test::shape_of(test::pieces_of(surface->mesh)) == test::Shape{1, 0});
        CHECK(least_radii(surface->mesh, prepare_tree(tree, options).tree) > 0.97);
        std::vector<bool> seen(tree.branches.size(), false);
        for (const std::int32_t branch : surface->mesh.branches) seen[static_cast<std::size_t>(branch)] = true;
        CHECK(std::ranges::count(seen, false) == 0);
    }
}

} // namespace

TEST_CASE("a twig on a trunk of twenty times its radius is not swallowed, and leaves no dent") {
    Vessels vessels;
    const std::uint32_t middle = vessels.run(0, {10, 0, 0}, 1.0, 10);
    vessels.run(middle, {20, 0, 0}, 1.0, 10);
    vessels.run(middle, {10, 3, 1}, 0.05, 20);
    check(vessels);
}

TEST_CASE("four branches that meet in a point make a joint without a pinhole") {
    Vessels vessels;
    const std::uint32_t joint = vessels.run(0, {0, 0, 10}, 1.0, 12);
    vessels.run(joint, {8, 0, 16}, 0.8, 12);
    vessels.run(joint, {-7, 3, 17}, 0.7, 12);
    vessels.run(joint, {1, -8, 15}, 0.6, 12);
    check(vessels);
}

TEST_CASE("daughters at ten degrees part without a pinhole between them") {
    constexpr double kHalf = 5.0 * std::numbers::pi / 180.0;
    Vessels vessels;
    const std::uint32_t joint = vessels.run(0, {0, 0, 10}, 1.0, 10);
    vessels.run(joint, {40 * std::sin(kHalf), 0, 10 + 40 * std::cos(kHalf)}, 0.8, 40);
    vessels.run(joint, {-40 * std::sin(kHalf), 0, 10 + 40 * std::cos(kHalf)}, 0.8, 40);
    check(vessels);
}

// Found in a grown tree. The first vessel and the last two are far away: they give the lattice its place.
TEST_CASE("a wall that ends between a coarser cell and a finer one leaves the surface closed") {
    const std::vector<tree::Point> points{
        {{37.9303, 1.3099, 73.5444}, 0.04985},   {{37.9048, 1.3272, 73.7269}, 0.04985},
        {{68.0091, -10.6741, 60.8222}, 0.49011}, {{67.8705, -10.6199, 60.8439}, 0.49011},
        {{67.4154, -10.3521, 60.7224}, 0.48891}, {{67.2918, -10.2229, 60.6741}, 0.48891},
        {{67.2027, -10.0655, 60.6253}, 0.45647}, {{67.1205, -9.9006, 60.5868}, 0.45647},
        {{67.0456, -10.4508, 60.7551}, 0.27915}, {{66.9206, -10.5662, 60.7391}, 0.27915},
        {{66.7699, -10.5845, 60.649}, 0.27856},  {{66.6503, -10.5749, 60.5197}, 0.27856},
        {{66.6571, -10.5526, 60.3733}, 0.27785}, {{66.7138, -10.5493, 60.2326}, 0.27785},
        {{66.7408, -10.5272, 60.0852}, 0.27785}, {{66.738, -10.5614, 59.922}, 0.22987},
        {{66.8175, -10.4773, 59.9344}, 0.21032}, {{66.9046, -10.7266, 60.7867}, 0.05156},
        {{43.7888, -7.3438, -68.8863}, 0.06036}, {{43.8054, -7.3719, -69.0448}, 0.06036},
        {{-26.8375, 24.3406, 10.159}, 0.09022},  {{-26.7495, 24.3667, 10.3018}, 0.04945}};
    const std::vector<tree::Edge> edges{{0, 1},   {2, 3},   {4, 5},   {5, 6},   {6, 7},   {8, 9},  {9, 10},  {10, 11},
                                        {11, 12}, {12, 13}, {13, 14}, {14, 15}, {14, 16}, {9, 17}, {18, 19}, {20, 21}};
    Job job;
    SurfaceOptions options;
    options.detail = 8;
    const auto surface = make_untangled_surface(test::built_tree(points, edges, {0, 2, 4, 8, 18, 20}), options, job);
    REQUIRE(surface.has_value());
    CHECK(test::topology(surface->mesh).closed_manifold());
}

TEST_CASE("segments far shorter and far longer than the radius make the same smooth vessel") {
    Vessels vessels;
    const std::uint32_t first = vessels.run(0, {2, 0, 0}, 1.0, 100);
    const std::uint32_t second = vessels.run(first, {80, 0, 0}, 1.0, 1);
    vessels.run(second, {82, 0, 0}, 1.0, 100);
    check(vessels);
    SurfaceOptions options;
    options.smooth_passes = 0;
    Job job;
    const auto surface = make_surface(vessels.tree(), options, job);
    REQUIRE(surface.has_value());
    for (const glm::vec3& p : surface->mesh.positions)
        if (p.x > 1.0F && p.x < 78.0F) CHECK(std::hypot(p.y, p.z) == doctest::Approx(1.0).epsilon(0.005));
}

} // namespace ramus::mesh
