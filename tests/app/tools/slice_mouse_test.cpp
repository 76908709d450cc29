// The mouse over slices: crosshair, window and level, moving and magnifying.
#include "app/tools/slice_mouse.h"

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

using namespace ramus;
using namespace ramus::app;

namespace {

SliceGrip grip() {
    return {slice::Direction::kAxial,
            slice::grid_around(slice::axes_of(slice::Direction::kAxial), {0, 0, 7}, 0.5, {200, 100}),
            {},
            slice::Window{40.0, 400.0}};
}

} // namespace

TEST_CASE("the left button moves the crosshair at once, and a press without a drag is a click") {
    SliceMouse mouse;
    const SliceChange pressed = mouse.press(MouseButton::kLeft, {}, {100.0, 50.0}, grip());
    REQUIRE(pressed.crosshair);
    CHECK(glm::distance(*pressed.crosshair, glm::dvec3(0, 0, 7)) < 1e-9); // the middle of the picture
    CHECK_FALSE(mouse.move({101.0, 50.0}).window);
    const auto click = mouse.release(MouseButton::kLeft, {101.0, 50.0});
    REQUIRE(click);
    CHECK(click->kind == Click::Kind::kSelect);
    (void)mouse.press(MouseButton::kLeft, {}, {100.0, 50.0}, grip());
    const SliceChange moved = mouse.move({120.0, 40.0}); // to the patient's left, and anterior
    CHECK(glm::distance(*moved.crosshair, glm::dvec3(-10, 5, 7)) < 1e-9);
    CHECK_FALSE(mouse.release(MouseButton::kLeft, {120.0, 40.0}));
}

TEST_CASE("the right button changes window across and level upwards") {
    SliceMouse mouse;
    (void)mouse.press(MouseButton::kRight, {}, {100.0, 50.0}, grip());
    CHECK_FALSE(mouse.move({101.0, 50.0}).window); // not a drag yet
    const auto wider = mouse.move({150.0, 50.0}).window;
    REQUIRE(wider);
    CHECK(wider->width > 400.0);
    CHECK(wider->level == 40.0);
    const auto higher = mouse.move({100.0, 20.0}).window;
    REQUIRE(higher);
    CHECK(higher->width == 400.0);
    CHECK(higher->level > 40.0);
    CHECK(mouse.windowing());
    CHECK_FALSE(mouse.release(MouseButton::kRight, {100.0, 20.0}));
    (void)mouse.press(MouseButton::kRight, {}, {100.0, 50.0}, grip());
    CHECK(mouse.release(MouseButton::kRight, {100.0, 50.0})->kind == Click::Kind::kSecondary);
}

TEST_CASE("what is under the pointer stays there when the picture is moved or magnified") {
    SliceGrip before = grip();
    SliceMouse mouse;
    (void)mouse.press(MouseButton::kMiddle, {}, {100.0, 50.0}, before);
    const auto moved = mouse.move({130.0, 60.0}).zoom;
    REQUIRE(moved);
    CHECK(moved->shift == glm::dvec2(-15.0, -5.0)); // mm along right and down
    const glm::dvec2 at(180.0, 20.0);
    const glm::dvec3 place = before.grid.place(at - 0.5);
    const SliceZoom zoom = SliceMouse::zoomed(before, at, 3.0);
    const slice::Axes axes = slice::axes_of(slice::Direction::kAxial);
    const slice::PixelGrid after =
        slice::grid_around(axes, glm::dvec3(0, 0, 7) + zoom.shift.x * axes.right + zoom.shift.y * axes.down,
                           0.5 / zoom.factor, {200, 100});
    CHECK(glm::distance(after.place(at - 0.5), place) < 1e-9);
}

TEST_CASE("the second of two presses that are close in time and place is a double click") {
    SliceMouse mouse;
    const auto click = [&](glm::dvec2 at, double seconds, Modifiers modifiers = {}) {
        const bool second = mouse.twice(MouseButton::kLeft, modifiers, at, seconds);
        if (!second) {
            (void)mouse.press(MouseButton::kLeft, modifiers, at, grip());
            (void)mouse.release(MouseButton::kLeft, at);
        }
        return second;
    };
    CHECK_FALSE(click({100.0, 50.0}, 1.0));
    CHECK(click({101.0, 50.0}, 1.2));
    CHECK_FALSE(click({101.0, 50.0}, 1.3)); // a third click begins again
    CHECK_FALSE(click({101.0, 50.0}, 2.5)); // too late
    CHECK_FALSE(click({120.0, 50.0}, 2.6)); // elsewhere
    CHECK_FALSE(click({120.0, 50.0}, 2.7, {.shift = true}));
    CHECK_FALSE(click({120.0, 50.0}, 2.8));
}
