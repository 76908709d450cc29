// Pictures of several frames, against the pictures of each; fading, against the mean of linear light. On every OpenGL
// down to 3.3.
#include "render/renderer/sheet.h"
#include "render/scene/colour.h"
#include "tests/support/gl_test.h"
#include "tests/support/tube_scene.h"

#include <cmath>
#include <doctest/doctest.h>
#include <glm/geometric.hpp>

using namespace ramus::render;
using ramus::test::drawn;
using ramus::test::largest_difference;
using ramus::test::tube;
using ramus::test::WatchedContext;

namespace {

// From the mean of linear light, bytes of 255, of all channels.
double farthest_from_mean(const Image& mixed, const Image& first, const Image& second, double share) {
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
    return largest;
}

// A thick tube and a thin one beside each other; the thick one's surface has no branches.
struct TwoViewports {
    WatchedContext context;
    std::unique_ptr<Renderer> renderer = Renderer::create().value();
    Frame thick = tube(5.0F), thin = tube(2.0F);
    Image first = drawn(*renderer, thick), second = drawn(*renderer, thin);
    SheetRenderer sheets{*renderer};
    Sheet sheet;

    TwoViewports() {
        sheet.size = {603, 200};
        sheet.divider = {1.0F, 0.5F, 0.0F};
        sheet.viewports = {{{0, 0}, thick, false}, {{303, 0}, thin, true}};
    }
};

} // namespace

TEST_CASE_FIXTURE(TwoViewports,
                  "with little time a second viewport gets its renderer and its first picture in a call each") {
    Sheet one;
    one.size = thick.size;
    one.viewports = {{{0, 0}, thick, true}};
    REQUIRE(sheets.draw(one));
    const auto made = sheets.draw(sheet, kUploadAll, 0.01);
    REQUIRE(made);
    CHECK(made->unfinished);
    CHECK_FALSE(made->geometry); // programs alone
    const auto drawn_first = sheets.draw(sheet, kUploadAll, 0.01);
    REQUIRE(drawn_first);
    CHECK(drawn_first->unfinished);
    CHECK(drawn_first->geometry);
    for (int calls = 0; calls < 1000; ++calls) {
        const auto done = sheets.draw(sheet, kUploadAll, 0.01);
        REQUIRE(done);
        if (!done->unfinished) break;
    }
    const Image in_time = sheets.read_image();
    SheetRenderer at_once(*renderer);
    REQUIRE(at_once.draw(sheet));
    CHECK(in_time == at_once.read_image());
}

TEST_CASE_FIXTURE(TwoViewports, "a sheet of one viewport is that frame's picture, of several each in its place") {
    Sheet one;
    one.size = thick.size;
    one.viewports = {{{0, 0}, thick, true}};
    REQUIRE(sheets.draw(one));
    CHECK(sheets.read_image() == first);

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
    PictureTarget target;
    target.make({603, 200});
    sheets.present(target.framebuffer);
    CHECK(target.read_premultiplied() == both);
}

TEST_CASE_FIXTURE(TwoViewports, "a sheet asks each viewport for what it shows") {
    REQUIRE(sheets.draw(sheet));
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
    CHECK(SheetRenderer::viewport_at(sheet, {299.0, 10.0}) == 0);
    CHECK(SheetRenderer::viewport_at(sheet, {304.0, 10.0}) == 1);
}

TEST_CASE_FIXTURE(TwoViewports, "a sheet tells which pixels show a surface") {
    REQUIRE(sheets.draw(sheet));
    const std::vector<bool> covered = sheets.read_covered();
    REQUIRE(covered.size() == 603U * 200U);
    const auto at = [&](int x, int y) { return covered[static_cast<std::size_t>(603 * y + x)]; };
    CHECK(at(150, 100 + 35)); // on the thick one, branches or not
    CHECK_FALSE(at(150, 100 + 60));
    CHECK(at(453, 100));
    CHECK_FALSE(at(453, 100 + 35));
    CHECK_FALSE(at(301, 100)); // between them
    sheet.size = thick.size;
    sheet.viewports[1].at = {0, 0};
    sheet.viewports[1].frame = tube(8.0F);
    sheet.blend = 0.5;
    REQUIRE(sheets.draw(sheet));
    CHECK(sheets.read_covered()[300 * (100 + 70) + 150]); // in either picture
}

