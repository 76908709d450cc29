// The depths of a picture, read back; and what lies over a picture, painted anew without drawing it.
#include "render/renderer/sheet.h"
#include "render/scene/camera_moves.h"
#include "tests/support/small_tree.h"
#include "tests/support/tube_scene.h"

#include <glm/geometric.hpp>

using namespace ramus::render;
using ramus::test::SmallTree;
using ramus::test::WatchedContext;

namespace {

DepthMap answer(Renderer& renderer) {
    REQUIRE(renderer.request_depths());
    for (int i = 0; i < 100000; ++i)
        if (auto map = renderer.poll_depths()) return *map;
    FAIL("no answer");
    return {};
}

} // namespace

TEST_CASE("depths say of a pixel what a pick says, of every kind of picture" * doctest::test_suite("slow")) {
    for (const GlVersion version : {GlVersion{99, 0}, GlVersion{3, 3}})
        for (const bool orthographic : {false, true})
            for (const Quality quality : {Quality::kFull, Quality::kInteractive}) {
                CAPTURE(version.text());
                CAPTURE(orthographic);
                const WatchedContext context(version);
                auto renderer = Renderer::create().value();
                CHECK_FALSE(renderer->request_depths()); // of no picture
                Frame frame = ramus::test::tube(3.0F, {301, 203});
                frame.camera = with_projection(frame.camera, orthographic);
                frame.camera = turned(frame.camera, 25.0, 10.0);
                frame.quality = quality;
                frame.states = {BranchState::kDefocused}; // glass is seen, too
                REQUIRE(renderer->draw(frame));
                const DepthMap map = answer(*renderer);
                CHECK_FALSE(renderer->poll_depths()); // once
                CHECK(map.camera == frame.camera);
                int seen = 0;
                for (int x = 20; x < 300; x += 20)
                    for (int y = 10; y < 200; y += 10) {
                        const glm::dvec2 at(x + 0.5, y + 0.5);
                        const Pick pick = renderer->pick(at.x, at.y);
                        const auto point = map.point_at(at, 0.0);
                        if (pick.branch == kNoBranch) CHECK_FALSE(point);
                        if (!point) continue;
                        ++seen;
                        CHECK(glm::distance(*point, pick.position) < 1.5); // of one pixel or the next: 0.1 mm each
                    }
                CHECK(seen > 10);
            }
}

TEST_CASE("the caster tells its depths at once") {
    SmallTree scene;
    scene.frame = ramus::test::tube(3.0F);
    (void)scene.draw();
    scene.frame.camera = turned(scene.frame.camera, 20.0, 0.0);
    scene.frame.quality = Quality::kInteractive;
    scene.frame.surface_awaited = true;
    const auto done = scene.renderer->draw(scene.frame);
    REQUIRE(done);
    REQUIRE(done->cones > 0);
    REQUIRE(scene.renderer->request_depths());
    const auto map = scene.renderer->poll_depths();
    REQUIRE(map);
    const auto point = map->point_at({150.0, 100.0}, 2.0);
    REQUIRE(point);
    // Its wall is 3 mm before the axis, where that goes by 20 degrees into the picture: 3 / cos 20 along the line of
    // sight.
    CHECK(depth_of(scene.frame.camera, *point) == doctest::Approx(200.0 - 3.0 / std::cos(0.349)).epsilon(1e-3));
}

TEST_CASE("what lies over a picture is painted anew without drawing or shading it") {
    for (const bool refined : {false, true}) {
        SmallTree scene;
        scene.frame.overlays.orientation_cube = true;
        (void)scene.draw();
        while (refined && scene.renderer->refine()->more) {
        }
        const Image before = scene.renderer->read_image();
        scene.frame.overlays.scale_bar = true;
        scene.frame.overlays.scale = Scale{Scale::At::kMiddle, 0.1, 0.1};
        const auto done = scene.renderer->draw(scene.frame);
        REQUIRE(done);
        CHECK(done->shaded);
        CHECK_FALSE(done->geometry);
        CHECK(done->triangles == 0);
        const Image with = scene.renderer->read_image();
        CHECK(compare(before, with)->differing > 50);
        if (refined) CHECK_FALSE(scene.renderer->refine()->more); // it is as fine as it was
        if (!refined) {
            SmallTree fresh;
            fresh.frame = scene.frame;
            CHECK(ramus::test::largest_difference(fresh.draw(), with) == 0);
        }
        REQUIRE(scene.context.make_current()); // again
        scene.frame.overlays.scale.reset();
        (void)scene.renderer->draw(scene.frame);
        CHECK(ramus::test::largest_difference(scene.renderer->read_image(), before) == 0);
    }
}

TEST_CASE("a picture that is kept has the scale at the middle of what it shows, or none") {
    SmallTree scene;
    SheetRenderer sheets(*scene.renderer);
    scene.frame.overlays.scale_bar = true;
    REQUIRE(sheets.draw(sheet_of(scene.frame)));
    CHECK_FALSE(sheets.scale_bar()); // nobody has looked
    REQUIRE(sheets.draw_with_scale(sheet_of(scene.frame)));
    REQUIRE(sheets.scale_bar());
    const ScaleBar bar = *sheets.scale_bar();
    CHECK(bar.at == Scale::At::kMiddle);
    CHECK(bar.percent > 0);
    // The tree is some 25 mm deep around its middle, 6 mm before the origin.
    const double depth = scene.frame.camera.position.y - 6.0;
    CHECK(bar.length_mm / bar.pixels ==
          doctest::Approx(mm_per_pixel_at(scene.frame.camera, scene.frame.size, depth)).epsilon(0.03));
    scene.frame.camera.orthographic = true;
    REQUIRE(sheets.draw_with_scale(sheet_of(scene.frame)));
    CHECK_FALSE(sheets.scale_bar()->at);
    scene.frame.camera.orthographic = false;
    scene.frame.camera.focal_point = 2.0 * scene.frame.camera.position - scene.frame.camera.focal_point; // looks away
    REQUIRE(sheets.draw_with_scale(sheet_of(scene.frame)));
    CHECK_FALSE(sheets.scale_bar());
}
