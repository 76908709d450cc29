#include "core/measure/lesion_distance.h"
#include "core/mesh/close_mesh.h"
#include "tests/support/built_tree.h"
#include "tests/support/icosphere.h"

#include <algorithm>
#include <cmath>
#include <doctest/doctest.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <random>

using namespace ramus;
using measure::Lesions;
using measure::MeshDistance;
using test::vessel_along;
using tree::VesselTree;

namespace {

// The nearest point of a triangle by the bare definition, in fine steps and then finer around the best.
double brute_triangle(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    double best = 1e300, at_u = 0.0, at_v = 0.0, width = 1.0;
    for (int zoom = 0; zoom < 12; ++zoom) {
        const double u0 = at_u, v0 = at_v;
        for (int i = -20; i <= 20; ++i)
            for (int k = -20; k <= 20; ++k) {
                const double u = std::clamp(u0 + width * i / 20.0, 0.0, 1.0);
                const double v = std::clamp(v0 + width * k / 20.0, 0.0, 1.0 - u);
                const double d = glm::distance(p, a + u * (b - a) + v * (c - a));
                if (d < best) best = d, at_u = u, at_v = v;
            }
        width *= 0.3;
    }
    return best;
}

} // namespace

TEST_CASE("a sphere's distance to a straight vessel is that of their axes less both radii") {
    const VesselTree tree = vessel_along({{{0, 0, 0}, 2}, {{0, 0, 40}, 2}});
    const auto distance = [&](std::array<double, 4> sphere) {
        return measure::wall_distances(tree, {{sphere}, {}}).front();
    };
    CHECK(distance({10, 0, 20, 3}) == doctest::Approx(5.0));
    CHECK(distance({0, 0, 50, 3}) == doctest::Approx(5.0)); // beyond its end, which is round
    CHECK(distance({6, 8, 40, 3}) == doctest::Approx(5.0));
    CHECK(distance({4, 0, 20, 3}) == 0.0); // they overlap
    CHECK(distance({0, 0, 20, 30}) == 0.0);
    CHECK(measure::wall_distances(tree, {}).front() == std::numeric_limits<double>::infinity());
    const auto nearest = measure::wall_distances(tree, {{{10, 0, 20, 3}, {9, 0, 5, 3}}, {}});
    CHECK(nearest.front() == doctest::Approx(4.0));
}

TEST_CASE("a cone's wall is slanted: the nearest place is not at the foot of the lesion") {
    // Radius 6 to 0 over 8 mm along z: the wall of the balls' hull rises with sin = 6/8.
    const VesselTree tree = vessel_along({{{0, 0, 0}, 6}, {{0, 0, 8}, 1e-9}});
    const double slope = -6.0 / 8.0, cosine = std::sqrt(1.0 - slope * slope);
    // From a place at z = 4 straight out along the wall's normal by 7 mm.
    const double at = 4.0, radius = 3.0;
    const glm::dvec3 out(cosine, 0.0, -slope);
    const glm::dvec3 centre = glm::dvec3(0, 0, at) + (radius + 7.0) * out;
    const auto distances = measure::wall_distances(tree, {{{centre.x, centre.y, centre.z, 2.0}}, {}});
    CHECK(distances.front() == doctest::Approx(5.0).epsilon(1e-6));
}

TEST_CASE("distances to spheres agree with fine sampling along vessels at random") {
    std::mt19937 random(4);
    std::uniform_real_distribution<double> place(-20.0, 20.0), size(0.2, 4.0);
    for (int round = 0; round < 100; ++round) {
        std::vector<tree::Point> points(5);
        for (tree::Point& p : points) p = {{place(random), place(random), place(random)}, size(random)};
        const VesselTree tree = vessel_along(points);
        const std::array<double, 4> sphere{place(random), place(random), place(random), size(random)};
        double expected = 1e300;
        constexpr int kSteps = 4000;
        for (std::size_t i = 1; i < points.size(); ++i)
            for (int k = 0; k <= kSteps; ++k) {
                const glm::dvec3 p = glm::mix(points[i - 1].position, points[i].position, double(k) / kSteps);
                const double r = glm::mix(points[i - 1].radius, points[i].radius, double(k) / kSteps);
                expected = std::min(expected, glm::distance(p, {sphere[0], sphere[1], sphere[2]}) - r - sphere[3]);
            }
        CHECK(measure::wall_distances(tree, {{sphere}, {}}).front() ==
              doctest::Approx(std::max(expected, 0.0)).epsilon(1e-4));
    }
}

TEST_CASE("the distance to a mesh is that to its nearest triangle, and 0 inside" * doctest::test_suite("slow")) {
    std::mt19937 random(8);
    std::uniform_real_distribution<double> place(-3.0, 3.0);
    const mesh::TriangleMesh ball = test::icosphere(2, {0.3, -0.2, 0.1}, 1.5);
    const MeshDistance distance(ball);
    int inside = 0;
    for (int round = 0; round < 60; ++round) {
        const glm::dvec3 p(place(random), place(random), place(random));
        double expected = 1e300;
        for (const glm::uvec3& t : ball.triangles)
            expected =
                std::min(expected, brute_triangle(p, glm::dvec3(ball.positions[t.x]), glm::dvec3(ball.positions[t.y]),
                                                  glm::dvec3(ball.positions[t.z])));
        CHECK(distance.surface_distance(p) == doctest::Approx(expected).epsilon(1e-5));
        const double from_middle = glm::distance(p, glm::dvec3(0.3, -0.2, 0.1));
        if (std::abs(from_middle - 1.5) < 0.1) continue; // between the sphere and its flat sides
        CHECK(distance.inside(p) == (from_middle < 1.5));
        CHECK(distance.distance(p) == (from_middle < 1.5 ? 0.0 : distance.surface_distance(p)));
        inside += from_middle < 1.5 ? 1 : 0;
    }
    CHECK(inside > 2);
}

