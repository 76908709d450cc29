#include "core/measure/deviation/deviation.h"
#include "core/measure/deviation/packed_triangles.h"
#include "core/measure/mesh_distance.h"
#include "tests/support/icosphere.h"

#include <algorithm>
#include <cmath>
#include <doctest/doctest.h>
#include <glm/geometric.hpp>
#include <numbers>
#include <random>

using namespace ramus;
using measure::PackedTriangles;

namespace {

mesh::TriangleMesh grid(int cells, double height) {
    mesh::TriangleMesh mesh;
    for (int j = 0; j <= cells; ++j)
        for (int i = 0; i <= cells; ++i) mesh.positions.push_back(glm::vec3(i, j, height));
    const auto at = [&](int i, int j) { return static_cast<std::uint32_t>(j * (cells + 1) + i); };
    for (int j = 0; j < cells; ++j)
        for (int i = 0; i < cells; ++i) {
            mesh.triangles.emplace_back(at(i, j), at(i + 1, j), at(i + 1, j + 1));
            mesh.triangles.emplace_back(at(i, j), at(i + 1, j + 1), at(i, j + 1));
        }
    return mesh;
}

// Around the z axis, open at both ends.
mesh::TriangleMesh cylinder(double radius, double length, int sides, int rings) {
    mesh::TriangleMesh mesh;
    for (int ring = 0; ring <= rings; ++ring)
        for (int side = 0; side < sides; ++side) {
            const double angle = 2.0 * std::numbers::pi * side / sides;
            mesh.positions.push_back(
                glm::vec3(radius * std::cos(angle), radius * std::sin(angle), length * ring / rings));
        }
    const auto at = [&](int ring, int side) { return static_cast<std::uint32_t>(ring * sides + side % sides); };
    for (int ring = 0; ring < rings; ++ring)
        for (int side = 0; side < sides; ++side) {
            mesh.triangles.emplace_back(at(ring, side), at(ring, side + 1), at(ring + 1, side + 1));
            mesh.triangles.emplace_back(at(ring, side), at(ring + 1, side + 1), at(ring + 1, side));
        }
    return mesh;
}

void check_all(const LargeArray<double>& distances, double expected) {
    REQUIRE_FALSE(distances.empty());
    const auto [least, most] = std::ranges::minmax(distances);
    CHECK(std::abs(least - expected) < 1e-5);
    CHECK(std::abs(most - expected) < 1e-5);
}

// Triangles of all shapes, some of them lines and points, around places of all sizes.
mesh::TriangleMesh random_triangles(std::size_t count, std::mt19937& random) {
    std::uniform_real_distribution<float> place(-50.0F, 50.0F), size(-4.0F, 1.0F), off(-1.0F, 1.0F);
    mesh::TriangleMesh mesh;
    for (std::size_t i = 0; i < count; ++i) {
        const glm::vec3 middle(place(random), place(random), place(random));
        const float side = std::pow(10.0F, size(random));
        std::array<glm::vec3, 3> corners;
        for (glm::vec3& corner : corners) corner = middle + side * glm::vec3(off(random), off(random), off(random));
        if (i % 5 == 1) corners[2] = corners[1];
        if (i % 5 == 2) corners[2] = 0.5F * (corners[0] + corners[1]);
        if (i % 25 == 3) corners[1] = corners[2] = corners[0];
        const auto first = static_cast<std::uint32_t>(mesh.positions.size());
        for (const glm::vec3& corner : corners) mesh.positions.push_back(corner);
        mesh.triangles.emplace_back(first, first + 1, first + 2);
    }
    return mesh;
}

} // namespace

TEST_CASE("deviation: concentric spheres, coaxial cylinders and parallel planes, analytically") {
    // The plane through a vertex of a convex body that is inscribed in a sphere, across the radius there, has all of
    // the body on one side: the vertex is what is nearest to places farther out on that radius.
    check_all(measure::deviations(test::icosphere(4, {1, 2, 3}, 12.0), test::icosphere(4, {1, 2, 3}, 10.0)), 2.0);
    check_all(measure::deviations(cylinder(5.5, 40.0, 48, 20), cylinder(4.0, 40.0, 48, 33)), 1.5);
    check_all(measure::deviations(grid(30, 0.75), grid(30, 0.0)), 0.75);
    check_all(measure::deviations(grid(30, 0.75), grid(30, 0.75)), 0.0);
}

TEST_CASE("deviation: beyond the edge of a plane its edge and its corners are nearest") {
    mesh::TriangleMesh place;
    place.positions = {{13.0F, 5.0F, 4.0F}, {-3.0F, -4.0F, 12.0F}, {5.2F, 5.7F, -2.0F}};
    const LargeArray<double> distances = measure::deviations(place, grid(10, 0.0));
    CHECK(distances[0] == doctest::Approx(5.0));
    CHECK(distances[1] == doctest::Approx(13.0));
    CHECK(distances[2] == doctest::Approx(2.0));
}

