#include "core/io/trees/tree_file.h"
#include "core/measure/wall_thickness.h"
#include "core/mesh/close_mesh.h"
#include "core/mesh/surface.h"
#include "core/mesh/tree_field.h"
#include "tests/support/built_tree.h"
#include "tests/support/icosphere.h"
#include "tests/support/shared_data.h"

#include <array>
#include <cmath>
#include <doctest/doctest.h>
#include <glm/common.hpp>
#include <glm/vec2.hpp>
#include <vector>

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

// A solid between z = 0 and `length`, whose section has these corners, counter-clockwise and with the origin within.
mesh::TriangleMesh extruded(const std::vector<glm::dvec2>& section, double length, std::uint32_t steps) {
    mesh::TriangleMesh mesh;
    const auto sides = static_cast<std::uint32_t>(section.size());
    for (std::uint32_t k = 0; k <= steps; ++k)
        for (const glm::dvec2& corner : section) mesh.positions.push_back(glm::vec3(corner, length * k / steps));
    mesh.positions.emplace_back(0.0F, 0.0F, 0.0F);
    mesh.positions.emplace_back(0.0F, 0.0F, static_cast<float>(length));
    for (std::uint32_t i = 0; i < sides; ++i) {
        const std::uint32_t next = (i + 1) % sides, top = steps * sides;
        for (std::uint32_t k = 0; k < steps; ++k) {
            const std::uint32_t a = k * sides + i, b = k * sides + next;
            mesh.triangles.emplace_back(a, b, b + sides);
            mesh.triangles.emplace_back(a, b + sides, a + sides);
        }
        mesh.triangles.emplace_back(next, i, top + sides);
        mesh.triangles.emplace_back(top + i, top + next, top + sides + 1);
    }
    auto closed = mesh::closed_mesh(std::move(mesh), "extruded");
    REQUIRE(closed);
    return std::move(*closed);
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

TEST_CASE("the acute edge of a thick solid is no thin wall") {
    // A prism of 30 mm whose section is a triangle with 40 degrees at its tip, corners a hundredth of a side apart.
    const double slope = std::tan(std::acos(-1.0) / 9.0);
    const std::array<glm::dvec2, 3> corners{{{-10.0, 0.0}, {10.0, -20.0 * slope}, {10.0, 20.0 * slope}}};
    std::vector<glm::dvec2> section;
    for (std::size_t side = 0; side < 3; ++side)
        for (int n = 0; n < 100; ++n) section.push_back(glm::mix(corners[side], corners[(side + 1) % 3], 0.01 * n));
    const auto found = measure::least_thicknesses(extruded(section, 30.0, 20));
    REQUIRE(found.size() == 1);
    // The shortest way across between two places that face each other: from a corner at the base, where normals are
    // the mean of two sides', to the side across, 40 sin 20 degrees. Near the tip sides are a hundredth of that apart.
    CHECK(found[0].mm == doctest::Approx(40.0 * std::sin(std::acos(-1.0) / 9.0)).epsilon(1e-3));
}

TEST_CASE("a plate, a septum and a stenosis have their own thickness") {
    std::vector<glm::dvec2> plate;
    for (int n = 0; n < 20; ++n) plate.emplace_back(-5.0 + 0.5 * n, -0.1);
    for (int n = 0; n < 20; ++n) plate.emplace_back(5.0 - 0.5 * n, 0.1);
    CHECK(measure::least_thicknesses(extruded(plate, 10.0, 10)).front().mm == doctest::Approx(0.2).epsilon(1e-5));

    // A ball of 5 mm with a hole of 4 mm, 0.8 mm aside: a wall of 0.2 mm at the thinnest. Triangles of level 5 lie at
    // most 0.06 % inside a ball (1 - cos of half the longest edge's angle, 0.035), of both balls 0.003 mm.
    mesh::TriangleMesh shell = test::icosphere(5, {0, 0, 0}, 5.0);
    const mesh::TriangleMesh hole = test::icosphere(5, {0.8, 0, 0}, 4.0);
    const auto first = static_cast<std::uint32_t>(shell.positions.size());
    for (const glm::vec3& p : hole.positions) shell.positions.push_back(p);
    for (const glm::uvec3& t : hole.triangles) shell.triangles.emplace_back(t.x + first, t.z + first, t.y + first);
    auto closed = mesh::closed_mesh(std::move(shell), "shell");
    REQUIRE(closed);
    const auto septum = measure::least_thicknesses(*closed);
    REQUIRE(septum.size() == 1);
    CHECK(std::abs(septum[0].mm - 0.2) < 0.01);
    CHECK(septum[0].at.x > 4.0F);

    // A tube of radius 1 that narrows to 0.4 over 2 mm: 64 corners around, a layer every 0.1 mm.
    std::vector<glm::dvec2> ring;
    for (int n = 0; n < 64; ++n) {
        const double turn = 2.0 * std::acos(-1.0) * n / 64.0;
        ring.emplace_back(std::cos(turn), std::sin(turn));
    }
    mesh::TriangleMesh tube = extruded(ring, 20.0, 200);
    for (glm::vec3& p : tube.positions) {
        const float narrowed = 1.0F - 0.6F * std::exp(-(p.z - 10.0F) * (p.z - 10.0F));
        p.x *= narrowed, p.y *= narrowed;
    }
    auto narrow = mesh::closed_mesh(std::move(tube), "stenosis");
    REQUIRE(narrow);
    const auto stenosis = measure::least_thicknesses(*narrow);
    REQUIRE(stenosis.size() == 1);
    CHECK(stenosis[0].mm == doctest::Approx(0.8).epsilon(0.005)); // of 64 corners: 1 - cos(pi / 64) = 0.0012
    CHECK(std::abs(stenosis[0].at.z - 10.0F) < 0.11F);
}

TEST_CASE("a vessel that lies against its parent is as thick as its own radii say") {
    const auto file = test::shared_file("reports", "fold_at_fork.swc");
    if (!file) return;
    const auto tree = io::read_tree(*file);
    REQUIRE(tree);
    for (const int detail : {8, 16, 32}) {
        mesh::SurfaceOptions options;
        options.detail = detail;
        Job job;
        const auto surface = mesh::make_untangled_surface(*tree, options, job);
        REQUIRE(surface);
        double thinnest = 1e300; // as the surface follows the tree
        for (const tree::Point& point : mesh::prepare_tree(*tree, options).tree.points)
            thinnest = std::min(thinnest, 2.0 * point.radius);
        const auto found = measure::least_thicknesses(surface->mesh);
        REQUIRE_FALSE(found.empty());
        // Where radii grow to both sides the plain field rounds the narrowest place, by a few percent.
        CHECK(found.front().mm == doctest::Approx(thinnest).epsilon(0.05));
    }
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