TEST_CASE("a fine icosphere is a sphere") {
    const mesh::TriangleMesh ball = test::icosphere(5, {10, 0, 0}, 4.0); // 20,480 triangles, 0.1 % flat
    const MeshDistance distance(ball);
    std::mt19937 random(2);
    std::uniform_real_distribution<double> place(-12.0, 22.0);
    for (int i = 0; i < 2000; ++i) {
        const glm::dvec3 p(place(random), place(random) - 5.0, place(random) - 5.0);
        const double expected = std::max(glm::distance(p, {10, 0, 0}) - 4.0, 0.0);
        CHECK(std::abs(distance.distance(p) - expected) < 0.005);
    }
    // And to vessels as the sphere is.
    for (int round = 0; round < 30; ++round) {
        const VesselTree tree = vessel_along({{{place(random), place(random), place(random)}, 0.5},
                                              {{place(random), place(random), place(random)}, 2.0},
                                              {{place(random), place(random), place(random)}, 1.0}});
        const double sphere = measure::wall_distances(tree, {{{10, 0, 0, 4}}, {}}).front();
        const Lesions mesh{{}, {std::make_shared<const MeshDistance>(ball)}};
        CHECK(std::abs(measure::wall_distances(tree, mesh).front() - sphere) < 0.005);
        CHECK(measure::lesion_distance(mesh, {30, 0, 0}) == doctest::Approx(16.0).epsilon(1e-3));
    }
}

TEST_CASE("inside is told right along rays that meet corners and edges of a cube") {
    const mesh::TriangleMesh cube = test::cube(2.0);
    const MeshDistance distance(cube);
    for (int i = -6; i <= 6; ++i)
        for (int j = -6; j <= 6; ++j)
            for (int k = -6; k <= 6; ++k) {
                const double x = 0.25 * i, y = 0.25 * j, z = 0.25 * k;
                const double most = std::max({std::abs(x), std::abs(y), std::abs(z)});
                if (most == 1.0) continue;
                CHECK(distance.inside({x, y, z}) == (most < 1.0));
            }
    CHECK(distance.distance({3, 0, 0}) == doctest::Approx(2.0));
    CHECK(distance.distance({2, 2, 2}) == doctest::Approx(std::sqrt(3.0)));
}

TEST_CASE("solids that overlap are one, a shell turned inward is a hole") {
    mesh::TriangleMesh two = test::icosphere(2, {0, 0, 0}, 2.0);
    const auto add = [](mesh::TriangleMesh& to, const mesh::TriangleMesh& more, bool turned) {
        const auto first = static_cast<std::uint32_t>(to.positions.size());
        for (const glm::vec3& p : more.positions) to.positions.push_back(p);
        for (glm::uvec3 t : more.triangles) {
            if (turned) std::swap(t.y, t.z);
            to.triangles.push_back(t + first);
        }
    };
    mesh::TriangleMesh hollow = two;
    add(two, test::icosphere(2, {1, 0, 0}, 2.0), false);
    CHECK(MeshDistance(two).inside({0.5, 0, 0}));
    CHECK_FALSE(MeshDistance(two).inside({-2.5, 0, 0}));
    add(hollow, test::icosphere(2, {0, 0, 0}, 1.0), true);
    CHECK_FALSE(MeshDistance(hollow).inside({0.1, 0, 0}));
    CHECK(MeshDistance(hollow).inside({1.5, 0, 0}));
    const auto closed = mesh::closed_mesh(hollow, "hollow");
    REQUIRE(closed);
    CHECK_FALSE(MeshDistance(*closed).inside({0.1, 0, 0}));
}

TEST_CASE("bands hold what lies within them, the thickest first") {
    measure::TreeStatistics statistics;
    for (const double diameter : {1.0, 4.0, 2.0, 3.0, 5.0, 4.0}) {
        measure::BranchStatistics one;
        one.diameter_mm.mean = diameter;
        statistics.branches.push_back(one);
    }
    std::vector<measure::Amount> dependents(6);
    dependents[1].branches = 7;
    const std::vector<double> distances{0.0, 5.0, 5.1, 12.0, 20.1, 3.0}, bands{5.0, 10.0, 20.0};
    const auto table = measure::band_table(distances, bands, statistics, dependents);
    REQUIRE(table.size() == 3);
    const auto ids = [](const measure::Band& band) {
        std::vector<int> all;
        for (const auto& row : band.rows) all.push_back(row.branch);
        return all;
    };
    CHECK(ids(table[0]) == std::vector<int>{1, 5, 0});
    CHECK(ids(table[1]) == std::vector<int>{2});
    CHECK(ids(table[2]) == std::vector<int>{3});
    CHECK(table[1].from_mm == 5.0);
    CHECK(table[0].rows[0].dependents.branches == 7);
    CHECK(table[2].rows[0].distance_mm == 12.0);
}
