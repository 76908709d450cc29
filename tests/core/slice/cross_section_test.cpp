// Sections across vessels against those of analytic shapes; calipers against brute force.
#include "core/slice/cross_section.h"
#include "core/slice/mask_loops.h"
#include "tests/core/slice/swept_tube.h"
#include "tests/support/mask.h"

#include <algorithm>
#include <doctest/doctest.h>
#include <random>

using namespace ramus;

namespace {

std::optional<slice::Lumen> lumen_at(const mesh::TriangleMesh& mesh, const slice::Plane& plane) {
    return slice::lumen_around(slice::section(mesh, plane), plane, plane.point);
}

slice::Plane plane_at(const glm::dvec3& at, const glm::dvec3& normal) { return {at, glm::normalize(normal)}; }

} // namespace

TEST_CASE("calipers are the least and largest widths over all directions") {
    std::mt19937 random(3);
    std::normal_distribution<double> number;
    for (int repeat = 0; repeat < 30; ++repeat) {
        slice::Outline points;
        for (int n = 0; n < 3 + repeat * 4; ++n) points.emplace_back(4.0 * number(random), number(random));
        const slice::Calipers calipers = slice::calipers_of(slice::convex_hull(points));
        double least = 1e9, largest = 0.0;
        constexpr int kDirections = 20'000;
        for (int k = 0; k < kDirections; ++k) {
            const double angle = test::kPi * k / kDirections;
            double low = 1e9, high = -1e9;
            for (const auto& point : points) {
                const double along = point.x * std::cos(angle) + point.y * std::sin(angle);
                low = std::min(low, along), high = std::max(high, along);
            }
            least = std::min(least, high - low), largest = std::max(largest, high - low);
        }
        CHECK(calipers.least == doctest::Approx(least).epsilon(2e-3));
        CHECK(calipers.least <= least + 1e-9);
        CHECK(calipers.largest == doctest::Approx(largest).epsilon(1e-6));
        CHECK(calipers.largest >= largest - 1e-9);
    }
}

TEST_CASE("sections of cylinders and elliptic tubes, up to 45 degrees aslant, are ellipses of known figures") {
    const glm::dvec3 a(3, -4, 5), b(43, 20, 35);
    const glm::dvec3 axis = glm::normalize(b - a);
    for (const glm::dvec2 half : {glm::dvec2(2.5), glm::dvec2(3.0, 1.2)}) {
        const auto tube = test::straight_tube(a, b, half);
        const glm::dvec3 side = glm::normalize(glm::cross(axis, glm::dvec3(0, 0, 1)));
        for (const double slant : {0.0, 20.0, 45.0}) {
            // Turned about `side`: that half axis stays, the other becomes longer.
            const double cosine = std::cos(slant * test::kPi / 180.0), sine = std::sin(slant * test::kPi / 180.0);
            const glm::dvec3 middle = 0.5 * (a + b);
            const auto lumen = lumen_at(tube, plane_at(middle, cosine * axis + sine * glm::cross(axis, side)));
            REQUIRE(lumen);
            CHECK(lumen->closed);
            const double x = 2.0 * half.x, y = 2.0 * half.y / cosine;
            CHECK(lumen->figures.area_mm2 == doctest::Approx(test::kPi / 4.0 * x * y).epsilon(0.01));
            CHECK(lumen->figures.equivalent_mm == doctest::Approx(std::sqrt(x * y)).epsilon(0.01));
            CHECK(lumen->figures.least_mm == doctest::Approx(std::min(x, y)).epsilon(0.01));
            CHECK(lumen->figures.largest_mm == doctest::Approx(std::max(x, y)).epsilon(0.01));
            CHECK(glm::distance(lumen->figures.centroid, middle) < 0.01);
        }
    }
}

