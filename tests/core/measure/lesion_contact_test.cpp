// Against closed forms where there are any, and against brute force: cross-sections and walls sampled finely.
#include "core/measure/lesion_contact.h"
#include "tests/support/built_tree.h"
#include "tests/support/icosphere.h"

#include <algorithm>
#include <cmath>
#include <doctest/doctest.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <numbers>
#include <random>

using namespace ramus;
using measure::Lesion;
using test::vessel_along;
using tree::VesselTree;

namespace {

Lesion sphere(double x, double y, double z, double radius) { return {{x, y, z, radius}, nullptr}; }

Lesion of(const mesh::TriangleMesh& mesh) { return {{}, std::make_shared<const measure::MeshDistance>(mesh)}; }

Lesion box(const glm::vec3& low, const glm::vec3& high) {
    mesh::TriangleMesh mesh;
    for (int i = 0; i < 8; ++i) mesh.positions.push_back(glm::mix(low, high, glm::vec3(i & 1, i >> 1 & 1, i >> 2 & 1)));
    for (const glm::uvec4& q :
         {glm::uvec4{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}) {
        mesh.triangles.push_back({q.x, q.y, q.z});
        mesh.triangles.push_back({q.x, q.z, q.w});
    }
    return of(mesh);
}

// The wall's share within the lesion, point by point.
double brute_angle(const Lesion& lesion, const glm::dvec3& centre, const glm::dvec3& axis, double radius, double touch,
                   int parts = 7200) {
    const glm::dvec3 u = glm::normalize(glm::cross(axis, glm::dvec3(0.3, 0.9, -0.4))), v = glm::cross(axis, u);
    int within = 0;
    for (int i = 0; i < parts; ++i) {
        const double a = 2.0 * std::numbers::pi * i / parts;
        const glm::dvec3 wall = centre + radius * (std::cos(a) * u + std::sin(a) * v);
        if (measure::signed_distance(lesion, wall) <= touch) ++within;
    }
    return 360.0 * within / parts;
}

// A wall of the radius r around the z axis, a sphere of radius big at the distance d of the axis, and a cross-section
// that lies h off the sphere's middle: the wall touches where |wall - centre| <= big.
double sphere_angle(double r, double big, double d, double h) {
    const double cosine = (d * d + r * r + h * h - big * big) / (2.0 * d * r);
    return 2.0 * glm::degrees(std::acos(std::clamp(cosine, -1.0, 1.0)));
}

} // namespace

TEST_CASE("the shortest way from a sphere to a straight vessel goes from surface to wall") {
    const VesselTree tree = vessel_along({{{0, 0, 0}, 2}, {{0, 0, 40}, 2}});
    const auto found = measure::nearest_wall(tree, std::vector{0}, sphere(10, 0, 30, 3));
    CHECK(found.branch == 0);
    CHECK(found.fraction == doctest::Approx(0.75));
    CHECK(found.distance_mm == doctest::Approx(5.0));
    CHECK(found.overlap_mm == 0.0);
    CHECK(glm::distance(found.on_lesion, {7, 0, 30}) < 1e-9);
    CHECK(glm::distance(found.on_wall, {2, 0, 30}) < 1e-9);
    CHECK(measure::nearest_wall(tree, {}, sphere(10, 0, 30, 3)).branch == tree::kNoBranch);
}

TEST_CASE("a sphere that overlaps a vessel says how deep") {
    const VesselTree tree = vessel_along({{{0, 0, 0}, 2}, {{0, 0, 40}, 2}});
    const auto touching = measure::nearest_wall(tree, std::vector{0}, sphere(5, 0, 20, 3));
    CHECK(touching.distance_mm == doctest::Approx(0.0));
    CHECK(touching.overlap_mm == doctest::Approx(0.0));
    const auto half = measure::nearest_wall(tree, std::vector{0}, sphere(4, 0, 20, 3));
    CHECK(half.distance_mm == 0.0);
    CHECK(half.overlap_mm == doctest::Approx(1.0));
    CHECK(glm::distance(half.on_lesion, {1, 0, 20}) < 1e-9);
    CHECK(glm::distance(half.on_wall, {2, 0, 20}) < 1e-9);
    const auto swallowed = measure::nearest_wall(tree, std::vector{0}, sphere(1, 0, 20, 9));
    CHECK(swallowed.overlap_mm ==
          doctest::Approx(10.0)); // its far wall, at x = 2, is 8 mm within; through x = -2 it is 10
    CHECK(glm::distance(swallowed.on_wall, swallowed.on_lesion) == doctest::Approx(10.0));
}

TEST_CASE("the shortest way to a mesh agrees with fine sampling along vessels at random" *
          doctest::test_suite("slow")) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> place(-20.0, 20.0), size(0.3, 3.0);
    for (int round = 0; round < 20; ++round) {
        std::vector<tree::Point> points(5);
        for (tree::Point& p : points) p = {{place(random), place(random), place(random)}, size(random)};
        const VesselTree tree = vessel_along(points);
        auto mesh = test::icosphere(3, glm::dvec3(0.0), 1.0);
        const glm::vec3 middle(place(random), place(random), place(random));
        for (glm::vec3& p : mesh.positions) p = middle + glm::vec3(4.0F, 2.0F, 3.0F) * p;
        const Lesion lesion = of(mesh);
        const auto found = measure::nearest_wall(tree, std::vector{0}, lesion);
        double least = 1e300;
        for (std::size_t i = 1; i < points.size(); ++i)
            for (int k = 0; k <= 2000; ++k) {
                const double t = k / 2000.0;
                const glm::dvec3 at = glm::mix(points[i - 1].position, points[i].position, t);
                least = std::min(least, measure::signed_distance(lesion, at) -
                                            glm::mix(points[i - 1].radius, points[i].radius, t));
            }
        const double gap = found.distance_mm - found.overlap_mm;
        CHECK(gap == doctest::Approx(least).epsilon(0.01));
        CHECK(glm::distance(found.on_lesion, found.on_wall) == doctest::Approx(std::abs(gap)).epsilon(1e-6));
        CHECK(std::abs(measure::signed_distance(lesion, found.on_lesion)) < 1e-6);
    }
}

