// Pictures that get finer while nobody does anything.
#include "render/gl/gl_context.h"
#include "render/gl/gl_objects.h"
#include "render/renderer/renderer.h"
#include "render/renderer/sheet.h"
#include "tests/support/crossing_vessels.h"
#include "tests/support/gl_test.h"
#include "tests/support/tube_scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <doctest/doctest.h>
#include <utility>

using namespace ramus::render;
using ramus::test::largest_difference;
using ramus::test::with_glass;

namespace {

struct RefinedScene : ramus::test::CrossingVessels {
    explicit RefinedScene(GlVersion newest = {99, 0}) : CrossingVessels(newest, 24) {
        frame.overlays.orientation_cube = frame.overlays.scale_bar = false;
    }
    [[nodiscard]] Refined refine_a_part() const {
        SheetRenderer::finish(); // so that every call does one
        return renderer->refine(0.0).value();
    }
    [[nodiscard]] Image drawn(const Frame& of) const {
        (void)draw(of);
        return renderer->read_image();
    }
    [[nodiscard]] Image refined(const Frame& of) const {
        (void)draw(of);
        CHECK(renderer->refine()->changed);
        return renderer->read_image();
    }
};

// With glass or without, on which OpenGL: all that is drawn in ways of its own.
struct Kind {
    bool glass;
    GlVersion version;
};
constexpr std::array<Kind, 3> kKinds{{{false, {99, 0}}, {true, {99, 0}}, {true, {3, 3}}}};

// How much of each pixel vessels cover, of 255.
std::vector<double> covered(const Image& picture, int times) {
    const int width = picture.width / times, height = picture.height / times;
    std::vector<double> shares;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            double sum = 0.0;
            for (int j = 0; j < times; ++j)
                for (int i = 0; i < times; ++i) sum += picture.pixel(times * x + i, times * y + j)[3];
            shares.push_back(sum / (times * times));
        }
    return shares;
}

// Root of the mean of squares, over pixels that are covered in part.
double apart(const std::vector<double>& wanted, const std::vector<double>& found) {
    double sum = 0.0;
    int count = 0;
    for (std::size_t i = 0; i < wanted.size(); ++i)
        if (wanted[i] > 0.0 && wanted[i] < 255.0) sum += std::pow(wanted[i] - found[i], 2.0), ++count;
    REQUIRE(count > 500);
    return std::sqrt(sum / count);
}

} // namespace

TEST_CASE("a refined picture has four times the samples at its edges" * doctest::test_suite("slow")) {
    for (const bool orthographic : {false, true}) {
        CAPTURE(orthographic);
        const RefinedScene scene;
        Frame frame = scene.frame;
        frame.background.transparent = true;
        frame.camera.orthographic = orthographic;
        constexpr int kTimes = 8; // so many times the size has 256 samples for each pixel
        Frame large = frame;
        large.size *= kTimes;
        const auto wanted = covered(scene.drawn(large), kTimes);
        const double before = apart(wanted, covered(scene.drawn(frame), 1));
        const double after = apart(wanted, covered(scene.refined(frame), 1));
        MESSAGE("off by " << before << " of 255 at edges, refined by " << after);
        CHECK(after < 0.55 * before);
    }
}

TEST_CASE("refining takes as many calls as it likes, and ends" * doctest::test_suite("slow")) {
    for (const Kind& kind : kKinds) {
        CAPTURE(kind.glass);
        CAPTURE(kind.version.major);
        const RefinedScene scene(kind.version);
        const Frame frame = kind.glass ? with_glass(scene.frame) : scene.frame;
        const Image coarse = scene.drawn(frame), at_once = scene.refined(frame);
        CHECK(largest_difference(coarse, at_once) > 8);
        Frame other = frame;
        other.hovered = 2;
        (void)scene.draw(other);
        if (gl_has_lists())
            REQUIRE(largest_difference(scene.drawn(frame), coarse) > 0); // some of it is still the finer one
        CHECK(largest_difference(scene.refined(frame), at_once) == 0);

        Frame away = frame;
        away.camera = turned(frame.camera, 20.0, 0.0);
        (void)scene.draw(away);
        REQUIRE(largest_difference(scene.drawn(frame), coarse) == 0);
        int calls = 0, changes = 0;
        for (bool more = true; more; ++calls) {
            const Refined done = scene.refine_a_part();
            more = done.more;
            changes += done.changed ? 1 : 0;
            REQUIRE(calls < 1000);
        }
        CHECK(calls > 3);
        CHECK(changes == 3);
        CHECK(largest_difference(scene.renderer->read_image(), at_once) == 0);
        CHECK_FALSE(scene.renderer->refine()->changed); // there is nothing left to do
        CHECK_FALSE(scene.draw(frame).shaded);
        CHECK(largest_difference(scene.renderer->read_image(), at_once) == 0);
    }
}