TEST_CASE("deviation: the same as one by one, on triangles of all sizes and shapes") {
    std::mt19937 random(7);
    for (const std::size_t count : {1, 7, 8, 9, 64, 65, 700}) {
        const mesh::TriangleMesh other = random_triangles(count, random);
        const mesh::TriangleMesh points = random_triangles(300, random);
        const LargeArray<double> distances = measure::deviations(points, other);
        const measure::MeshDistance expected(other);
        double worst = 0.0;
        for (std::size_t i = 0; i < distances.size(); ++i)
            worst = std::max(worst, std::abs(distances[i] - expected.surface_distance(points.positions[i])));
        CHECK(worst < 1e-9);
    }
}

TEST_CASE("deviation: neither threads nor the order of vertices change a bit") {
    std::mt19937 random(8);
    const mesh::TriangleMesh other = random_triangles(5000, random);
    const mesh::TriangleMesh points = random_triangles(5000, random);
    const LargeArray<double> all = measure::deviations(points, other);
    CHECK(measure::deviations(points, other, 1) == all);
    mesh::TriangleMesh reversed;
    reversed.positions.assign(points.positions.rbegin(), points.positions.rend());
    LargeArray<double> back = measure::deviations(reversed, other);
    std::ranges::reverse(back);
    CHECK(back == all);
}

TEST_CASE("packed triangles: a line crosses a closed surface as often inward as outward, edges and corners included") {
    const mesh::TriangleMesh mesh = test::cube(2.0);
    const PackedTriangles cube(mesh);
    std::vector<measure::Crossing> found;
    // The middles of faces are on the edge between two triangles.
    for (const glm::dvec3& way :
         {glm::dvec3(1, 0, 0), glm::dvec3(0, -1, 0), glm::dvec3(0, 0, 1), glm::normalize(glm::dvec3(1, 1, 1)),
          glm::normalize(glm::dvec3(1, 1, 0)), glm::normalize(glm::dvec3(0.3, 0.2, 1))}) {
        cube.crossings({0, 0, 0}, way, 100.0, found);
        REQUIRE(found.size() == 1);
        CHECK(found[0].out);
        CHECK(found[0].at == doctest::Approx(1.0 / std::max({std::abs(way.x), std::abs(way.y), std::abs(way.z)})));
        cube.crossings(-5.0 * way, way, 100.0, found);
        REQUIRE(found.size() == 2);
        CHECK_FALSE(found[0].out);
        CHECK(found[1].out);
        cube.crossings(-5.0 * way, way, 5.0, found);
        CHECK(found.size() == 1);
        cube.crossings(5.0 * way, way, 100.0, found);
        CHECK(found.empty());
    }
}

TEST_CASE("packed triangles: all crossings of lines at random are found") {
    std::mt19937 random(9);
    std::uniform_real_distribution<double> place(-12.0, 12.0);
    mesh::TriangleMesh spheres = test::icosphere(3, {0, 0, 0}, 10.0);
    const mesh::TriangleMesh inner = test::icosphere(2, {1, 0, 0}, 4.0);
    const auto first = static_cast<std::uint32_t>(spheres.positions.size());
    for (const glm::vec3& position : inner.positions) spheres.positions.push_back(position);
    for (const glm::uvec3& t : inner.triangles) spheres.triangles.push_back(t + first);
    const PackedTriangles packed(spheres);
    std::vector<measure::Crossing> found;
    for (int round = 0; round < 2000; ++round) {
        const glm::dvec3 from(place(random), place(random), place(random));
        const glm::dvec3 way = glm::normalize(glm::dvec3(place(random), place(random), place(random)));
        packed.crossings(from, way, 1000.0, found);
        const double after = 0.01 * round;
        const auto exit = std::ranges::find_if(found, [&](const auto& one) { return one.out && one.at > after; });
        const measure::Crossing first_exit = packed.first_exit(from, way, after);
        if (exit == found.end())
            CHECK_FALSE(std::isfinite(first_exit.at));
        else
            CHECK(first_exit.at == exit->at);
        std::size_t expected = 0;
        for (const glm::uvec3& t : spheres.triangles) {
            const glm::dvec3 a = glm::dvec3(spheres.positions[t.x]) - from,
                             b = glm::dvec3(spheres.positions[t.y]) - from,
                             c = glm::dvec3(spheres.positions[t.z]) - from;
            const double p = glm::dot(way, glm::cross(a, b)), q = glm::dot(way, glm::cross(b, c)),
                         r = glm::dot(way, glm::cross(c, a));
            const double side = glm::dot(a, glm::cross(b, c)); // its sign: on which side of the plane the line begins
            expected += (p > 0 && q > 0 && r > 0 && side > 0) || (p < 0 && q < 0 && r < 0 && side < 0) ? 1 : 0;
        }
        CHECK(found.size() == expected);
        CHECK(std::ranges::is_sorted(found, {}, &measure::Crossing::at));
    }
}