TEST_CASE_FIXTURE(TwoViewports, "of a sheet what did not change is not drawn") {
    REQUIRE(sheets.draw(sheet));
    const auto again = sheets.draw(sheet);
    REQUIRE(again);
    CHECK_FALSE(again->shaded);
    sheet.viewports[1].frame.camera.scale *= 1.1;
    const auto turned = sheets.draw(sheet);
    REQUIRE(turned);
    CHECK(turned->geometry);
    CHECK(turned->triangles == thin.mesh->triangle_count()); // of one viewport
    const Image now = sheets.read_image();
    CHECK(std::equal(first.pixel(0, 100), first.pixel(0, 100) + 1200, now.pixel(0, 100)));
}

TEST_CASE_FIXTURE(TwoViewports, "nothing lies between a sheet's viewports on nothing") {
    REQUIRE(sheets.draw(sheet));
    for (auto& viewport : sheet.viewports) viewport.frame.background.transparent = true;
    REQUIRE(sheets.draw(sheet));
    CHECK(sheets.read_image().pixel(301, 100)[3] == 0);
}

TEST_CASE_FIXTURE(TwoViewports,
                  "a sheet of fewer viewports that cannot be drawn leaves nothing that is asked or shown") {
    const glm::dvec2 in_second(453.0, 100.0);
    for (const bool mixed : {false, true}) {
        CAPTURE(mixed);
        Sheet two = sheet;
        if (mixed) two.size = thick.size, two.viewports[1].at = {0, 0}, two.blend = 0.5;
        REQUIRE(sheets.draw(two));
        sheets.request_pick(in_second);
        REQUIRE(sheets.request_depths());
        Sheet one = sheet_of(tube(3.0F, {1200, 900}));
        limit_gl_allocation(std::size_t{1} << 20);
        CHECK_FALSE(sheets.draw(one));
        limit_gl_allocation();
        CHECK(sheets.poll_pick() == Pick{});
        CHECK(sheets.pick(in_second) == Pick{});
        CHECK(sheets.pick(in_second, sheets.seen()) == Pick{});
        sheets.request_pick(in_second);
        CHECK(sheets.poll_pick() == Pick{});
        CHECK_FALSE(sheets.request_depths());
        CHECK(sheets.poll_depths()->empty());
        (void)sheets.read_image();
        PictureTarget target;
        target.make(two.size);
        sheets.present(target.framebuffer);
        CHECK_FALSE(sheets.refine(two)->changed);
        REQUIRE(sheets.draw(one)); // and it is drawn where there is memory
        CHECK(sheets.read_image().width == 1200);
    }
}

TEST_CASE_FIXTURE(TwoViewports, "a sheet of more viewports than could be drawn is not made finer") {
    Sheet one = sheet_of(thick);
    REQUIRE(sheets.draw(one));
    limit_gl_allocation(16);
    const auto refused = sheets.draw(sheet);
    limit_gl_allocation();
    REQUIRE_FALSE(refused);
    CHECK(refused.error().message().find("out of graphics memory") != std::string::npos);
    const auto none = sheets.refine(sheet);
    REQUIRE(none);
    CHECK_FALSE(none->changed);
    REQUIRE(sheets.draw(sheet, kUploadAll, 0.01)->unfinished); // the second has its programs, and no picture
    CHECK_FALSE(sheets.refine(sheet)->changed);
    REQUIRE(sheets.draw(sheet));
    CHECK(sheets.refine(sheet)->changed);
}

