// Vessels stay in view when their part of the picture gets another shape.
#include "app/picture/framing.h"

#include <algorithm>
#include <doctest/doctest.h>
#include <glm/geometric.hpp>

using namespace ramus;
using namespace ramus::app;

namespace {

// A cross in the plane of the picture of a viewer in front, with points nearer and farther.
const std::vector<glm::vec3> kCross{{-60, 0, 0}, {60, 0, 0}, {0, 0, 30}, {0, 0, -30}, {-50, 40, 0}, {50, -40, 5}};

bool all_inside(const render::Camera& camera, glm::ivec2 size) {
    return std::ranges::all_of(kCross, [&](const glm::vec3& point) {
        const auto at = render::project(camera, size, point);
        return at && at->x >= 0.0 && at->y >= 0.0 && at->x <= size.x && at->y <= size.y;
    });
}

render::Camera whole(glm::ivec2 size, bool orthographic) {
    return render::camera_for(kCross, render::View::kAnterior, size, orthographic);
}

} // namespace

TEST_CASE("a narrower part of the picture shows what the wider one showed, from the same direction") {
    constexpr glm::ivec2 kWide(1200, 600), kNarrow(500, 600);
    for (const bool orthographic : {false, true}) {
        CAPTURE(orthographic);
        const render::Camera camera = whole(kWide, orthographic);
        REQUIRE(all_inside(camera, kWide));
        REQUIRE_FALSE(all_inside(camera, kNarrow));
        const render::Camera narrow = reframed(camera, kWide, kNarrow, kCross);
        CHECK(all_inside(narrow, kNarrow));
        CHECK(glm::distance(render::axes_of(narrow).forward, render::axes_of(camera).forward) < 1e-12);
        CHECK(narrow.focal_point == camera.focal_point);
        // And no farther away than needed.
        const double before = render::mm_per_pixel(camera, kWide);
        CHECK(render::mm_per_pixel(narrow, kNarrow) < 1.1 * before * 1200.0 / 500.0);
        // A part of the same shape, or a wider one, needs nothing.
        CHECK(reframed(camera, kWide, kWide / 2, kCross) == camera);
        CHECK(reframed(narrow, kNarrow, kWide, kCross) == narrow);
    }
}

TEST_CASE("vessels that are narrower than the picture do not become smaller") {
    const std::vector<glm::vec3> upright{{-5, 0, -60}, {5, 0, 60}, {0, 5, 0}};
    const render::Camera camera = render::camera_for(upright, render::View::kAnterior, {1200, 600});
    CHECK(reframed(camera, {1200, 600}, {500, 600}, upright) == camera);
}

TEST_CASE("a view of a part of the vessels keeps all of its width") {
    const render::Camera near = render::zoomed(whole({1200, 600}, true), 8.0);
    const render::Camera narrow = reframed(near, {1200, 600}, {600, 600}, kCross);
    CHECK(narrow.scale == doctest::Approx(2.0 * near.scale));
    CHECK(narrow.focal_point == near.focal_point);
    CHECK(reframed(near, {1200, 600}, {600, 600}, {}) == narrow);
}

TEST_CASE("the earlier view returns with the earlier shape, unless somebody has moved the camera") {
    constexpr glm::ivec2 kWide(1200, 600), kHalf(600, 600), kThird(400, 600);
    const auto points = [](const render::Camera&, glm::ivec2) { return kCross; };
    Framing framing;
    const render::Camera camera = whole(kWide, false);
    CHECK_FALSE(framing.follow(camera, kWide, points));
    CHECK_FALSE(framing.follow(camera, kWide, points));
    const auto half = framing.follow(camera, kHalf, points);
    REQUIRE(half);
    CHECK_FALSE(framing.follow(*half, kHalf, points));
    const auto third = framing.follow(*half, kThird, points);
    REQUIRE(third);
    CHECK(*third == reframed(camera, kWide, kThird, kCross)); // from the view that was chosen
    SUBCASE("untouched") {
        const auto back = framing.follow(*third, kWide, points);
        REQUIRE(back);
        CHECK(*back == camera);
    }
    SUBCASE("turned") {
        const render::Camera turned = render::turned(*third, 20.0, 0.0);
        CHECK_FALSE(framing.follow(turned, kThird, points));
        CHECK_FALSE(framing.follow(turned, kWide, points)); // a wider part shows more
    }
    SUBCASE("moved by a command while the shape changed") { CHECK_FALSE(framing.follow(camera, kWide, points)); }
}