TEST_CASE("packed triangles: where corners are not copied, distances and crossings have the same bits") {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> place(-12.0, 12.0);
    mesh::TriangleMesh sphere = test::icosphere(3, {0, 0, 0}, 10.0);
    sphere.triangles.pop_back(); // the last leaf is not full
    const PackedTriangles copied(sphere), gathered(sphere, sphere.triangles.size() - 1);
    const mesh::TriangleMesh points = random_triangles(3000, random);
    CHECK(gathered.distances(points.positions) == copied.distances(points.positions));
    std::vector<measure::Crossing> some, same;
    std::size_t met = 0;
    for (int round = 0; round < 1000; ++round) {
        const glm::dvec3 from(place(random), place(random), place(random));
        const glm::dvec3 way = glm::normalize(glm::dvec3(place(random), place(random), place(random)));
        copied.crossings(from, way, 1000.0, some);
        gathered.crossings(from, way, 1000.0, same);
        CHECK(std::ranges::equal(some, same, [](const measure::Crossing& a, const measure::Crossing& b) {
            return a.at == b.at && a.out == b.out && a.triangle == b.triangle;
        }));
        met += some.size();
    }
    CHECK(met > 500);
}

TEST_CASE("deviation: statistics of values that can be worked out by hand") {
    std::vector<double> values = {4, 1, 3, 2, 20};
    const measure::DeviationStatistics found = measure::statistics_of(values, 3.0);
    CHECK(found.count == 5);
    CHECK(found.mean == doctest::Approx(6.0));
    CHECK(found.rms == doctest::Approx(std::sqrt(430.0 / 5.0)));
    CHECK(found.sigma == doctest::Approx(std::sqrt(430.0 / 5.0 - 36.0)));
    CHECK(found.min == 1.0);
    CHECK(found.max == 20.0);
    CHECK(found.box.lower_quartile == 2.0);
    CHECK(found.box.median == 3.0);
    CHECK(found.box.upper_quartile == 4.0);
    CHECK(found.box.lower_whisker == 1.0); // 2 - 1.5 x 2 = -1 and 4 + 3 = 7 bound what is no outlier
    CHECK(found.box.upper_whisker == 4.0);
    CHECK(found.box.beyond == doctest::Approx(0.2));
    CHECK(found.percentile_95 == doctest::Approx(4.0 + 0.8 * 16.0));
    CHECK(*found.above == doctest::Approx(0.4)); // what is just at the threshold is not above it
    std::uint64_t counted = 0;
    for (const std::uint64_t count : found.histogram.counts) counted += count;
    CHECK(counted == 5);
    CHECK(found.histogram.counts.back() == 1);
    std::vector<double> one = {0.0};
    CHECK(measure::statistics_of(one, {}).box.upper_whisker == 0.0);
    CHECK_FALSE(measure::statistics_of(one, {}).above.has_value());
}

TEST_CASE("deviation: the farthest vertices are places apart from each other, the farthest first") {
    const mesh::TriangleMesh surface = grid(99, 0.0); // 100 x 100 vertices, 1 mm apart; 1 % of it is 1.4 mm
    std::vector<double> distances(surface.positions.size(), 0.0);
    const auto at = [](std::size_t x, std::size_t y) { return 100 * y + x; };
    distances[at(50, 50)] = 9.0;
    distances[at(51, 50)] = 8.0; // 1 mm away: the same place
    distances[at(52, 50)] = 7.0;
    distances[at(10, 90)] = 8.5;
    CHECK(measure::farthest_vertices(surface, distances, 3) ==
          std::vector<std::size_t>{at(50, 50), at(10, 90), at(52, 50)});
    CHECK(measure::farthest_vertices(test::icosphere(0, {0, 0, 0}, 1.0), std::vector<double>(12, 1.0), 50).size() ==
          12);
}

TEST_CASE("deviation: area and volume") {
    const measure::SurfaceSize cube = measure::size_of(test::cube(2.0));
    CHECK(cube.area_mm2 == doctest::Approx(24.0));
    CHECK(*cube.volume_mm3 == doctest::Approx(8.0));
    const measure::SurfaceSize open = measure::size_of(grid(10, 3.0));
    CHECK(open.area_mm2 == doctest::Approx(100.0));
    CHECK_FALSE(open.volume_mm3.has_value());
}
