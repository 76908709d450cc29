// What the mouse makes of a camera: what is pointed at stays where it is in the picture.
#include "render/scene/camera_moves.h"
#include "tests/support/aslant_camera.h"

#include <cmath>
#include <doctest/doctest.h>
#include <glm/geometric.hpp>
#include <limits>

using namespace ramus::render;

namespace {

const glm::ivec2 kView(800, 600);

double apart(const Camera& camera, const glm::dvec3& point, glm::dvec2 pixel) {
    const auto at = project(camera, kView, point);
    return at ? glm::distance(glm::dvec2(*at), pixel) : std::numeric_limits<double>::infinity();
}

} // namespace

TEST_CASE("what is under the pointer stays under it while zooming and panning, at every depth") {
    for (const bool orthographic : {false, true})
        for (const double depth : {40.0, 380.0, 900.0}) {
            CAPTURE(orthographic);
            CAPTURE(depth);
            Camera camera = ramus::test::aslant_camera(orthographic);
            glm::dvec2 pixel(130, 520);
            const glm::dvec3 held = unproject(camera, kView, pixel, depth);
            for (int i = 0; i < 40; ++i) {
                const glm::dvec2 to = pixel + glm::dvec2(11.0 * std::cos(i), 7.0 * std::sin(2 * i));
                camera = panned(camera, kView, held, pixel, to);
                pixel = to;
                CHECK(apart(camera, held, pixel) < 1e-6);
                camera = zoomed_about(camera, held, i % 3 == 0 ? 0.8 : 1.15, 1e-3);
                CHECK(apart(camera, held, pixel) < 1e-6);
            }
            // What is reckoned at the focal point holds for what is pointed at.
            CHECK(mm_per_pixel(camera, kView) ==
                  doctest::Approx(mm_per_pixel_at(camera, kView, depth_of(camera, held))));
        }
}

TEST_CASE("sixty notches of the wheel end before the surface, however it is looked at") {
    for (const bool orthographic : {false, true}) {
        const Camera start = ramus::test::aslant_camera(orthographic);
        const glm::dvec2 pixel(640, 90);
        const glm::dvec3 wall = unproject(start, kView, pixel, 200.0);
        constexpr double kLeast = 0.25;
        Camera camera = start;
        double before = std::numeric_limits<double>::infinity();
        for (int notch = 0; notch < 60; ++notch) {
            camera = zoomed_about(camera, wall, 1.15, kLeast);
            // 200 mm are 0.25 mm after 48 notches: 1.15^48 = 820.
            const double mm = mm_per_pixel_at(camera, kView, depth_of(camera, wall));
            CHECK((notch < 47 ? mm < 0.95 * before : mm <= before));
            before = mm;
            CHECK(depth_of(camera, wall) > 0.0);
        }
        const double half = std::tan(0.5 * 30.0 * std::acos(-1.0) / 180.0);
        CHECK(before == doctest::Approx(2.0 * kLeast * half / kView.y));
        CHECK(apart(camera, wall, pixel) < 1e-6);
        // And back, as many notches as it had come.
        for (int notch = 0; notch < 48; ++notch) camera = zoomed_about(camera, wall, 1.0 / 1.15, kLeast);
        CHECK(mm_per_pixel_at(camera, kView, depth_of(camera, wall)) ==
              doctest::Approx(0.25 * std::pow(1.15, 48) * 2.0 * half / kView.y));
    }
}

TEST_CASE("nearer than the limit already: in changes nothing, out goes") {
    const Camera camera = ramus::test::aslant_camera();
    const glm::dvec3 wall = unproject(camera, kView, {400, 300}, 0.1);
    CHECK(zoomed_about(camera, wall, 1.15, 0.25) == camera);
    CHECK(depth_of(zoomed_about(camera, wall, 1.0 / 1.15, 0.25), wall) == doctest::Approx(0.115));
    // What cannot be come nearer to, and what is no factor, changes nothing.
    const glm::dvec3 behind = unproject(camera, kView, {400, 300}, -5.0);
    CHECK(zoomed_about(camera, behind, 1.15, 0.25) == camera);
    CHECK(zoomed_about(camera, wall, 0.0, 0.25) == camera);
    CHECK(zoomed_about(camera, wall, -1.0, 0.25) == camera);
    CHECK(zoomed_about(camera, wall, std::numeric_limits<double>::quiet_NaN(), 0.25) == camera);
    Camera away = camera;
    for (int i = 0; i < 2000; ++i) away = zoomed_about(away, wall, 0.5, 0.25);
    CHECK(std::isfinite(glm::distance(away.position, wall)));
    CHECK(glm::distance(away.position, wall) < 1e9);
}

TEST_CASE("the view turns about the point that is held, which stays where it is on the screen") {
    for (const bool orthographic : {false, true}) {
        Camera camera = ramus::test::aslant_camera(orthographic);
        const glm::dvec2 pixel(610, 140);
        const double depth = 260.0;
        const glm::dvec3 held = unproject(camera, kView, pixel, depth);
        for (int i = 0; i < 500; ++i) {
            camera = rotated(camera, kView, held, {400, 300}, {417, 289});
            REQUIRE(apart(camera, held, pixel) < 1e-6);
        }
        CHECK(depth_of(camera, held) == doctest::Approx(depth));
        const CameraAxes axes = axes_of(camera);
        CHECK(glm::dot(axes.up, axes.forward) == doctest::Approx(0.0));
        CHECK(glm::distance(axes.up, camera.view_up) < 1e-9);
        CHECK(camera.scale == ramus::test::aslant_camera().scale);
    }
}

TEST_CASE("dragging to the right turns the front of the tree to the right, dragging down turns it down") {
    const Camera camera = looking(Camera{}, View::kAnterior);
    // A point on the side of the focal point that faces the viewer.
    const glm::dvec3 front = camera.focal_point + glm::dvec3(0, 10, 0);
    const auto moved = [&](glm::dvec2 to) {
        return *project(rotated(camera, kView, camera.focal_point, {400, 300}, to), kView, front);
    };
    CHECK(moved({440, 300}).x > 401.0);
    CHECK(moved({440, 300}).y == doctest::Approx(300.0));
    CHECK(moved({400, 330}).y > 301.0);
    CHECK(moved({400, 330}).x == doctest::Approx(400.0));
    // A whole turn of 360 degrees comes back.
    const Camera around = rotated(camera, kView, camera.focal_point, {0, 0}, {800.0 * 360.0 / 200.0, 0});
    CHECK(glm::distance(around.position, camera.position) < 1e-6);
    CHECK(zoom_of_drag(kView, {0, 300}, {0, 200}) > 1.0);
    CHECK(zoom_of_drag(kView, {0, 300}, {0, 400}) < 1.0);
}
