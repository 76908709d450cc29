// Pictures of several frames, against the pictures of each; fading, against the mean of linear light; the skeleton,
// against what geometry says. On every OpenGL down to 3.3.
#include "render/gpu/gpu_skeleton.h"
#include "render/renderer/sheet.h"
#include "render/scene/colour.h"
#include "tests/support/gl_test.h"
#include "tests/support/tube_mesh.h"

#include <cmath>
#include <doctest/doctest.h>
#include <glm/geometric.hpp>

using namespace ramus::render;
using ramus::mesh::TriangleMesh;
using ramus::test::add_capsule;
using ramus::test::largest_difference;
using ramus::test::WatchedContext;

namespace {

// A tube along x, seen from the front without perspective, 0.1 mm a pixel.
Frame tube(float radius, glm::ivec2 size = {300, 200}) {
    TriangleMesh mesh;
    add_capsule(mesh, {-12, 0, 0}, {12, 0, 0}, radius, radius, 0, 96);
    Frame frame;
    frame.mesh = std::make_shared<const PagedMesh>(mesh);
    frame.size = size;
    frame.camera = looking(Camera{}, View::kAnterior);
    frame.camera.focal_point = {0, 0, 0};
    frame.camera.position = {0, 200, 0};
    frame.camera.orthographic = true;
    frame.camera.scale = 0.05 * size.y;
    frame.overlays.orientation_cube = frame.overlays.scale_bar = false;
    auto lines = std::make_shared<Centerlines>();
    lines->runs = {{0, 7}};
    for (int i = 0; i < 7; ++i) {
        lines->points.emplace_back(-12.0F + 4.0F * float(i), 0.0F, 0.0F, 4.0F * float(i));
        lines->details.push_back({2.0F * radius, 0});
    }
    frame.centerlines = lines;
    return frame;
}

Image drawn(Renderer& renderer, const Frame& frame) {
    REQUIRE(renderer.draw(frame));
    return renderer.read_image();
}

} // namespace

TEST_CASE("a sheet of one pane is that frame's picture, of several each in its place") {
    const WatchedContext context;
    const auto renderer = Renderer::create().value();
    const Frame thick = tube(5.0F), thin = tube(2.0F);
    const Image first = drawn(*renderer, thick), second = drawn(*renderer, thin);
    SheetRenderer sheets(*renderer);
    Sheet sheet;
    sheet.size = thick.size;
    sheet.panes = {{{0, 0}, thick, true}};
    REQUIRE(sheets.draw(sheet));
    CHECK(sheets.read_image() == first);

    sheet.size = {603, 200};
    sheet.divider = {1.0F, 0.5F, 0.0F};
    sheet.panes = {{{0, 0}, thick, false}, {{303, 0}, thin, true}};
    REQUIRE(sheets.draw(sheet));
    const Image both = sheets.read_image();
    REQUIRE(both.width == 603);
    int wrong = 0;
    for (int y = 0; y < 200; ++y)
        for (int x = 0; x < 603; ++x)
            for (int k = 0; k < 4; ++k) {
                const int expected = x < 300    ? first.pixel(x, y)[k]
                                     : x >= 303 ? second.pixel(x - 303, y)[k]
                                                : std::array{255, 128, 0, 255}[static_cast<std::size_t>(k)];
                wrong += both.pixel(x, y)[k] != expected ? 1 : 0;
            }
    CHECK(wrong == 0);
    // The window gets the same.
    const Target target(603, 200);
    sheets.present(target.framebuffer());
    CHECK(target.read_image() == both);

    SUBCASE("each pane is asked for what it shows") {
        CHECK(sheets.pick({150.0, 100.0}).branch == kNoBranch); // it has no branches
        CHECK(sheets.pick({303.0 + 150.0, 100.0}).branch == 0);
        CHECK(glm::distance(sheets.pick({453.0, 100.0}).position, glm::dvec3(0, 2, 0)) < 0.1);
        CHECK(sheets.pick({453.0, 100.0 + 35.0}).branch == kNoBranch); // beside the thin one, within the thick one
        for (const auto& [x, branch] : {std::pair{150.0, kNoBranch}, {453.0, 0}}) {
            sheets.request_pick({x, 100.0});
            std::optional<Pick> pick;
            while (!pick) pick = sheets.poll_pick();
            CHECK(pick->branch == branch);
        }
        CHECK(SheetRenderer::pane_at(sheet, {299.0, 10.0}) == 0);
        CHECK(SheetRenderer::pane_at(sheet, {304.0, 10.0}) == 1);
    }
    SUBCASE("it tells which pixels show a surface") {
        const std::vector<bool> covered = sheets.read_covered();
        REQUIRE(covered.size() == 603U * 200U);
        const auto at = [&](int x, int y) { return covered[static_cast<std::size_t>(603 * y + x)]; };
        CHECK(at(150, 100 + 35)); // on the thick one, branches or not
        CHECK_FALSE(at(150, 100 + 60));
        CHECK(at(453, 100));
        CHECK_FALSE(at(453, 100 + 35));
        CHECK_FALSE(at(301, 100)); // between them
        sheet.size = thick.size;
        sheet.panes[1].at = {0, 0};
        sheet.panes[1].frame = tube(8.0F);
        sheet.blend = 0.5;
        REQUIRE(sheets.draw(sheet));
        CHECK(sheets.read_covered()[300 * (100 + 70) + 150]); // in either picture
    }
    SUBCASE("what did not change is not drawn") {
        const auto again = sheets.draw(sheet);
        REQUIRE(again);
        CHECK_FALSE(again->shaded);
        sheet.panes[1].frame.camera.scale *= 1.1;
        const auto turned = sheets.draw(sheet);
        REQUIRE(turned);
        CHECK(turned->geometry);
        CHECK(turned->triangles == thin.mesh->triangle_count()); // of one pane
        const Image now = sheets.read_image();
        CHECK(std::equal(first.pixel(0, 100), first.pixel(0, 100) + 1200, now.pixel(0, 100)));
    }
    SUBCASE("nothing lies between panes on nothing") {
        for (auto& pane : sheet.panes) pane.frame.background.transparent = true;
        REQUIRE(sheets.draw(sheet));
        CHECK(sheets.read_image().pixel(301, 100)[3] == 0);
    }
}