TEST_CASE("a sphere that touches a cylinder covers what the closed form says") {
    const double r = 4.0, big = 10.0;
    for (const double d : {13.9, 12.0, 9.0, 7.0, 6.1})
        for (const double h : {0.0, 1.0, 3.0}) {
            const Lesion lesion = sphere(d, 0, h, big);
            CHECK(measure::contact_angle_deg(lesion, {0, 0, 0}, {0, 0, 1}, r, 0.0) ==
                  doctest::Approx(sphere_angle(r, big, d, h)).epsilon(1e-3));
            CHECK(measure::contact_angle_deg(lesion, {0, 0, 0}, {0, 0, 1}, r, 0.5) ==
                  doctest::Approx(sphere_angle(r, big + 0.5, d, h)).epsilon(1e-3));
        }
    CHECK(measure::contact_angle_deg(sphere(14.6, 0, 0, big), {0, 0, 0}, {0, 0, 1}, r, 0.5) == 0.0);
    CHECK(measure::contact_angle_deg(sphere(5.0, 0, 0, big), {0, 0, 0}, {0, 0, 1}, r, 0.0) == doctest::Approx(360.0));
}

TEST_CASE("along a straight vessel a sphere's contact is as long and wide as the closed form says") {
    const double r = 4.0, big = 10.0, d = 12.0, touch = 0.5;
    const VesselTree tree = vessel_along({{{0, 0, -40}, r}, {{0, 0, -3}, r}, {{0, 0, 50}, r}});
    const auto found = measure::wall_contact(tree, 0, sphere(d, 0, 2, big), touch);
    CHECK(found.branch == 0);
    CHECK(found.angle_deg == doctest::Approx(sphere_angle(r, big + touch, d, 0.0)).epsilon(1e-4));
    // The nearest line of the wall, d - r from the centre, is within reach over twice sqrt((big + touch)^2 - (d -
    // r)^2).
    CHECK(found.length_mm == doctest::Approx(2.0 * std::sqrt(10.5 * 10.5 - 64.0)).epsilon(1e-3));
    CHECK(found.fraction == doctest::Approx(42.0 / 90.0).epsilon(1e-3));
    CHECK(measure::wall_contact(tree, 0, sphere(15.0, 0, 2, big), touch).branch == tree::kNoBranch);
}

TEST_CASE("a plane through the axis covers half a vessel, one next to the axis the arc it cuts off") {
    const VesselTree tree = vessel_along({{{0, 0, 0}, 3}, {{0, 0, 60}, 3}});
    const auto half = measure::wall_contact(tree, 0, box({0, -30, 10}, {30, 30, 34}), 0.0);
    CHECK(half.angle_deg == doctest::Approx(180.0).epsilon(1e-3));
    CHECK(half.length_mm == doctest::Approx(24.0).epsilon(1e-3));
    const auto less = measure::wall_contact(tree, 0, box({1.5, -30, 10}, {30, 30, 34}), 0.0);
    CHECK(less.angle_deg == doctest::Approx(120.0).epsilon(1e-3)); // 2 acos(1.5 / 3)
    // From the side, within the tolerance: 2 acos(2.5 / 3), and at either end as far as the tolerance reaches.
    const auto near = measure::wall_contact(tree, 0, box({3.2, -30, 10}, {30, 30, 34}), 0.7);
    CHECK(near.angle_deg == doctest::Approx(2.0 * glm::degrees(std::acos(2.5 / 3.0))).epsilon(1e-3));
    CHECK(near.length_mm == doctest::Approx(24.0 + 2.0 * std::sqrt(0.49 - 0.04)).epsilon(1e-3));
}