TEST_CASE("what is under a pixel stays what it is while a picture is refined" * doctest::test_suite("slow")) {
    for (const GlVersion version : {GlVersion{99, 0}, GlVersion{3, 3}}) {
        const RefinedScene scene(version);
        (void)scene.draw(scene.frame);
        const BranchPicture branches = scene.renderer->read_branches();
        const auto there = std::ranges::find_if(branches.branches, [](int branch) { return branch != kNoBranch; });
        REQUIRE(there != branches.branches.end());
        const auto at = static_cast<int>(there - branches.branches.begin());
        const int x = at % branches.width, y = at / branches.width;
        const Pick pick = scene.renderer->pick(x, y);
        REQUIRE(pick.branch != kNoBranch);
        for (bool more = true; more;) {
            more = scene.refine_a_part().more;
            REQUIRE(scene.renderer->pick(x, y) == pick);
        }
        CHECK(scene.renderer->read_branches().branches == branches.branches);
    }
}

TEST_CASE("refining stops for whatever is wanted next, and leaves nothing behind" * doctest::test_suite("slow")) {
    const RefinedScene scene;
    const Frame plain = scene.frame, glass = with_glass(scene.frame);
    Frame hovered = plain, small = plain, quick = plain;
    hovered.hovered = 3;
    small.size = {100, 60};
    quick.quality = Quality::kInteractive;
    for (const Frame& start : {plain, glass})
        for (const int calls : {1, 2, 5}) {
            for (const Frame& next : {glass, small, quick}) {
                const Image wanted = scene.drawn(next);
                (void)scene.draw(start);
                for (int n = 0; n < calls; ++n) (void)scene.refine_a_part();
                if (next != start) CHECK(largest_difference(scene.drawn(next), wanted) == 0);
            }
        }
    // Not what is not full; nor without a picture.
    (void)scene.draw(quick);
    CHECK_FALSE(scene.renderer->refine()->more);
    CHECK_FALSE(Renderer::create().value()->refine()->more);
}

TEST_CASE("where memory runs out a picture stays as it is, and the next one is drawn" * doctest::test_suite("slow")) {
    for (const Kind& kind : kKinds) {
        CAPTURE(kind.glass);
        CAPTURE(kind.version.major);
        const RefinedScene scene(kind.version);
        const Frame frame = kind.glass ? with_glass(scene.frame) : scene.frame;
        Frame away = frame;
        away.camera = turned(frame.camera, 20.0, 0.0);
        const Image coarse = scene.drawn(frame), elsewhere = scene.drawn(away);
        int stopped = 0;
        for (std::size_t limit = 1024; limit < (std::size_t{64} << 20); limit *= 4) {
            CAPTURE(limit);
            REQUIRE(largest_difference(scene.drawn(frame), coarse) == 0);
            limit_gl_allocation(limit);
            const Refined done = scene.renderer->refine().value();
            limit_gl_allocation();
            CHECK_FALSE(done.more);
            stopped += done.changed ? 0 : 1;
            CHECK((largest_difference(scene.renderer->read_image(), coarse) > 0) == done.changed);
            CHECK(largest_difference(scene.drawn(away), elsewhere) == 0);
        }
        CHECK(stopped > 3);
    }
}

TEST_CASE("a finer picture that there is no memory to show is an error, and the next one is drawn" *
          doctest::test_suite("slow")) {
    const ramus::test::WatchedContext context;
    const auto renderer = Renderer::create().value();
    Frame frame = ramus::test::tube(4.0F);
    MarkLine line; // longer than all that the picture is drawn into
    for (int i = 0; i < 100'000; ++i) line.points.emplace_back(-10.0 + 2e-4 * i, 0.0, 6.0);
    frame.lines = {line};
    REQUIRE(renderer->draw(frame));
    const Image expected = renderer->read_image();
    limit_gl_allocation(std::size_t{8} << 20);
    const auto refused = renderer->refine();
    limit_gl_allocation();
    REQUIRE_FALSE(refused);
    CHECK(refused.error().message().find("out of graphics memory") != std::string::npos);
    CHECK(renderer->pick(150, 100) == Pick{});
    REQUIRE(renderer->draw(frame));
    CHECK(renderer->read_image() == expected);
    CHECK(renderer->refine()->changed);
}
