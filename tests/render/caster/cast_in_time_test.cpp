// Pictures that the caster makes on a thread of its own, for who has no time to wait: they are those that it makes at
// once, and meanwhile the picture before is shown and answers.
#include "render/renderer/renderer.h"
#include "tests/support/gl_test.h"
#include "tests/support/tube_scene.h"

#include <doctest/doctest.h>
#include <fstream>
#include <string>
#include <sys/resource.h>
#include <unistd.h>

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

// While it lives the process gets so much memory beside what it has, and no more.
class LessMemory {
public:
    explicit LessMemory(std::size_t bytes) {
        std::size_t pages = 0;
        std::ifstream("/proc/self/statm") >> pages;
        REQUIRE(::getrlimit(RLIMIT_AS, &before_) == 0);
        rlimit less = before_;
        less.rlim_cur = pages * static_cast<std::size_t>(::sysconf(_SC_PAGESIZE)) + bytes;
        REQUIRE(::setrlimit(RLIMIT_AS, &less) == 0);
    }
    ~LessMemory() { ::setrlimit(RLIMIT_AS, &before_); }
    LessMemory(const LessMemory&) = delete;
    LessMemory& operator=(const LessMemory&) = delete;

private:
    rlimit before_{};
};

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

TEST_CASE("who asks what lies under a pixel is told of nothing where there is no memory for what was cast") {
    const test::WatchedContext context;
    const auto renderer = Renderer::create().value();
    const Frame frame = test::tube(3.0F);
    Frame next = frame, moving = frame;
    next.camera = turned(frame.camera, 30.0, 0.0);
    moving.camera = turned(frame.camera, 4.0, 1.0);
    moving.size = {450, 300};
    moving.quality = Quality::kInteractive;
    enum class Ask { kPick, kBranches, kDepths };
    for (const Ask ask : {Ask::kPick, Ask::kBranches, Ask::kDepths}) {
        bool neither = false; // the targets have: a thread that has its processor to itself may be done at once
        for (int tries = 0; tries < 100 && !neither; ++tries) {
            REQUIRE(renderer->draw(frame));
            neither = renderer->draw(next, kUploadAll, 0.0)->unfinished;
            neither = renderer->draw(moving, kUploadAll, 0.0)->unfinished && neither;
        }
        REQUIRE(neither);
        limit_gl_allocation(1000);
        if (ask == Ask::kPick) CHECK(renderer->pick(150, 100) == Pick{});
        if (ask == Ask::kBranches) CHECK(renderer->read_branches().branches.empty());
        if (ask == Ask::kDepths) CHECK_FALSE(renderer->read_depths());
        limit_gl_allocation();
    }
    REQUIRE(renderer->draw(frame));
    CHECK(renderer->pick(150, 100).branch == 0);
}

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__) // they want all addresses that there are
TEST_CASE("a picture that the processor has no memory to cast is an error, and the next one is drawn" *
          doctest::test_suite("slow")) {
    const test::WatchedContext context;
    const auto renderer = Renderer::create().value(), other = Renderer::create().value();
    const Frame frame = test::tube(3.0F);
    for (const double seconds : {kUntilDone, 60.0}) { // at once, or on a thread
        CAPTURE(seconds);
        REQUIRE(renderer->draw(frame));
        REQUIRE(other->draw(frame));
        Frame moving = frame;
        moving.quality = Quality::kInteractive;
        for (int step = 0; step < 2; ++step) { // both of its casters have been used
            moving.camera = turned(moving.camera, 4.0, 1.0);
            (void)draw_in_time(*renderer, moving);
        }
        Frame large = moving;
        large.size = {3000, 3000};
        large.camera = turned(moving.camera, 4.0, 1.0);
        const auto refused = [&] {
            const LessMemory less(std::size_t{100} << 20); // three numbers a pixel, of ten
            return renderer->draw(large, kUploadAll, seconds);
        }();
        REQUIRE_FALSE(refused.has_value());
        CHECK(refused.error().message().find("not enough memory") != std::string::npos);
        CHECK_FALSE(refused.error().hint.empty());
        REQUIRE(renderer->draw(frame));
        REQUIRE(draw_in_time(*renderer, moving).last.cones > 0);
        REQUIRE(draw_in_time(*other, moving).last.cones > 0);
        CHECK(renderer->read_image() == other->read_image());
        CHECK(renderer->pick(150, 100) == other->pick(150, 100));
    }
}
#endif