TEST_CASE("beside a line either picture is what it is, and draws no frame again") {
    for (const GlVersion version : {GlVersion{99, 0}, GlVersion{3, 3}}) {
        CAPTURE(version.text());
        const WatchedContext context(version);
        const auto renderer = Renderer::create().value();
        const Frame thick = tube(6.0F), thin = tube(3.0F);
        const Image first = drawn(*renderer, thick), second = drawn(*renderer, thin);
        SheetRenderer sheets(*renderer);
        Sheet sheet;
        sheet.size = thick.size;
        sheet.viewports = {{{0, 0}, thick, true}, {{0, 0}, thin, true}};
        sheet.line_width = 2.0F;
        for (const double at : {0.5, 0.25, 0.0, 1.0}) {
            CAPTURE(at);
            sheet.wipe = at;
            const auto done = sheets.draw(sheet);
            REQUIRE(done);
            CHECK(done->shaded);
            CHECK(done->geometry == (at == 0.5)); // the first time
            const Image wiped = sheets.read_image();
            const int line = static_cast<int>(at * sheet.size.x);
            int beside = 0, on_line = 0;
            for (int y = 0; y < wiped.height; ++y)
                for (int x = 0; x < wiped.width; ++x) {
                    const bool seen = at > 0.0 && at < 1.0 && (x == line - 1 || x == line);
                    const std::uint8_t* one = wiped.pixel(x, y);
                    const std::uint8_t* wanted = (x < line ? first : second).pixel(x, y);
                    (seen ? on_line : beside) += std::equal(one, one + 4, wanted) ? 0 : 1;
                }
            CHECK(beside == 0);
            CHECK(on_line == (at > 0.0 && at < 1.0 ? 2 * wiped.height : 0));
        }
        sheet.wipe = 0.5;
        REQUIRE(sheets.draw(sheet));
        // What is seen is pointed at: beyond the thin one there is nothing on the right.
        CHECK(sheets.pick({100.0, 100.0 + 45.0}).branch == 0);
        CHECK(sheets.pick({200.0, 100.0 + 45.0}).branch == kNoBranch);
    }
}

TEST_CASE("fading is the mean of linear light, exact at both ends, and draws no frame again" *
          doctest::test_suite("slow")) {
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
            sheet.viewports = {{{0, 0}, thick, true}, {{0, 0}, thin, false}};
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
                const double largest = farthest_from_mean(mixed, first, second, share);
                CHECK(largest <= (transparent ? 4.0 : 1.0)); // the bytes of premultiplied edges are rounded twice
            }
            const auto again = sheets.draw(sheet);
            REQUIRE(again);
            CHECK_FALSE(again->shaded);
            // What there is more of is pointed at, if it has branches.
            sheet.blend = 0.9;
            REQUIRE(sheets.draw(sheet));
            CHECK(sheets.pick({150.0, 100.0 + 45.0}).branch == 0); // on the thick one
            PictureTarget target;
            target.make({300, 200});
            sheets.present(target.framebuffer);
            if (!transparent) CHECK(target.read_premultiplied() == sheets.read_image());
            sheet.heading = "Half and half";
            REQUIRE(sheets.draw(sheet));
            CHECK(sheets.read_image().pixel(150, 100)[0] > 0);
        }
    }
}

TEST_CASE("a picture of another size than its place is scaled to be as high, and covers nothing beside it") {
    const ramus::test::WatchedContext context;
    const auto filled = [](PictureTarget& target, glm::ivec2 size, glm::vec4 colour) {
        target.make(size);
        glClearNamedFramebufferfv(target.framebuffer, GL_COLOR, 0, &colour.x);
    };
    const auto is_red = [](const Image& image, int x, int row_from_below) {
        return image.rgba[4 * (static_cast<std::size_t>(image.height - 1 - row_from_below) * 64 + x)] > 128;
    };
    PictureTarget picture, window;
    filled(picture, {40, 20}, {1, 0, 0, 1});
    filled(window, {64, 64}, {0, 0, 1, 1});
    picture.present(window.framebuffer, 8, 4, {30, 40}); // it would be 80 wide
    Image seen = window.read();
    for (const int x : {8, 20, 37}) CHECK(is_red(seen, x, 4) == is_red(seen, x, 43));
    CHECK(is_red(seen, 8, 4));
    CHECK(is_red(seen, 37, 43));
    for (const auto& [x, y] : {std::pair{7, 20}, {38, 20}, {20, 3}, {20, 44}}) CHECK_FALSE(is_red(seen, x, y));
    filled(window, {64, 64}, {0, 0, 1, 1});
    picture.present(window.framebuffer, 4, 4, {50, 10}); // it is 20 wide, in the middle
    seen = window.read();
    CHECK(is_red(seen, 19, 4));
    CHECK(is_red(seen, 38, 13));
    for (const auto& [x, y] : {std::pair{18, 8}, {39, 8}, {30, 14}}) CHECK_FALSE(is_red(seen, x, y));
}