TEST_CASE("fading is the mean of linear light, exact at both ends, and draws no frame again") {
    for (const GlVersion version : {GlVersion{99, 0}, GlVersion{3, 3}}) {
        CAPTURE(version.text());
        const WatchedContext context(version);
        const auto renderer = Renderer::create().value();
        for (const bool transparent : {false, true}) {
            CAPTURE(transparent);
            Frame thick = tube(6.0F), thin = tube(3.0F);
            thick.background.transparent = thin.background.transparent = transparent;
            const Image first = drawn(*renderer, thick), second = drawn(*renderer, thin);
            CHECK(largest_difference(first, second) > 100);
            SheetRenderer sheets(*renderer);
            Sheet sheet;
            sheet.size = thick.size;
            sheet.panes = {{{0, 0}, thick, true}, {{0, 0}, thin, false}};
            sheet.blend = 0.0;
            REQUIRE(sheets.draw(sheet));
            CHECK(sheets.read_image() == first);
            for (const double share : {1.0, 0.25, 0.5}) {
                CAPTURE(share);
                sheet.blend = share;
                const auto done = sheets.draw(sheet);
                REQUIRE(done);
                CHECK(done->shaded);
                CHECK_FALSE(done->geometry);
                CHECK(done->triangles == 0);
                const Image mixed = sheets.read_image();
                if (share == 1.0) CHECK(mixed == second);
                double largest = 0.0;
                for (std::size_t i = 0; i < mixed.rgba.size(); i += 4) {
                    const double a = first.rgba[i + 3] / 255.0, b = second.rgba[i + 3] / 255.0;
                    const double alpha = a + share * (b - a);
                    largest = std::max(largest, std::abs(255.0 * alpha - mixed.rgba[i + 3]));
                    if (alpha < 0.2) continue; // few bytes for straight colours
                    for (std::size_t k = i; k < i + 3; ++k) {
                        const double light = (1.0 - share) * a * linear(float(first.rgba[k]) / 255.0F) +
                                             share * b * linear(float(second.rgba[k]) / 255.0F);
                        const double straight = light / alpha;
                        const double srgb =
                            straight <= 0.0031308 ? 12.92 * straight : 1.055 * std::pow(straight, 1.0 / 2.4) - 0.055;
                        largest = std::max(largest, std::abs(255.0 * srgb - mixed.rgba[k]) * std::min(1.0, alpha));
                    }
                }
                CHECK(largest <= (transparent ? 4.0 : 1.0)); // the bytes of premultiplied edges are rounded twice
            }
            const auto again = sheets.draw(sheet);
            REQUIRE(again);
            CHECK_FALSE(again->shaded);
            // What there is more of is pointed at, if it has branches.
            sheet.blend = 0.9;
            REQUIRE(sheets.draw(sheet));
            CHECK(sheets.pick({150.0, 100.0 + 45.0}).branch == 0); // on the thick one
            const Target target(300, 200);
            sheets.present(target.framebuffer());
            if (!transparent) CHECK(target.read_image() == sheets.read_image());
            sheet.heading = "Half and half";
            REQUIRE(sheets.draw(sheet));
            CHECK(sheets.read_image().pixel(150, 100)[0] > 0);
        }
    }
}