TEST_CASE("a lesion around a vessel covers all of it" * doctest::test_suite("slow")) {
    const VesselTree tree = vessel_along({{{0, 0, 0}, 3}, {{0, 0, 60}, 3}});
    const auto swallowed = measure::wall_contact(tree, 0, sphere(0, 0, 30, 10), 0.0);
    CHECK(swallowed.angle_deg == doctest::Approx(360.0));
    CHECK(swallowed.length_mm == doctest::Approx(2.0 * std::sqrt(91.0)).epsilon(1e-3)); // the wall enters at the caps
    // A sleeve that lies 0.3 mm off the wall all round, 8 mm long, as a mesh.
    mesh::TriangleMesh ring;
    constexpr unsigned kAround = 360, kWalls = 4;
    for (unsigned i = 0; i < kAround; ++i) {
        const double a = 2.0 * std::numbers::pi * i / kAround;
        for (const auto& [radius, z] : {std::pair(3.3, 26.0), {6.0, 26.0}, {6.0, 34.0}, {3.3, 34.0}})
            ring.positions.emplace_back(radius * std::cos(a), radius * std::sin(a), z);
        for (unsigned w = 0; w < kWalls; ++w) {
            const unsigned a0 = kWalls * i + w, a1 = kWalls * i + (w + 1) % kWalls;
            const unsigned b0 = kWalls * ((i + 1) % kAround) + w, b1 = kWalls * ((i + 1) % kAround) + (w + 1) % kWalls;
            ring.triangles.push_back({a0, b1, b0});
            ring.triangles.push_back({a0, a1, b1});
        }
    }
    const Lesion sleeve = of(ring);
    CHECK(measure::wall_contact(tree, 0, sleeve, 0.2).branch == tree::kNoBranch);
    const auto around = measure::wall_contact(tree, 0, sleeve, 0.5);
    CHECK(around.angle_deg == doctest::Approx(360.0));
    CHECK(around.length_mm == doctest::Approx(8.0 + 2.0 * std::sqrt(0.25 - 0.09)).epsilon(5e-3));
    CHECK(measure::nearest_wall(tree, std::vector{0}, sleeve).distance_mm == doctest::Approx(0.3).epsilon(5e-3));
}

TEST_CASE("contacts with meshes agree with brute force along tapered, bent vessels" * doctest::test_suite("slow")) {
    const VesselTree tree = vessel_along({{{-20, 1, 0}, 2.5}, {{-3, 0, 1}, 2.0}, {{6, 2, 0}, 1.6}, {{20, 8, -3}, 1.0}});
    auto mesh = test::icosphere(4, glm::dvec3(0.0), 1.0);
    for (glm::vec3& p : mesh.positions) p = glm::vec3(0, 4, 1) + glm::vec3(7.0F, 3.0F, 4.0F) * p;
    const Lesion lesion = of(mesh);
    const double touch = 0.4;
    const auto found = measure::wall_contact(tree, 0, lesion, touch);
    double largest = 0.0, length = 0.0;
    for (std::size_t i = 1; i < tree.branches[0].points.size(); ++i) {
        const tree::Point& a = tree.points[tree.branches[0].points[i - 1]];
        const tree::Point& b = tree.points[tree.branches[0].points[i]];
        const double mm = glm::distance(a.position, b.position);
        constexpr int kSections = 300;
        for (int k = 0; k < kSections; ++k) {
            const double t = (k + 0.5) / kSections;
            const double angle =
                brute_angle(lesion, glm::mix(a.position, b.position, t), (b.position - a.position) / mm,
                            glm::mix(a.radius, b.radius, t), touch, 720);
            largest = std::max(largest, angle);
            if (angle > 0.0) length += mm / kSections;
        }
    }
    CHECK(largest > 60.0);
    CHECK(found.angle_deg == doctest::Approx(largest).epsilon(0.01));
    CHECK(found.length_mm == doctest::Approx(length).epsilon(0.02));
}

TEST_CASE("each lesion is measured to each system") {
    VesselTree tree =
        test::built_tree({{{0, 0, 0}, 2}, {{0, 0, 40}, 2}, {{30, 0, 0}, 1}, {{30, 0, 40}, 1}}, {{0, 1}, {2, 3}});
    REQUIRE(tree.branches.size() == 2);
    const measure::Lesions lesions{{{8, 0, 20, 5}, {31, 0, 10, 4}}, {}};
    CHECK(measure::lesion_vessels(tree, lesions, 0.5).size() == 2); // no systems: all vessels together
    tree.systems = {{"portal", {}}, {"hepatic", {}}};
    for (tree::Branch& branch : tree.branches)
        branch.system = tree.points[branch.points.front()].position.x > 10.0 ? 1 : 0;
    const auto found = measure::lesion_vessels(tree, lesions, 0.5);
    REQUIRE(found.size() == 4);
    CHECK((found[1].lesion == 0 && found[1].system == 1 && found[2].lesion == 1 && found[2].system == 0));
    CHECK(found[0].nearest.distance_mm == doctest::Approx(1.0));
    CHECK(found[1].nearest.distance_mm == doctest::Approx(16.0));
    CHECK(found[2].nearest.distance_mm == doctest::Approx(25.0));
    CHECK(found[3].nearest.overlap_mm == doctest::Approx(4.0));
    CHECK((found[0].touched == 0 && found[0].contact.branch == tree::kNoBranch));
    CHECK(found[3].touched == 1);
    CHECK(found[3].contact.angle_deg == doctest::Approx(360.0));
    CHECK(found[3].touched_mm == doctest::Approx(found[3].contact.length_mm));
}
