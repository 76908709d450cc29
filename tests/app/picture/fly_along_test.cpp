// Flying along the vessels is smooth and keeps the vessel in sight.
#include "app/picture/fly_along.h"
#include "app/session/branch_facts.h"
#include "tests/support/grown_tree.h"

#include <algorithm>
#include <cmath>
#include <doctest/doctest.h>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

using namespace ramus;
using namespace ramus::app;

namespace {

tree::VesselTree line(const std::vector<glm::dvec3>& positions, double radius) {
    tree::VesselTree tree;
    tree.branches.emplace_back();
    for (std::size_t i = 0; i < positions.size(); ++i) {
        tree.points.push_back({positions[i], radius});
        tree.branches[0].points.push_back(static_cast<std::uint32_t>(i));
    }
    tree.roots = {0};
    return tree;
}

double degrees_between(const glm::dvec3& a, const glm::dvec3& b) {
    return glm::degrees(std::acos(std::clamp(glm::dot(glm::normalize(a), glm::normalize(b)), -1.0, 1.0)));
}

// Steps of a thousandth: place and direction move a little, never at once; the vessel stays in the picture.
void check_flight(const tree::VesselTree& tree, int end) {
    const FlyPath path(tree, end);
    const render::Camera like;
    constexpr int kSteps = 1000;
    const glm::ivec2 size(800, 600);
    render::Camera before = path.camera_at(0.0, like);
    for (int i = 1; i <= kSteps; ++i) {
        const double fraction = static_cast<double>(i) / kSteps;
        const render::Camera camera = path.camera_at(fraction, like);
        const double step = path.length_mm() / kSteps;
        CHECK(glm::distance(camera.position, before.position) <
              3.0 * step + glm::radians(3.0) * path.distance_at(fraction));
        CHECK(degrees_between(camera.focal_point - camera.position, before.focal_point - before.position) < 2.0);
        CHECK(degrees_between(camera.view_up, before.view_up) < 2.0);
        CHECK(glm::distance(camera.position, camera.focal_point) == doctest::Approx(path.distance_at(fraction)));
        const auto seen = render::project(camera, size, path.point_at(fraction));
        REQUIRE(seen);
        CHECK(seen->x > 0.0);
        CHECK(seen->x < size.x);
        CHECK(seen->y > 0.0);
        CHECK(seen->y < size.y);
        before = camera;
    }
}

} // namespace

TEST_CASE("on a flight along a straight vessel the camera stays behind and above, and looks ahead") {
    std::vector<glm::dvec3> positions;
    for (int i = 0; i <= 20; ++i) positions.emplace_back(0.0, 0.0, -5.0 * i);
    const tree::VesselTree tree = line(positions, 1.0);
    const FlyPath path(tree, 0);
    CHECK(path.length_mm() == doctest::Approx(100.0));
    for (const double fraction : {0.0, 0.25, 0.5, 0.75, 1.0}) {
        const render::Camera camera = path.camera_at(fraction, {});
        const glm::dvec3 here(0.0, 0.0, -100.0 * fraction);
        CHECK(glm::distance(path.point_at(fraction), here) < 1e-6);
        CHECK(camera.position.z > here.z);                 // behind
        CHECK(camera.position.y > 1.0);                    // above: in front of the patient
        CHECK(std::abs(camera.position.x) < 1e-6);         // not beside
        CHECK(camera.focal_point.z < here.z + 1e-9);       // looks ahead
        CHECK(glm::distance(camera.position, here) > 2.0); // outside
        const double away = path.distance_at(fraction);
        CHECK(away > 4.0);
        CHECK(away < 30.0);
    }
}

TEST_CASE("a flight is smooth through every bend" * doctest::test_suite("slow")) {
    check_flight(line({{0, 0, 0}, {0, 0, -60}}, 2.0), 0);
    check_flight(line({{0, 0, 0}, {0, 0, -40}, {40, 0, -40}, {40, 40, -40}, {40, 40, -80}}, 1.0), 0); // right angles
    check_flight(line({{0, 0, 0}, {0, 0, -30}, {3, 0, -60}, {6, 0, -28}}, 0.5), 0);                   // nearly back
    std::vector<glm::dvec3> coil;
    for (int i = 0; i < 200; ++i) coil.emplace_back(12.0 * std::cos(0.15 * i), 12.0 * std::sin(0.15 * i), -0.6 * i);
    check_flight(line(coil, 1.5), 0);
    auto grown = test::grown_tree(600);
    REQUIRE(grown);
    const TreeFacts facts = facts_of(*grown);
    int flights = 0;
    for (int id = 0; id < static_cast<int>(grown->branches.size()); id += 37) {
        if (facts.branches[static_cast<std::size_t>(id)].dependents.branches > 0) continue;
        check_flight(*grown, id);
        ++flights;
    }
    CHECK(flights > 3);
}