TEST_CASE("sections along a bent vessel are discs, and other parts of the surface do not count") {
    // Three quarters of a torus: a plane across it cuts it twice.
    constexpr double kRound = 25.0, kTube = 4.0, kWay = 1.5 * test::kPi;
    const auto on_axis = [](double t) { return kRound * glm::dvec3(std::cos(kWay * t), std::sin(kWay * t), 0.0); };
    const auto torus = test::swept_tube(
        [&](double t, double angle) {
            return on_axis(t) + kTube * (std::cos(angle) * glm::normalize(on_axis(t)) -
                                         std::sin(angle) * glm::dvec3(0, 0, -1) * -1.0);
        },
        400, 128);
    const auto tree = test::vessel_of(on_axis, 2000, kTube);
    const auto path = slice::path_of_branch(tree, 0, 0.5);
    REQUIRE(path);
    const slice::MeshBlocks blocks(torus);
    const auto lumens = slice::lumens_along(
        path->samples, [&](const slice::Plane& plane) { return slice::section(blocks, plane); },
        slice::OtherBranches(tree, *path));
    REQUIRE(lumens.size() == path->samples.size());
    for (std::size_t n = 0; n < lumens.size(); ++n) {
        const double arc = path->samples[n].arc_mm;
        if (arc < 2.0 * kTube || arc > path->length_mm() - 2.0 * kTube) continue;
        REQUIRE(lumens[n]);
        CHECK(lumens[n]->figures.area_mm2 == doctest::Approx(test::kPi * kTube * kTube).epsilon(0.01));
        CHECK(lumens[n]->figures.least_mm == doctest::Approx(2.0 * kTube).epsilon(0.01));
        CHECK(lumens[n]->figures.largest_mm == doctest::Approx(2.0 * kTube).epsilon(0.01));
        CHECK(lumens[n]->shared_with.empty());
        CHECK(glm::distance(lumens[n]->figures.centroid, path->samples[n].at) < 0.05);
    }
}

TEST_CASE("the lumen is the innermost loop with its holes, and none where the axis is outside") {
    auto mesh = test::straight_tube({0, 0, -20}, {0, 0, 20}, glm::dvec2(8.0));
    auto hole = test::straight_tube({4, 0, -19}, {4, 0, 19}, glm::dvec2(2.0));
    for (auto& triangle : hole.triangles) std::swap(triangle.x, triangle.y);
    test::join(mesh, hole);
    test::join(mesh, test::straight_tube({20, 0, -20}, {20, 0, 20}, glm::dvec2(3.0)));
    const auto lumen = lumen_at(mesh, plane_at({-2, 0, 0}, {0, 0, 1}));
    REQUIRE(lumen);
    CHECK(lumen->loops.size() == 2);
    CHECK(lumen->figures.area_mm2 == doctest::Approx(test::kPi * (64.0 - 4.0)).epsilon(0.002));
    CHECK(lumen->figures.least_mm == doctest::Approx(16.0).epsilon(0.002));
    CHECK(lumen->figures.centroid.x == doctest::Approx(-4.0 * 4.0 / 60.0).epsilon(0.01));
    CHECK_FALSE(lumen_at(mesh, plane_at({4, 0, 0}, {0, 0, 1})));  // in the hole
    CHECK_FALSE(lumen_at(mesh, plane_at({12, 0, 0}, {0, 0, 1}))); // between the vessels
    CHECK(lumen_at(mesh, plane_at({20, 0, 0}, {0, 0, -1}))->figures.least_mm == doctest::Approx(6.0).epsilon(0.002));
    // Without one triangle the section there is open, and says so.
    auto open = test::straight_tube({0, 0, -20}, {0, 0, 20}, glm::dvec2(8.0));
    const auto crosses = [&](const glm::uvec3& triangle) {
        const float z[3]{open.positions[triangle.x].z, open.positions[triangle.y].z, open.positions[triangle.z].z};
        return std::min({z[0], z[1], z[2]}) < 0.1F && std::max({z[0], z[1], z[2]}) > 0.1F;
    };
    open.triangles.erase(std::ranges::find_if(open.triangles, crosses));
    const auto at_gap = lumen_at(open, plane_at({0, 0, 0.1}, {0, 0, 1}));
    REQUIRE(at_gap);
    CHECK_FALSE(at_gap->closed);
    CHECK(at_gap->figures.area_mm2 == doctest::Approx(test::kPi * 64.0).epsilon(0.002));
}

TEST_CASE("at a fork the section says which branches share it") {
    const auto tree = test::built_tree({{{0, 0, -30}, 5.0}, {{0, 0, 0}, 5.0}, {{12, 0, 30}, 3.0}, {{-12, 0, 30}, 3.0}},
                                       {{0, 1}, {1, 2}, {1, 3}});
    const auto path = slice::path_from_root(tree, 1, 0.5);
    REQUIRE(path);
    const auto mesh =
        test::straight_tube({0, 0, -40}, {0, 0, 40}, glm::dvec2(4.5)); // wide enough for both near the fork
    const auto lumens = slice::lumens_along(
        path->samples, [&](const slice::Plane& plane) { return slice::section(mesh, plane); },
        slice::OtherBranches(tree, *path));
    const auto shared_at = [&](double arc) { return lumens[path->nearest(arc)]->shared_with; };
    CHECK(shared_at(20.0).empty());
    CHECK(shared_at(34.0) == std::vector<int>{2});
}

