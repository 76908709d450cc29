// Truncated cones: closed, outward, and with the volume that geometry gives them.
#include "core/mesh/cones.h"
#include "core/mesh/tree_field.h"
#include "tests/support/built_tree.h"
#include "tests/support/mesh_topology.h"

#include <cmath>
#include <doctest/doctest.h>
#include <glm/geometric.hpp>
#include <numbers>

using namespace ramus;

namespace {

mesh::TriangleMesh cone(double radius_a, double radius_b, double length, int detail) {
    // Askew, so that no axis is special.
    const glm::dvec3 direction = glm::normalize(glm::dvec3(1.0, -2.0, 3.0));
    const glm::dvec3 start(5.0, 6.0, 7.0);
    const auto tree = test::built_tree({{start, radius_a}, {start + length * direction, radius_b}}, {{0, 1}});
    mesh::SurfaceOptions options;
    options.smooth_passes = 0;
    Job job;
    auto mesh = mesh::cones(mesh::prepare_tree(tree, options), detail, job);
    REQUIRE(mesh.has_value());
    return *mesh;
}

// Convex hull of two balls, neither of which holds the other: with sin(t) = (ra - rb) / length, the touching circles
// lie r sin(t) from each centre toward b, with radius r cos(t). Between them a
// frustum, beyond them the balls' caps of height r (1 + sin t) at a and r (1 - sin t) at b.
double hull_of_balls(double ra, double rb, double length) {
    const double sine = (ra - rb) / length;
    const double cosine = std::sqrt(1.0 - sine * sine);
    const auto cap = [](double r, double h) { return std::numbers::pi * h * h * (3.0 * r - h) / 3.0; };
    const double height = length + (rb - ra) * sine;
    const double p = ra * cosine;
    const double q = rb * cosine;
    return cap(ra, ra * (1.0 + sine)) + cap(rb, rb * (1.0 - sine)) +
           std::numbers::pi * height * (p * p + p * q + q * q) / 3.0;
}

} // namespace

TEST_CASE("a cone is closed, outward and has the volume of the hull of its balls") {
    struct Case {
        double ra, rb, length;
    };
    for (const Case& c : {Case{2, 2, 10}, Case{2, 1, 10}, Case{1, 2, 10}, Case{3, 1, 3}, Case{1, 1, 0.01}}) {
        CAPTURE(c.ra);
        CAPTURE(c.rb);
        CAPTURE(c.length);
        const auto mesh = cone(c.ra, c.rb, c.length, 256);
        const test::Topology counted = test::topology(mesh);
        CHECK(counted.closed_manifold());
        CHECK(counted.euler == 2);
        // Below, by what chords cut off: 32 steps along a meridian of at most pi/2 + asin(2/3) make d = 0.072 rad, and
        // a ball of such rings lacks about d^2 / 4 = 1.3e-3 of its volume; 256 sides around lack 1e-4.
        const double exact = hull_of_balls(c.ra, c.rb, c.length);
        CHECK(test::topology(mesh).volume < exact);
        CHECK(test::topology(mesh).volume > (1.0 - 1.4e-3) * exact);
    }
}

TEST_CASE("a ball inside the other leaves the larger one") {
    const auto mesh = cone(3.0, 1.0, 1.0, 256);
    CHECK(test::topology(mesh).volume == doctest::Approx(4.0 / 3.0 * std::numbers::pi * 27.0).epsilon(5e-3));
}

TEST_CASE("vertices of cones lie on their balls or between them, and normals point away from the axis") {
    const auto mesh = cone(2.0, 1.0, 10.0, 16);
    const glm::dvec3 a(5.0, 6.0, 7.0);
    const glm::dvec3 u = glm::normalize(glm::dvec3(1.0, -2.0, 3.0));
    const glm::dvec3 b = a + 10.0 * u;
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
        const glm::dvec3 p = mesh.positions[v];
        const double off_a = std::abs(glm::distance(p, a) - 2.0);
        const double off_b = std::abs(glm::distance(p, b) - 1.0);
        CHECK(std::min(off_a, off_b) < 1e-5);
        const glm::dvec3 centre = off_a < off_b ? a : b;
        CHECK(glm::dot(glm::dvec3(mesh.normals[v]), glm::normalize(p - centre)) > 1.0 - 1e-5);
        CHECK(mesh.radii[v] == (off_a < off_b ? 2.0F : 1.0F));
        CHECK(mesh.branches[v] == 0);
    }
}