TEST_CASE("the speed of a flight does not depend on the frame rate") {
    auto grown = test::grown_tree(200);
    REQUIRE(grown);
    const FlyPath path(*grown, static_cast<int>(grown->branches.size()) - 1);
    CHECK(path.duration() >= 4.0);
    CHECK(path.duration() <= 40.0);
    double by_frames = 0.0;
    for (int i = 0; i < 120; ++i) by_frames = path.after(by_frames, 1.0 / 60.0);
    double uneven = 0.0;
    for (const double seconds : {0.5, 0.01, 0.99, 0.25, 0.25}) uneven = path.after(uneven, seconds);
    CHECK(by_frames == doctest::Approx(path.after(0.0, 2.0)).epsilon(1e-9));
    CHECK(uneven == doctest::Approx(by_frames).epsilon(1e-9));
    CHECK(path.after(by_frames, -2.0) == doctest::Approx(0.0));
    CHECK(path.after(0.0, path.duration()) == doctest::Approx(1.0));
    CHECK(path.after(0.3, 1e9) == 1.0);
    double last = 0.0;
    for (double fraction = path.after(0.0, 0.1); last < 1.0; fraction = path.after(fraction, 0.1)) {
        CHECK(fraction > last);
        last = fraction;
    }
}

TEST_CASE("the camera keeps its projection while it flies") {
    const tree::VesselTree tree = line({{0, 0, 0}, {0, 0, -60}}, 2.0);
    const FlyPath path(tree, 0);
    render::Camera like;
    like.orthographic = true;
    like.view_angle = 40.0;
    const render::Camera camera = path.camera_at(0.5, like);
    CHECK(camera.orthographic);
    CHECK(camera.view_angle == 40.0);
    CHECK(camera.scale == doctest::Approx(path.distance_at(0.5) * std::tan(glm::radians(20.0))));
}

TEST_CASE("a flight inside never leaves the vessels, and looks ahead") {
    const auto made = test::grown_tree(120);
    REQUIRE(made);
    const tree::VesselTree& tree = *made;
    // How far from the nearest axis, in radii there: all segments, no shortcut.
    const auto radii_off = [&](const glm::dvec3& eye) {
        double least = 1e300;
        for (const tree::Branch& branch : tree.branches)
            for (std::size_t i = 1; i < branch.points.size(); ++i) {
                const tree::Point &a = tree.points[branch.points[i - 1]], &b = tree.points[branch.points[i]];
                const glm::dvec3 along = b.position - a.position;
                const double t =
                    std::clamp(glm::dot(eye - a.position, along) / std::max(glm::dot(along, along), 1e-30), 0.0, 1.0);
                const double away = glm::distance(eye, a.position + t * along);
                least = std::min(least, away / (a.radius + t * (b.radius - a.radius)));
            }
        return least;
    };
    render::Camera like;
    like.orthographic = true;
    for (const int end : {40, 77, 119}) {
        const FlyPath path(tree, end, Flight::kInside);
        glm::dvec3 before(0.0);
        for (int i = 0; i <= 200; ++i) {
            const render::Camera camera = path.camera_at(i / 200.0, like);
            CHECK(camera.inside);
            CHECK_FALSE(camera.orthographic);
            CHECK(radii_off(camera.position) < 0.75);
            const glm::dvec3 ahead = glm::normalize(camera.focal_point - camera.position);
            if (i > 0) CHECK(glm::dot(ahead, before) > 0.9); // of two hundred looks each is near the one before
            before = ahead;
        }
    }
    // Outside again, the usual angle is back.
    const render::Camera out = FlyPath(tree, 40).camera_at(0.5, FlyPath(tree, 40, Flight::kInside).camera_at(0.5, {}));
    CHECK_FALSE(out.inside);
    CHECK(out.view_angle == render::Camera().view_angle);
}