TEST_CASE("sections of masks have the areas of their discs, with holes, aslant and in anisotropic voxels") {
    for (const glm::dvec3 spacing : {glm::dvec3(0.7), glm::dvec3(0.6, 0.6, 1.0)}) {
        const glm::ivec3 size(110, 110, 90);
        const glm::dmat4 to_patient = test::voxels_of(spacing);
        const glm::dvec3 middle = 0.5 * spacing * glm::dvec3(size);
        const glm::dvec3 axis = glm::normalize(glm::dvec3(0.31, -0.2, 1.0));
        const auto distance = [&](const glm::dvec3& at) {
            return glm::length(at - middle - glm::dot(at - middle, axis) * axis);
        };
        constexpr double kRadius = 11.0, kInner = 4.0;
        const auto disc =
            test::mask_of(size, [&](const glm::ivec3& v) { return distance(spacing * glm::dvec3(v)) < kRadius; });
        const auto ring = test::mask_of(size, [&](const glm::ivec3& v) {
            const double r = distance(spacing * glm::dvec3(v));
            return r < kRadius && r > kInner;
        });
        const glm::dvec3 side = glm::normalize(glm::cross(axis, glm::dvec3(1, 0, 0)));
        for (const double slant : {0.0, 45.0})
            for (const double half : {1.0, 40.0}) { // the window grows as needed
                const double cosine = std::cos(slant * test::kPi / 180.0);
                const auto plane =
                    plane_at(middle + 0.1 * side, cosine * axis + std::sin(slant * test::kPi / 180.0) * side);
                const auto lumen = slice::lumen_around(slice::mask_loops(disc, to_patient, plane, plane.point, half),
                                                       plane, plane.point);
                REQUIRE(lumen);
                CHECK(lumen->closed);
                const double exact = test::kPi * kRadius * kRadius / cosine;
                CHECK(lumen->figures.area_mm2 == doctest::Approx(exact).epsilon(0.01));
                CHECK(lumen->figures.least_mm == doctest::Approx(2.0 * kRadius).epsilon(0.03)); // half a voxel is 3 %
                const auto off = plane_at(middle + 0.5 * (kRadius + kInner) * side, plane.normal);
                const auto with_hole =
                    slice::lumen_around(slice::mask_loops(ring, to_patient, off, off.point, half), off, off.point);
                REQUIRE(with_hole);
                CHECK(with_hole->loops.size() == 2);
                CHECK(with_hole->figures.area_mm2 ==
                      doctest::Approx(exact - test::kPi * kInner * kInner / cosine).epsilon(0.01));
            }
        CHECK(slice::mask_loops(ring, to_patient, plane_at(middle, axis), middle, 10.0).empty());
    }
}

TEST_CASE("the area of a mask's section is that of the trilinear mask above a half, by brute force") {
    const glm::ivec3 size(30, 30, 30);
    const glm::dvec3 spacing(0.6, 0.7, 0.9);
    const glm::dvec3 middle = 0.5 * spacing * glm::dvec3(size);
    const auto ball =
        test::mask_of(size, [&](const glm::ivec3& v) { return glm::distance(spacing * glm::dvec3(v), middle) < 3.2; });
    const auto value_at = [&](const glm::dvec3& index) {
        double sum = 0.0;
        const glm::ivec3 low(glm::floor(index));
        for (int k = 0; k < 2; ++k)
            for (int j = 0; j < 2; ++j)
                for (int i = 0; i < 2; ++i) {
                    const glm::dvec3 off = glm::abs(index - glm::dvec3(low + glm::ivec3(i, j, k)));
                    if (ball.test(low + glm::ivec3(i, j, k))) sum += (1.0 - off.x) * (1.0 - off.y) * (1.0 - off.z);
                }
        return sum;
    };
    for (const glm::dvec3 normal : {glm::dvec3(0, 0, 1), glm::dvec3(1, 2, 3), glm::dvec3(-1, 1, 0.2)}) {
        const auto plane = plane_at(middle, normal);
        const glm::dvec3 u = glm::normalize(glm::cross(plane.normal, glm::dvec3(0.2, 1, 0.1)));
        const glm::dvec3 v = glm::cross(plane.normal, u);
        constexpr double kStep = 0.02;
        double area = 0.0;
        for (double y = -4.5; y < 4.5; y += kStep)
            for (double x = -4.5; x < 4.5; x += kStep)
                if (value_at((middle + x * u + y * v) / spacing) > 0.5) area += kStep * kStep;
        const auto lumen =
            slice::lumen_around(slice::mask_loops(ball, test::voxels_of(spacing), plane, middle, 3.0), plane, middle);
        REQUIRE(lumen);
        CHECK(lumen->figures.area_mm2 == doctest::Approx(area).epsilon(0.01));
    }
}
