// Centerlines and rings over the picture, against what geometry says. On every OpenGL down to 3.3.
#include "render/gpu/gpu_lines.h"
#include "tests/support/gl_test.h"
#include "tests/support/tube_scene.h"

#include <algorithm>
#include <cmath>
#include <doctest/doctest.h>
#include <glm/geometric.hpp>

using namespace ramus::render;
using ramus::test::drawn;
using ramus::test::largest_difference;
using ramus::test::tube;
using ramus::test::WatchedContext;

namespace {

// How much brighter a picture of tube() is about a point of its plane.
int change(const Image& image, const Image& before, double x_mm, double z_mm) {
    // The patient's right is at the left.
    const int x = static_cast<int>(150.0 - 10.0 * x_mm), y = static_cast<int>(100.0 - 10.0 * z_mm);
    int most = 0;
    for (int dx = -1; dx <= 1; ++dx)
        for (int dy = -1; dy <= 1; ++dy)
            for (int k = 0; k < 3; ++k)
                most = std::max(most, image.pixel(x + dx, y + dy)[k] - before.pixel(x + dx, y + dy)[k]);
    return most;
}

// The caster's picture of a frame that its camera has just come to.
Image moving(Renderer& renderer, const Frame& frame) {
    Frame before = frame;
    before.camera.scale *= 1.001;
    REQUIRE(renderer.draw(before));
    const auto done = renderer.draw(frame);
    REQUIRE(done);
    CHECK(done->cones > 0);
    return renderer.read_image();
}

} // namespace

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

TEST_CASE("the skeleton lies where it belongs, over what rests and what moves, and not on hidden branches" *
          doctest::test_suite("slow")) {
    Image newest;
    for (const GlVersion version : {GlVersion{99, 0}, GlVersion{3, 3}}) {
        CAPTURE(version.text());
        const WatchedContext context(version);
        const auto renderer = Renderer::create().value();
        Frame frame = tube(4.0F); // 40 pixels; rings at x = -8, 0 and 8 mm
        for (glm::dvec3* position : {&frame.camera.position, &frame.camera.focal_point})
            *position += glm::dvec3(0.05, 0.0, 0.05); // lines run through the middles of pixels
        const Image plain = drawn(*renderer, frame);
        frame.skeleton = frame.centerlines;
        const Image with = drawn(*renderer, frame);
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
        const Image without_lines = moving(*renderer, frame);
        frame.skeleton = frame.centerlines;
        const Image with_lines = moving(*renderer, frame);
        for (const double x : {-11.0, -4.0, 4.0, 11.0}) CHECK(change(with_lines, without_lines, x, 0.0) > 50);
        for (const double x : {-8.0, 8.0}) CHECK(change(with_lines, without_lines, x, 2.5) > 100);
        CHECK(change(with_lines, without_lines, 4.0, 2.0) == 0);
    }
}

TEST_CASE("many lines are drawn in parts, each of so many segments at the most") {
    const WatchedContext context;
    auto lines = std::make_shared<Centerlines>();
    constexpr std::uint32_t kPoints = 25'001; // of each of three branches
    for (int branch = 0; branch < 3; ++branch) {
        lines->runs.push_back({static_cast<std::uint32_t>(lines->points.size()), kPoints});
        for (std::uint32_t i = 0; i < kPoints; ++i) {
            const float x = 0.004F * float(i) - 50.0F;
            lines->points.emplace_back(x, float(branch), i % 2 == 0 ? 0.0F : 1.0F, 0.0F);
            lines->details.push_back({1.0F, branch});
        }
    }
    GpuLines sent;
    sent.follow(lines);
    Camera camera; // so near that every point is needed
    camera.orthographic = true;
    camera.scale = 0.01;
    const auto all = sent.stretches(camera, {400, 300}, {}, {Layer::kOpaque});
    CHECK(all.segments() == 3 * (kPoints - 1));
    const std::uint64_t most = GpuLines::Stretches::kMostInPart;
    CHECK(all.parts() >= (all.segments() + most - 1) / most);
    CHECK(sent.stretches(camera, {400, 300}, {Layer::kOpaque, Layer::kGlass}, {Layer::kGlass}).segments() ==
          kPoints - 1);
    CHECK(sent.stretches(camera, {400, 300}, {}, {Layer::kGlass}).parts() == 0);
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
