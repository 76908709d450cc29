#include "app/tools/viewport_mouse.h"

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

using namespace ramus;
using namespace ramus::app;

namespace {
const glm::ivec2 kSize{400, 300};
const Grip kGrip = Grip::at({0.0, 0.0, 0.0}); // the focal point of a camera by default
} // namespace

TEST_CASE("a press and a release in one place are a click, whose meaning depends on the modifiers") {
    const auto click = [](Modifiers modifiers) {
        ViewportMouse mouse;
        mouse.press(MouseButton::kLeft, modifiers, {50, 60}, kGrip);
        return mouse.release(MouseButton::kLeft, {51, 60}, 10.0);
    };
    REQUIRE(click({}));
    CHECK(click({})->kind == Click::Kind::kSelect);
    CHECK(click({})->at == glm::dvec2(51, 60));
    CHECK(click({.alt = true})->kind == Click::Kind::kSelectWithDependents);
    CHECK(click({.ctrl = true})->kind == Click::Kind::kToggle);
    CHECK(click({.shift = true})->kind == Click::Kind::kAdd);
}

TEST_CASE("a drag moves the camera and is not a click; a tiny movement is a click and moves nothing") {
    const render::Camera camera;
    ViewportMouse mouse;
    mouse.press(MouseButton::kLeft, {}, {50, 60}, kGrip);
    CHECK_FALSE(mouse.move(camera, kSize, {53, 60}));
    CHECK_FALSE(mouse.dragging());
    const auto turned = mouse.move(camera, kSize, {70, 60});
    REQUIRE(turned);
    CHECK(mouse.dragging());
    CHECK(glm::distance(turned->focal_point, camera.focal_point) < 1e-9);
    CHECK(glm::distance(turned->position, turned->focal_point) == doctest::Approx(500.0));
    CHECK_FALSE(mouse.release(MouseButton::kLeft, {50, 60}, 1.0)); // back where it began: still a drag
    CHECK_FALSE(mouse.held());

    mouse.set_pixel_ratio(2.0);
    mouse.press(MouseButton::kLeft, {}, {50, 60}, kGrip);
    CHECK_FALSE(mouse.move(camera, kSize, {57, 60})); // 3.5 points
    CHECK(mouse.release(MouseButton::kLeft, {57, 60}, 5.0));
}

TEST_CASE("mouse buttons have the same functions as in 3D Slicer") {
    const render::Camera camera;
    const auto drag = [&](MouseButton button, Modifiers modifiers) {
        ViewportMouse mouse;
        mouse.press(button, modifiers, {200, 150}, kGrip);
        return mouse.move(camera, kSize, {220, 120}).value();
    };
    const auto direction = [](const render::Camera& c) { return glm::normalize(c.focal_point - c.position); };
    CHECK(direction(drag(MouseButton::kLeft, {})) != direction(camera));
    for (const render::Camera& panned : {drag(MouseButton::kMiddle, {}), drag(MouseButton::kLeft, {.shift = true})}) {
        CHECK(glm::distance(direction(panned), direction(camera)) < 1e-12);
        CHECK(panned.focal_point != camera.focal_point);
    }
    const render::Camera nearer = drag(MouseButton::kRight, {}); // upward
    CHECK(glm::distance(nearer.focal_point, camera.focal_point) < 1e-9);
    CHECK(glm::distance(nearer.position, nearer.focal_point) < 500.0);
    CHECK(glm::distance(ViewportMouse::wheel(camera, kGrip, 1.0).position, camera.focal_point) < 500.0);
}

TEST_CASE("a double click centres, and a third click starts a new sequence") {
    ViewportMouse mouse;
    const auto click = [&](double seconds, glm::dvec2 at) {
        mouse.press(MouseButton::kLeft, {}, at, kGrip);
        return mouse.release(MouseButton::kLeft, at, seconds)->kind;
    };
    CHECK(click(1.0, {50, 60}) == Click::Kind::kSelect);
    CHECK(click(1.2, {51, 60}) == Click::Kind::kCentre);
    CHECK(click(1.4, {50, 60}) == Click::Kind::kSelect);
    CHECK(click(3.0, {50, 60}) == Click::Kind::kSelect); // too slow
    CHECK(click(3.2, {90, 60}) == Click::Kind::kSelect); // elsewhere
}

TEST_CASE("a click with a modifier key is never part of a double click") {
    ViewportMouse mouse;
    const auto click = [&](double seconds, Modifiers modifiers) {
        mouse.press(MouseButton::kLeft, modifiers, {50, 60}, kGrip);
        return mouse.release(MouseButton::kLeft, {50, 60}, seconds)->kind;
    };
    CHECK(click(1.0, {}) == Click::Kind::kSelect);
    CHECK(click(1.1, {.alt = true}) == Click::Kind::kSelectWithDependents);
    CHECK(click(1.2, {.ctrl = true}) == Click::Kind::kToggle);
    CHECK(click(1.3, {}) == Click::Kind::kSelect);
    CHECK(click(1.4, {}) == Click::Kind::kCentre);
}

TEST_CASE("while one button is held, other buttons do nothing") {
    ViewportMouse mouse;
    mouse.press(MouseButton::kLeft, {}, {50, 60}, kGrip);
    mouse.press(MouseButton::kRight, {}, {50, 60}, kGrip);
    CHECK_FALSE(mouse.release(MouseButton::kRight, {50, 60}, 1.0));
    CHECK(mouse.held());
    CHECK(mouse.release(MouseButton::kLeft, {50, 60}, 1.0));
}
