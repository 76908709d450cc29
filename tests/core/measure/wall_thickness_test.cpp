#include "core/measure/wall_thickness.h"
#include "core/mesh/close_mesh.h"
#include "core/mesh/surface.h"
#include "tests/support/built_tree.h"
#include "tests/support/icosphere.h"

#include <cmath>
#include <doctest/doctest.h>

using namespace ramus;

namespace {

mesh::TriangleMesh surface_of(const tree::VesselTree& tree, int detail = 32) {
    Job job;
    mesh::SurfaceOptions options;
    options.smooth_passes = 0;
    options.detail = detail;
    auto surface = mesh::make_surface(tree, options, job);
    REQUIRE(surface);
    return std::move(surface->mesh);
}

} // namespace

TEST_CASE("a ball is as thick as its diameter, and thickness knows no unit but the mesh's") {
    for (const double radius : {0.01, 3.0, 500.0}) {
        mesh::TriangleMesh ball = test::icosphere(4, {100, -40, 7}, radius);
        auto closed = mesh::closed_mesh(std::move(ball), "ball");
        REQUIRE(closed);
        const auto found = measure::least_thicknesses(*closed);
        REQUIRE(found.size() == 1);
        CHECK(found[0].branch == tree::kNoBranch);
        // Triangles of level 4 lie at most 0.2 % inside the ball: 1 - cos(half of the longest edge's angle, 0.069).
        CHECK(found[0].mm <= 2.0 * radius * 1.0001);
        CHECK(found[0].mm >= 2.0 * radius * 0.996);
    }
}

TEST_CASE("of a box it is the shortest side") {
    mesh::TriangleMesh box;
    for (int i = 0; i < 8; ++i)
        box.positions.emplace_back((i & 1) != 0 ? 2.0F : 0.0F, (i & 2) != 0 ? 3.0F : 0.0F, (i & 4) != 0 ? 10.0F : 0.0F);
    box.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                     {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
    // A vertex in the middle of a long side, where the way through is 2.
    box.positions.emplace_back(0.0F, 1.5F, 5.0F);
    box.triangles[8] = {0, 4, 8};
    box.triangles[9] = {4, 6, 8};
    box.triangles.push_back({6, 2, 8});
    box.triangles.push_back({2, 0, 8});
    auto closed = mesh::closed_mesh(std::move(box), "box");
    REQUIRE(closed);
    CHECK(mesh::check_closed(*closed, "box"));
    const auto found = measure::least_thicknesses(*closed);
    REQUIRE(found.size() == 1);
    CHECK(found[0].mm == doctest::Approx(2.0).epsilon(1e-6));
    CHECK(found[0].at == glm::vec3(0.0F, 1.5F, 5.0F));
}

TEST_CASE("the thinnest place of a fork is on its thinnest branch, as thick as that") {
    // A stem with radius 2, a branch with 1 and one that narrows to 0.3; each long against its width.
    const tree::VesselTree tree = test::built_tree({{{0, 0, 0}, 2.0},
                                                    {{0, 0, 40}, 2.0},
                                                    {{30, 0, 70}, 1.0},
                                                    {{-30, 0, 70}, 0.6},
                                                    {{-60, 0, 100}, 0.3},
                                                    {{-80, 0, 120}, 0.3},
                                                    {{50, 0, 90}, 1.0}},
                                                   {{0, 1}, {1, 2}, {1, 3}, {3, 4}, {4, 5}, {2, 6}});
    const auto found = measure::least_thicknesses(surface_of(tree));
    REQUIRE(found.size() == 3);
    for (std::size_t i = 0; i + 1 < found.size(); ++i) CHECK(found[i].mm <= found[i + 1].mm);
    const int thin = found[0].branch;
    REQUIRE(thin >= 0);
    CHECK(tree.points[tree.branches[static_cast<std::size_t>(thin)].points.back()].radius == 0.3);
    // A tube of 32 triangles around: a chord is at least (1 + cos(pi / 32)) r = 1.995 r; the surface is within 0.5 %.
    CHECK(found[0].mm == doctest::Approx(0.6).epsilon(0.01));
    CHECK(found[0].at.x < -55.0F);
    CHECK(found[1].mm == doctest::Approx(2.0).epsilon(0.01));
}

TEST_CASE("neither the ends of vessels nor creases between them make a vessel thin") {
    // Two vessels of radius 1 that run into each other at a slant, and three ends.
    const tree::VesselTree tree = test::built_tree({{{0, 0, 0}, 1.0},
                                                    {{0, 0, 10}, 1.0},
                                                    {{1.2, 0, 20}, 1.0},
                                                    {{-1.2, 0, 20}, 1.0},
                                                    {{6, 0, 34}, 1.0},
                                                    {{-6, 0, 34}, 1.0}},
                                                   {{0, 1}, {1, 2}, {1, 3}, {2, 4}, {3, 5}});
    for (const auto& thickness : measure::least_thicknesses(surface_of(tree, 16)))
        // Where a centerline ends, half the kernel is there: exp(-w d^2) / 2 = exp(-w) at d^2 = 1 - 1 / width = 0.8. Of
        // that, 16 around: (1 + cos(pi / 16)) / 2.
        CHECK(thickness.mm > 2.0 * std::sqrt(0.8) * 0.99);
}

TEST_CASE("threads change nothing, and a surface with a hole is not closed") {
    const tree::VesselTree tree = test::built_tree({{{0, 0, 0}, 1.0}, {{0, 0, 9}, 0.5}}, {{0, 1}});
    mesh::TriangleMesh mesh = surface_of(tree);
    const auto one = measure::least_thicknesses(mesh, 1), two = measure::least_thicknesses(mesh, 2);
    REQUIRE(one.size() == two.size());
    CHECK(one[0].mm == two[0].mm);
    CHECK(one[0].at == two[0].at);
    CHECK(mesh::check_closed(mesh, "tube"));
    mesh.triangles.pop_back();
    const auto open = mesh::check_closed(mesh, "tube.stl");
    REQUIRE_FALSE(open);
    CHECK(open.error().message().find("tube.stl: the surface is not closed: 3 edges have one triangle only") == 0);
}