TEST_CASE("rings stand evenly along a branch and across it") {
    const Frame frame = tube(2.0F); // 24 mm long: a ring every 4 mm
    const auto rings = skeleton_rings(*frame.centerlines);
    REQUIRE(rings.size() == 6);
    for (std::size_t i = 0; i < rings.size(); ++i) {
        CHECK(rings[i].branch == 0);
        CHECK(rings[i].radius_mm == doctest::Approx(2.0));
        CHECK(glm::distance(rings[i].centre, glm::vec3(-10.0F + 4.0F * float(i), 0, 0)) < 1e-5F);
        CHECK(glm::distance(rings[i].axis, glm::vec3(1, 0, 0)) < 1e-5F);
    }
    Centerlines lines = *frame.centerlines;
    for (auto& detail : lines.details) detail.diameter_mm = 30.0F; // longer than its radius: one in the middle
    REQUIRE(skeleton_rings(lines).size() == 1);
    CHECK(std::abs(skeleton_rings(lines)[0].centre.x) < 1e-5F);
    for (auto& detail : lines.details) detail.diameter_mm = 50.0F; // shorter: it lies inside what it hangs on
    CHECK(skeleton_rings(lines).empty());
    for (auto& detail : lines.details) detail.diameter_mm = 0.0F;
    CHECK(skeleton_rings(lines).empty());
}

TEST_CASE("the skeleton lies where it belongs, over what rests and what moves, and not on hidden branches") {
    Image newest;
    for (const GlVersion version : {GlVersion{99, 0}, GlVersion{3, 3}}) {
        CAPTURE(version.text());
        const WatchedContext context(version);
        const auto renderer = Renderer::create().value();
        Frame frame = tube(4.0F); // 40 pixels; rings at x = -8, 0 and 8 mm
        for (glm::dvec3* place : {&frame.camera.position, &frame.camera.focal_point})
            *place += glm::dvec3(0.05, 0.0, 0.05); // lines run through the middles of pixels
        const Image plain = drawn(*renderer, frame);
        frame.skeleton = frame.centerlines;
        const Image with = drawn(*renderer, frame);
        const auto change = [&](const Image& image, const Image& before, double x_mm, double z_mm) {
            // The patient's right is at the left.
            const int x = static_cast<int>(150.0 - 10.0 * x_mm), y = static_cast<int>(100.0 - 10.0 * z_mm);
            int most = 0;
            for (int dx = -1; dx <= 1; ++dx)
                for (int dy = -1; dy <= 1; ++dy)
                    for (int k = 0; k < 3; ++k)
                        most = std::max(most, image.pixel(x + dx, y + dy)[k] - before.pixel(x + dx, y + dy)[k]);
            return most;
        };
        for (const double x : {-11.0, -4.0, 4.0, 11.0}) {
            CAPTURE(x);
            CHECK(change(with, plain, x, 0.0) > 50); // the line, through the vessel
            CHECK(change(with, plain, x, 2.0) == 0);
        }
        for (const double x : {-8.0, 8.0})
            for (const double z : {-2.5, 2.5}) CHECK(change(with, plain, x, z) > 100); // the near half of a ring
        CHECK(change(with, plain, 13.5, 0.0) == 0);                                    // beyond its end
        if (newest.width == 0)
            newest = with;
        else
            CHECK(largest_difference(with, newest) <= 2);

        frame.states = {BranchState::kHidden};
        const Image hidden = drawn(*renderer, frame);
        frame.skeleton = nullptr;
        CHECK(drawn(*renderer, frame) == hidden);

        // While it moves, over the caster's picture.
        frame.states.clear();
        frame.quality = Quality::kInteractive;
        const Camera rest = frame.camera;
        const auto moving = [&] {
            frame.camera.scale = 1.001 * rest.scale;
            REQUIRE(renderer->draw(frame));
            frame.camera = rest;
            const auto done = renderer->draw(frame);
            REQUIRE(done);
            CHECK(done->cones > 0);
            return renderer->read_image();
        };
        const Image without_lines = moving();
        frame.skeleton = frame.centerlines;
        const Image with_lines = moving();
        for (const double x : {-11.0, -4.0, 4.0, 11.0}) CHECK(change(with_lines, without_lines, x, 0.0) > 50);
        for (const double x : {-8.0, 8.0}) CHECK(change(with_lines, without_lines, x, 2.5) > 100);
        CHECK(change(with_lines, without_lines, 4.0, 2.0) == 0);
    }
}

TEST_CASE("a skeleton needs no surface to lie in, and a line behind another vessel is faint") {
    const WatchedContext context;
    const auto renderer = Renderer::create().value();
    Frame frame = tube(4.0F);
    auto lines = std::make_shared<Centerlines>(*frame.centerlines);
    for (auto& point : lines->points) point.y = -30.0F; // far behind the tube
    frame.centerlines = nullptr;
    const Image plain = drawn(*renderer, frame);
    frame.skeleton = lines;
    const Image behind = drawn(*renderer, frame);
    const int brighter = behind.pixel(150, 100)[2] - plain.pixel(150, 100)[2];
    CHECK(brighter >= 0);
    CHECK(brighter < 40);
    frame.mesh = nullptr;
    const Image alone = drawn(*renderer, frame);
    CHECK(alone.pixel(150, 100)[2] > 150);
}
