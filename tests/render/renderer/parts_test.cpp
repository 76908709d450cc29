// Pictures that are made in parts, so that a window can answer in between.
#include "render/renderer/in_parts.h"
#include "render/renderer/renderer.h"
#include "render/renderer/sheet.h"
#include "tests/support/crossing_vessels.h"
#include "tests/support/gl_test.h"

#include <doctest/doctest.h>
#include <optional>
#include <stdexcept>
#include <vector>

using namespace ramus::render;
using ramus::test::largest_difference;
using ramus::test::with_glass;

namespace {

struct PartsScene : ramus::test::CrossingVessels {
    explicit PartsScene(GlVersion newest = {99, 0}) : CrossingVessels(newest, 72) {
        REQUIRE(frame.mesh->triangle_count() > 200'000);
    }
    [[nodiscard]] Frame seen_from(View view) const {
        Frame other = frame;
        other.camera = camera_for(frame.mesh->positions(), view, frame.size, false);
        return other;
    }
    [[nodiscard]] DrawStatistics draw(const Frame& of, double seconds = kUntilDone) const {
        SheetRenderer::finish(); // so that every call does a part
        return CrossingVessels::draw(of, seconds);
    }
    [[nodiscard]] int draw_in_parts(const Frame& of) const {
        int calls = 1;
        while (draw(of, 0.0).unfinished) ++calls;
        return calls;
    }
};

InParts<int> counted(int parts, bool throws) {
    for (int n = 1; n < parts; ++n) co_await kPartEnds;
    if (throws) throw std::runtime_error("in the last part");
    co_return parts;
}

} // namespace

TEST_CASE("work in parts ends with its result, or throws") {
    InParts<int> three = counted(3, false);
    CHECK(three.resume());
    CHECK(three.resume());
    CHECK(!three.resume());
    CHECK(three.result() == 3);
    InParts<int> failing = counted(2, true);
    CHECK(failing.resume());
    CHECK_THROWS_AS((void)failing.resume(), std::runtime_error);
    (void)counted(3, false); // never begun
}

TEST_CASE("a picture made in parts is the one made at once, and the one before stays until then" *
          doctest::test_suite("slow")) {
    for (const GlVersion version : {GlVersion{99, 0}, GlVersion{3, 3}})
        for (const bool glass : {false, true}) {
            CAPTURE(version.major);
            CAPTURE(glass);
            const PartsScene scene(version);
            const Frame before = scene.frame;
            const Frame wanted =
                glass ? with_glass(scene.seen_from(View::kSuperior)) : scene.seen_from(View::kSuperior);
            CHECK(!scene.draw(wanted, 0.0).unfinished); // there is nothing to be seen meanwhile
            const Image at_once = scene.renderer->read_image();
            (void)scene.draw(before);
            const Image first = scene.renderer->read_image();
            int calls = 1;
            while (scene.draw(wanted, 0.0).unfinished) {
                ++calls;
                REQUIRE(largest_difference(scene.renderer->read_image(), first) == 0);
            }
            CHECK(calls > 5);
            CHECK(largest_difference(scene.renderer->read_image(), at_once) == 0);
            CHECK(!scene.draw(wanted, 0.0).shaded); // nothing is left to do
        }
}

TEST_CASE("a picture of another size comes in parts, too, and the one before stays until then" *
          doctest::test_suite("slow")) {
    const PartsScene scene;
    (void)scene.draw(scene.frame);
    const Image first = scene.renderer->read_image();
    Frame wanted = scene.seen_from(View::kSuperior);
    wanted.size = scene.frame.size * 3 / 2;
    int calls = 1;
    while (scene.draw(wanted, 0.0).unfinished) {
        ++calls;
        REQUIRE(largest_difference(scene.renderer->read_image(), first) == 0);
    }
    CHECK(calls > 5);
    const auto other = Renderer::create().value();
    REQUIRE(other->draw(wanted));
    CHECK(largest_difference(scene.renderer->read_image(), other->read_image()) == 0);
    CHECK(scene.renderer->pick(160, 120) == other->pick(160, 120));
}

TEST_CASE("the first picture comes in parts, too, for who can wait for it") {
    const PartsScene scene;
    (void)scene.draw(scene.frame);
    const auto other = Renderer::create().value();
    other->draw_first_in_parts();
    int calls = 0;
    for (bool more = true; more; ++calls) {
        SheetRenderer::finish();
        const auto done = other->draw(scene.frame, kUploadAll, 0.0);
        REQUIRE(done);
        more = done->unfinished;
        CHECK(other->has_picture() != more);
    }
    CHECK(calls > 5);
    CHECK(largest_difference(other->read_image(), scene.renderer->read_image()) == 0);
}

TEST_CASE("a sheet says that a view still shows an earlier picture beside a slice that is already new") {
    const PartsScene scene;
    SheetRenderer sheets(*scene.renderer);
    Sheet sheet;
    sheet.size = {2 * scene.frame.size.x, scene.frame.size.y};
    sheet.viewports.resize(2);
    sheet.viewports[0].frame = sheet.viewports[1].frame = scene.frame;
    sheet.viewports[1].at.x = scene.frame.size.x;
    sheet.viewports[0].slice.emplace().grid.size = scene.frame.size;
    const auto first = sheets.draw(sheet);
    REQUIRE(first);
    CHECK_FALSE(first->of_before);
    sheet.viewports[0].slice->background = glm::vec3(0.5F);
    sheet.viewports[1].frame = scene.seen_from(View::kSuperior);
    int calls = 0;
    for (bool more = true; more; ++calls) {
        SheetRenderer::finish();
        const auto done = sheets.draw(sheet, kUploadAll, 0.0);
        REQUIRE(done);
        CHECK(done->of_before == done->unfinished);
        if (calls == 0) CHECK((done->shaded && done->unfinished));
        more = done->unfinished;
    }
    CHECK(calls > 1);
}

TEST_CASE("two renderers make their pictures by turns" * doctest::test_suite("slow")) {
    const PartsScene scene;
    const auto other = Renderer::create().value();
    const Frame one = scene.seen_from(View::kSuperior);
    const Frame two = with_glass(scene.seen_from(View::kLeft));
    (void)scene.draw(one);
    REQUIRE(other->draw(two));
    const Image first = scene.renderer->read_image(), second = other->read_image();
    for (const Frame& start : {scene.frame, with_glass(scene.frame)}) {
        (void)scene.draw(start);
        REQUIRE(other->draw(start));
        for (bool more = true; more;) {
            more = scene.draw(one, 0.0).unfinished;
            const auto done = other->draw(two, kUploadAll, 0.0);
            REQUIRE(done);
            more = more || done->unfinished;
        }
        CHECK(largest_difference(scene.renderer->read_image(), first) == 0);
        CHECK(largest_difference(other->read_image(), second) == 0);
    }
}

TEST_CASE("a picture that is left unfinished leaves nothing behind" * doctest::test_suite("slow")) {
    const PartsScene scene;
    const Frame before = scene.frame;
    Frame recoloured = before;
    recoloured.colours.assign(PartsScene::kVessels, {0.1F, 0.9F, 0.2F});
    (void)scene.draw(recoloured);
    const Image green = scene.renderer->read_image();
    (void)scene.draw(before);
    const Image first = scene.renderer->read_image();
    const BranchPicture branches = scene.renderer->read_branches();
    const Frame other = scene.seen_from(View::kLeft);
    for (int parts = 1; parts < 6; ++parts) {
        for (int n = 0; n < parts; ++n) REQUIRE(scene.draw(other, 0.0).unfinished);
        CHECK(largest_difference(scene.renderer->read_image(), first) == 0);
        // Pixels know again what they show.
        CHECK(scene.draw(before).geometry);
        CHECK(scene.renderer->read_branches().branches == branches.branches);
        CHECK(largest_difference(scene.renderer->read_image(), first) == 0);
        // What the passes had for it is gone: another colour draws triangles.
        for (int n = 0; n < parts; ++n) REQUIRE(scene.draw(other, 0.0).unfinished);
        CHECK(scene.draw(recoloured).geometry);
        CHECK(largest_difference(scene.renderer->read_image(), green) == 0);
        CHECK(!scene.draw(before).geometry);
        CHECK(largest_difference(scene.renderer->read_image(), first) == 0);
    }
}

TEST_CASE("what is pointed at or recoloured meanwhile is so in the picture" * doctest::test_suite("slow")) {
    const PartsScene scene;
    Frame wanted = scene.seen_from(View::kSuperior);
    Frame hovered = wanted;
    hovered.hovered = 7;
    hovered.colours.assign(PartsScene::kVessels, {0.2F, 0.4F, 0.9F});
    (void)scene.draw(hovered);
    const Image at_once = scene.renderer->read_image();
    (void)scene.draw(scene.frame);
    const int calls = scene.draw_in_parts(wanted);
    (void)scene.draw(scene.frame);
    REQUIRE(scene.draw(wanted, 0.0).unfinished);
    REQUIRE(scene.draw(wanted, 0.0).unfinished);
    int left = 1;
    while (scene.draw(hovered, 0.0).unfinished) ++left;
    CHECK(left < calls); // it went on
    CHECK(largest_difference(scene.renderer->read_image(), at_once) == 0);
}

TEST_CASE("a query for what is under the pointer waits for the picture" * doctest::test_suite("slow")) {
    const PartsScene scene;
    const Frame wanted = scene.seen_from(View::kSuperior);
    (void)scene.draw(wanted);
    const BranchPicture branches = scene.renderer->read_branches();
    const Pick pick = scene.renderer->pick(160, 120);
    CHECK(pick.branch != kNoBranch);
    (void)scene.draw(scene.frame);
    REQUIRE(scene.draw(wanted, 0.0).unfinished);
    scene.renderer->request_pick(160, 120);
    CHECK(scene.renderer->poll_pick() == Pick{}); // who only points asks again
    CHECK(scene.renderer->pick(160, 120) == pick);
    CHECK(!scene.draw(wanted, 0.0).shaded);
    (void)scene.draw(scene.frame);
    REQUIRE(scene.draw(wanted, 0.0).unfinished);
    CHECK(scene.renderer->read_branches().branches == branches.branches);
}

TEST_CASE("memory that runs out between parts is told, and the next picture is drawn") {
    const PartsScene scene;
    (void)scene.draw(scene.frame);
    const Frame wanted = with_glass(scene.seen_from(View::kSuperior));
    REQUIRE(scene.draw(wanted, 0.0).unfinished);
    limit_gl_allocation(1000);
    bool failed = false;
    for (bool more = true; more;) {
        const auto done = scene.renderer->draw(wanted, kUploadAll, 0.0);
        failed = !done;
        more = done && done->unfinished;
    }
    limit_gl_allocation();
    CHECK(failed);
    CHECK(scene.draw(wanted).shaded);
}

TEST_CASE("what a pixel of the picture before showed is known while the next one is drawn, and after it" *
          doctest::test_suite("slow")) {
    for (const GlVersion version : {GlVersion{99, 0}, GlVersion{3, 3}}) {
        CAPTURE(version.major);
        const PartsScene scene(version);
        Renderer& renderer = *scene.renderer;
        const Frame before = scene.frame, wanted = scene.seen_from(View::kSuperior);
        const glm::dvec2 size(before.size);
        const auto picks = [&](std::optional<int> of) {
            std::vector<Pick> all;
            for (double y = 0.05; y < 1.0; y += 0.1)
                for (double x = 0.05; x < 1.0; x += 0.1)
                    all.push_back(of ? renderer.pick(x * size.x, y * size.y, *of, before.size).value()
                                     : renderer.pick(x * size.x, y * size.y));
            return all;
        };
        CHECK(renderer.number() == 0);
        (void)scene.draw(wanted);
        const std::vector<Pick> next = picks({});
        (void)scene.draw(before);
        const int shown = renderer.number();
        const std::vector<Pick> first = picks({});
        CHECK(first != next);
        CHECK(picks(shown) == first);
        int parts = 0;
        for (; scene.draw(wanted, 0.0).unfinished; ++parts) {
            CHECK(renderer.number() == shown);
            CHECK(picks(shown) == first);
        }
        CHECK(parts > 3); // asking did not draw the rest
        CHECK(renderer.number() != shown);
        CHECK(picks(shown) == first);
        CHECK(picks(renderer.number()) == next);
        // Colours alone make no other picture of it; one that is given up leaves what is shown.
        Frame red = wanted;
        red.colours.assign(8, glm::vec3(1.0F, 0.0F, 0.0F));
        const int second = renderer.number();
        (void)scene.draw(red);
        CHECK(renderer.number() == second);
        CHECK(scene.draw(before, 0.0).unfinished);
        CHECK(scene.draw(scene.seen_from(View::kLeft), 0.0).unfinished);
        CHECK(picks(second) == next);
        // Of one that is long gone, in a picture of its size alone.
        const glm::dvec2 middle = 0.5 * size;
        CHECK(renderer.pick(middle.x, middle.y, shown, before.size));
        CHECK_FALSE(renderer.pick(middle.x, middle.y, shown, before.size + 1));
    }
}
