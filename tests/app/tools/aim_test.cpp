// What a person points at: a wall before a far one, at the left of the picture.
#include "app/tools/aim.h"
#include "app/tools/viewport_mouse.h"

#include <algorithm>
#include <doctest/doctest.h>
#include <glm/geometric.hpp>

using namespace ramus;
using app::Aim;

namespace {

const glm::ivec2 kPicture(400, 300);

// Seen by an eye before two walls across the y axis: one at y = 100 left of the y axis in the picture, one at y = 0
// behind it; nothing at the right third.
render::DepthMap seen_by(const render::Camera& camera) {
    render::DepthMap map;
    map.camera = camera;
    map.picture = kPicture;
    map.size = render::DepthMap::size_for(kPicture);
    for (int y = 0; y < map.size.y; ++y)
        for (int x = 0; x < map.size.x; ++x) {
            const double near = camera.position.y - 100.0;
            const bool left = 3 * x<map.size.x, right = 3 * x> 2 * map.size.x;
            map.depths.push_back(right                ? render::DepthMap::kEmpty
                                 : left && near > 0.0 ? static_cast<float>(near)
                                                      : static_cast<float>(camera.position.y));
        }
    return map;
}

Aim looking_from(const render::Camera& camera) {
    Aim aim;
    aim.see({seen_by(camera)}, camera);
    return aim;
}

} // namespace

TEST_CASE("the aim is the point under the pointer, otherwise the visible middle") {
    const render::Camera camera; // 500 mm before the far wall
    Aim aim = looking_from(camera);
    CHECK(aim.target(camera)->on == Aim::On::kMiddle); // the pointer is nowhere
    CHECK(aim.target(camera)->at == aim.visible()->middle);
    aim.point(0, {50.0, 150.0}, 4.0);
    REQUIRE(aim.target(camera)->on == Aim::On::kPointer);
    CHECK(aim.target(camera)->at.y == doctest::Approx(100.0));
    aim.point(0, {200.0, 150.0}, 4.0);
    CHECK(aim.target(camera)->at.y == doctest::Approx(0.0));
    aim.point(0, {390.0, 150.0}, 4.0);
    CHECK(aim.target(camera)->on == Aim::On::kMiddle);
    // The wheel goes to what is nearest to it in the picture.
    CHECK(render::project(camera, kPicture, aim.goal(camera).value())->x == doctest::Approx(267.0));
    aim.point_nowhere();
    CHECK(aim.target(camera)->on == Aim::On::kMiddle);
}

TEST_CASE("depths of another view are not used, except for the point of a drag") {
    const render::Camera camera;
    Aim aim = looking_from(camera);
    aim.point(0, {50.0, 150.0}, 4.0);
    const render::Camera turned = render::turned(camera, 10.0, 0.0);
    CHECK(aim.target(turned)->on == Aim::On::kMiddle);
    const auto held = aim.target(camera)->at;
    const render::Camera nearer = render::zoomed_about(camera, held, 1.15, 1.0);
    aim.carry(nearer);
    REQUIRE(aim.target(nearer)->on == Aim::On::kPointer);
    CHECK(aim.target(nearer)->at == held);
    aim.see({seen_by(camera)}, nearer); // a late one
    CHECK(aim.target(nearer)->at == held);
    const render::Camera moved = render::panned(nearer, kPicture, held, {50.0, 150.0}, {80.0, 120.0});
    aim.carry(moved, {80.0, 120.0});
    CHECK(aim.target(moved)->at == held);
    CHECK(aim.target(nearer)->on == Aim::On::kMiddle);
}

TEST_CASE("an empty view differs from a view without a picture") {
    Aim aim;
    CHECK_FALSE(aim.sees_nothing());
    CHECK_FALSE(aim.target(render::Camera{}));
    render::DepthMap empty = seen_by(render::Camera{});
    std::ranges::fill(empty.depths, render::DepthMap::kEmpty);
    aim.see({empty}, empty.camera);
    CHECK(aim.sees_nothing());
    CHECK_FALSE(aim.goal(render::Camera{}));
}

TEST_CASE("sixty wheel notches over any place approach the surface, and never pass it") {
    for (const bool orthographic : {false, true})
        for (const double x : {50.0, 200.0, 390.0}) {
            CAPTURE(orthographic);
            CAPTURE(x);
            render::Camera camera;
            camera.orthographic = orthographic;
            Aim aim = looking_from(camera);
            aim.point(0, {x, 150.0}, 4.0);
            const double wall = aim.goal(camera)->y;
            for (int notch = 0; notch < 60; ++notch) {
                const app::Grip grip{{}, aim.goal(camera).value(), 0.5};
                const render::Camera before = camera;
                camera = app::ViewportMouse::wheel(camera, grip, 1.0);
                aim.carry(camera);
                // Pictures come when they come, some late.
                if (notch % 3 == 0) aim.see({seen_by(camera)}, camera);
                if (notch % 5 == 0) aim.see({seen_by(before)}, camera);
                REQUIRE(camera.position.y >= wall + 0.5 - 1e-6);
            }
            const double mm = render::mm_per_pixel_at(camera, kPicture, camera.position.y - wall);
            CHECK(mm == doctest::Approx(0.5 * render::mm_per_pixel_at(render::Camera{}, kPicture, 1.0)).epsilon(1e-3));
        }
}

TEST_CASE("the camera stays a quarter of the radius away from vessels, and less from other objects") {
    tree::VesselTree tree;
    tree.points = {{{0, 0, 0}, 4.0}, {{0, 0, 10}, 2.0}};
    tree.branches.resize(1);
    tree.branches[0].points = {0, 1};
    CHECK(app::least_distance_mm(&tree, 0, {4, 0, 1}, 100.0) == doctest::Approx(1.0));
    CHECK(app::least_distance_mm(&tree, 0, {2, 0, 9}, 100.0) == doctest::Approx(0.5));
    // On a vessel, of which it is not known yet on which: of its radius there.
    CHECK(app::least_distance_mm(&tree, tree::kNoBranch, {2.2, 0, 9}, 100.0) == doctest::Approx(0.25 * 2.2));
    CHECK(app::least_distance_mm(&tree, tree::kNoBranch, {20, 0, 5}, 100.0) == doctest::Approx(0.1));
    CHECK(app::least_distance_mm(nullptr, 0, {2, 0, 9}, 100.0) == doctest::Approx(0.1));
}
