// The mouse at the edges of slices among the vessels.
#include "app/tools/plane_mouse.h"

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

using namespace ramus;
using namespace ramus::app;

namespace {

constexpr glm::ivec2 kPlaneView(800, 600);

// An axial plane of 200 x 100 mm at a height, seen from the front and above.
render::ScanPlane axial_at(double height) {
    return {{100, 50, height}, {-200, 0, 0}, {0, -100, 0}, nullptr, glm::vec3(1.0F, 0.0F, 0.0F), 2.0F};
}
render::Camera from_above(bool orthographic) {
    render::Camera camera = render::looking({}, render::View::kAnterior);
    camera.orthographic = orthographic;
    camera.scale = 130.0;
    return render::turned(camera, 0.0, 30.0);
}
glm::dvec2 pixel_of(const render::Camera& camera, const glm::dvec3& place) {
    return glm::dvec2(*render::project(camera, kPlaneView, place));
}

} // namespace

TEST_CASE("an edge is found at its pixels and a little beside them, the inside is not") {
    const render::Camera camera = from_above(false);
    const PlaneSight sight{camera, kPlaneView, 1.0F};
    const std::vector<render::ScanPlane> planes{axial_at(-60.0), axial_at(30.0)};
    const glm::dvec3 on_edge(20.0, 50.0, 30.0);
    const auto edge = edge_under(planes, sight, pixel_of(camera, on_edge) + glm::dvec2(0.0, 3.0));
    REQUIRE(edge);
    CHECK(edge->plane == 1);
    CHECK(glm::distance(edge->place, on_edge) < 3.0);
    CHECK(std::abs(edge->normal.z) == doctest::Approx(1.0));
    CHECK_FALSE(edge_under(planes, sight, pixel_of(camera, {0.0, 0.0, 30.0})));
    CHECK_FALSE(edge_under({}, sight, pixel_of(camera, on_edge)));
    // Twice as far where a point has two pixels.
    const glm::dvec2 aside = pixel_of(camera, on_edge) + glm::dvec2(0.0, 9.0);
    CHECK_FALSE(edge_under(planes, sight, aside));
    CHECK(edge_under(planes, {camera, kPlaneView, 2.0F}, aside));
}

TEST_CASE("edges behind the eye are not found") {
    render::Camera camera = from_above(false);
    camera.position = {0.0, 0.0, 30.0 + 5.0};
    camera.focal_point = {0.0, -100.0, 35.0};
    const std::vector<render::ScanPlane> planes{axial_at(30.0)};
    const PlaneSight sight{camera, kPlaneView, 1.0F};
    CHECK_FALSE(outline_of(planes[0], sight).empty());
    CHECK(edge_under(planes, sight, pixel_of(camera, {0.0, -50.0, 30.0})));
}

TEST_CASE("the place that was grabbed stays under the pointer") {
    for (const bool orthographic : {false, true}) {
        CAPTURE(orthographic);
        const render::Camera camera = from_above(orthographic);
        const PlaneSight sight{camera, kPlaneView, 1.0F};
        const glm::dvec3 grabbed(-40.0, 50.0, 30.0);
        const glm::dvec3 goal = grabbed + glm::dvec3(0.0, 0.0, -17.0);
        const glm::dvec2 from = pixel_of(camera, grabbed);
        const glm::dvec2 to = pixel_of(camera, goal);
        for (const double sign : {1.0, -1.0}) // the normal's direction does not matter to the hand
            CHECK(sign * slid_mm(grabbed, {0.0, 0.0, sign}, sight, from, to) == doctest::Approx(-17.0).epsilon(1e-6));

        PlaneMouse mouse;
        mouse.grab({0, grabbed, {0.0, 0.0, 1.0}}, slice::Direction::kAxial, {1.0, 2.0, 30.0}, from);
        CHECK(mouse.move(sight, {}, from + glm::dvec2(1.0, 1.0)) == glm::dvec3(1.0, 2.0, 30.0)); // no drag yet
        CHECK_FALSE(mouse.dragging());
        CHECK(glm::distance(mouse.move(sight, {}, to), glm::dvec3(1.0, 2.0, 13.0)) < 1e-6);
        CHECK(mouse.dragging());
        // It does not leave the scan.
        const Bounds<glm::dvec3> scan{glm::dvec3(-100.0, -50.0, 20.0), glm::dvec3(100.0, 50.0, 60.0)};
        CHECK(glm::distance(mouse.move(sight, scan, to), glm::dvec3(1.0, 2.0, 20.0)) < 1e-6);
        mouse.release();
        CHECK_FALSE(mouse.held());
    }
}

TEST_CASE("a plane that is seen from its front follows the height of the pointer") {
    render::Camera camera = render::looking({}, render::View::kSuperior);
    const PlaneSight sight{camera, kPlaneView, 1.0F};
    const double mm = slid_mm({0.0, 0.0, 0.0}, {0.0, 0.0, 1.0}, sight, {400.0, 300.0}, {400.0, 350.0});
    CHECK(mm == doctest::Approx(50.0 * render::mm_per_pixel(camera, kPlaneView)));
    CHECK(slid_mm({0.0, 0.0, 0.0}, {0.0, 0.0, -1.0}, sight, {400.0, 300.0}, {400.0, 350.0}) == doctest::Approx(-mm));
}

TEST_CASE("planes of a picture belong to the slices that are shown, in their order") {
    SliceViews views;
    CHECK(slices_among_vessels(views).empty());
    views.in_picture[slice_index(slice::Direction::kSagittal)] = true;
    views.in_picture[slice_index(slice::Direction::kAxial)] = true;
    CHECK(slices_among_vessels(views) == std::vector{slice::Direction::kAxial, slice::Direction::kSagittal});
}
