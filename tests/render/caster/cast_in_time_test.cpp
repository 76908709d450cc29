// Pictures that the caster makes on a thread of its own, for who has no time to wait: they are those that it makes at
// once, and meanwhile the picture before is shown and answers.
#include "render/renderer/renderer.h"
#include "tests/support/gl_test.h"
#include "tests/support/tube_scene.h"

#include <doctest/doctest.h>

using namespace ramus::render;
using namespace ramus;

namespace {

struct Shown {
    DrawStatistics last;
    int pictures = 0;
};

// Until the frame itself is shown.
Shown draw_in_time(Renderer& renderer, const Frame& frame) {
    Shown shown;
    for (int i = 0; i < 100'000; ++i) {
        const auto done = renderer.draw(frame, kUploadAll, 0.01);
        REQUIRE(done);
        shown.pictures += done->shaded ? 1 : 0;
        shown.last = *done;
        if (!done->unfinished) return shown;
    }
    FAIL("it never comes");
    return shown;
}

} // namespace

TEST_CASE("a picture that is cast in time is the one that is cast at once, and the one before answers meanwhile") {
    const test::WatchedContext context;
    const auto renderer = Renderer::create().value(), at_once = Renderer::create().value();
    Frame frame = test::tube(3.0F, {600, 400});
    REQUIRE(renderer->draw(frame));
    REQUIRE(at_once->draw(frame));
    frame.quality = Quality::kInteractive;
    for (int step = 0; step < 6; ++step) { // the view moves on, whether or not there is a picture of where it was
        frame.camera = turned(frame.camera, 4.0, 1.0);
        const auto done = renderer->draw(frame, kUploadAll, 0.0);
        REQUIRE(done);
        CHECK(done->triangles == 0);
        CHECK(renderer->pick(300, 200).branch == 0);
        CHECK(renderer->read_depths());
    }
    const Shown shown = draw_in_time(*renderer, frame);
    CHECK(shown.pictures >= 1);
    const auto there = at_once->draw(frame);
    REQUIRE(there);
    CHECK(there->cones > 0);
    CHECK(shown.last.cones == there->cones);
    CHECK(renderer->read_image() == at_once->read_image());
    CHECK(renderer->pick(310, 190) == at_once->pick(310, 190));

    const auto same = renderer->draw(frame, kUploadAll, 0.0);
    REQUIRE(same);
    CHECK_FALSE(same->shaded);
    CHECK_FALSE(same->unfinished);
    frame.overlays.caption = "over it"; // casts nothing
    const auto over = renderer->draw(frame, kUploadAll, 0.0);
    REQUIRE(over);
    CHECK(over->shaded);
    CHECK_FALSE(over->unfinished);
    CHECK_FALSE(over->geometry);

    // What is on its way when the view rests is shown by nobody.
    frame.camera = turned(frame.camera, 4.0, 1.0);
    REQUIRE(renderer->draw(frame, kUploadAll, 0.0));
    frame.quality = Quality::kFull;
    const auto full = renderer->draw(frame);
    REQUIRE(full);
    CHECK(full->triangles > 0);
    CHECK(full->cones == 0);
    const Image resting = renderer->read_image();
    REQUIRE(renderer->draw(frame, kUploadAll, 0.0));
    CHECK(renderer->read_image() == resting);
}

TEST_CASE("a picture of another tree that comes late is not taken for one of the tree that is wanted") {
    const test::WatchedContext context;
    const auto renderer = Renderer::create().value();
    Frame frame = test::tube(3.0F, {600, 400}), other = test::tube(2.0F, {600, 400});
    REQUIRE(renderer->draw(frame));
    frame.quality = Quality::kInteractive;
    frame.camera = turned(frame.camera, 4.0, 1.0);
    const auto begun = renderer->draw(frame, kUploadAll, 0.0);
    REQUIRE(begun);
    CHECK_FALSE(begun->of_before);
    other.quality = Quality::kInteractive;
    other.surface_awaited = true; // the caster's, whatever was shown before
    const auto late = renderer->draw(other, kUploadAll, 100.0);
    REQUIRE(late);
    CHECK(late->shaded);
    CHECK(late->of_before == begun->unfinished);
    CHECK(late->unfinished == begun->unfinished);
    const Shown shown = draw_in_time(*renderer, other);
    CHECK_FALSE(shown.last.of_before);
}

TEST_CASE("what is cast when a window changes its size, or is closed, does no harm") {
    const test::WatchedContext context;
    auto renderer = Renderer::create().value();
    Frame frame = test::tube(3.0F, {600, 400});
    REQUIRE(renderer->draw(frame));
    frame.quality = Quality::kInteractive;
    frame.camera = turned(frame.camera, 4.0, 1.0);
    REQUIRE(renderer->draw(frame, kUploadAll, 0.0));
    REQUIRE_FALSE(draw_in_time(*renderer, frame).last.unfinished);
    const Image before = renderer->read_image();
    const Pick under = renderer->pick(300, 200);
    frame.size = {500, 300};
    const auto other = renderer->draw(frame, kUploadAll, 0.0);
    REQUIRE(other);
    if (other->unfinished) { // nobody waits for it: the one before is shown, and answers
        CHECK(renderer->read_image() == before);
        CHECK(renderer->pick(300, 200) == under);
    }
    CHECK(draw_in_time(*renderer, frame).last.triangles == 0);
    const auto at_once = Renderer::create().value();
    Frame elsewhere = frame;
    elsewhere.quality = Quality::kFull;
    elsewhere.camera = turned(frame.camera, 4.0, 1.0);
    REQUIRE(at_once->draw(elsewhere));
    REQUIRE(at_once->draw(frame));
    CHECK(renderer->read_image() == at_once->read_image());
    CHECK(renderer->pick(250, 150) == at_once->pick(250, 150));
    frame.camera = turned(frame.camera, 4.0, 1.0);
    REQUIRE(renderer->draw(frame, kUploadAll, 0.0));
    renderer.reset();
}

TEST_CASE("what lies over a picture that was cast is drawn over it again where a larger one was given up") {
    const test::WatchedContext context;
    const auto renderer = Renderer::create().value(), at_once = Renderer::create().value();
    Frame frame = test::tube(3.0F, {300, 200});
    frame.skeleton = frame.centerlines; // fainter behind vessels: the passes' targets are asked
    REQUIRE(renderer->draw(frame));
    REQUIRE(at_once->draw(frame));
    frame.quality = Quality::kInteractive;
    frame.camera = turned(frame.camera, 4.0, 1.0);
    REQUIRE(renderer->draw(frame));
    REQUIRE(at_once->draw(frame));
    Frame larger = frame;
    larger.quality = Quality::kFull;
    larger.size = {450, 400};
    const auto begun = renderer->draw(larger, kUploadAll, 0.0);
    REQUIRE(begun);
    REQUIRE(begun->unfinished);
    frame.overlays.caption = "over it";
    const auto over = renderer->draw(frame, kUploadAll, 0.0);
    REQUIRE(over);
    CHECK_FALSE(over->geometry);
    REQUIRE(at_once->draw(frame));
    CHECK(renderer->read_image() == at_once->read_image());
    CHECK(renderer->pick(150, 100) == at_once->pick(150, 100));
}
