// Vessels that press on each other in pictures: while the view moves they look as they do at rest, and a wall of glass
// is one layer.
#include "render/renderer/renderer.h"
#include "tests/support/built_tree.h"
#include "tests/support/gl_test.h"
#include "tests/support/surface_frame.h"

#include <algorithm>
#include <cmath>
#include <doctest/doctest.h>
#include <string>

using namespace ramus::render;

namespace {

// A thick vessel along x, and another one of `radius` that crosses it in front, the axes `distance` apart along y.
Frame crossing_frame(double distance, double radius) {
    const ramus::tree::VesselTree tree = ramus::test::built_tree(
        {{{-30, 0, 0}, 4}, {{30, 0, 0}, 4}, {{1, distance, -30}, radius}, {{-1, distance, 30}, radius}},
        {{0, 1}, {2, 3}}, {0, 2});
    ramus::mesh::SurfaceOptions options;
    options.detail = 24;
    return ramus::test::surface_frame(tree, options, {480, 480});
}

// The picture at rest, or on the way there.
Image drawn_as(Renderer& renderer, Frame frame, Quality quality) {
    frame.quality = quality;
    if (quality == Quality::kInteractive) { // what moves has been somewhere else
        Frame before = frame;
        before.camera = turned(frame.camera, 20.0, 0.0);
        REQUIRE(renderer.draw(before));
    }
    const auto done = renderer.draw(frame);
    REQUIRE(done);
    CHECK((done->cones > 0) == (quality == Quality::kInteractive));
    return renderer.read_image();
}

// What the scale of colours makes of every vessel is its usual colour, but cones have the values and triangles have
// not: so that wide vessels are cast at cones, too, and not drawn by the triangles that they have at rest.
Frame by_cones(Frame frame) {
    frame.scale = {.value = ColourScale::Value::kDiameter,
                   .low = 1.0F,
                   .high = 20.0F,
                   .ramp = {frame.appearance.vessel, frame.appearance.vessel}};
    return frame;
}

// How much the second picture differs from the first where that shows vessels.
struct Compared {
    std::size_t vessels = 0, others = 0; // pixels; those that show another branch
    double sum = 0.0;                    // of differences, of 255
};
Compared compared(const Image& first, const Image& second, const BranchPicture& of_first,
                  const BranchPicture& of_second) {
    Compared found;
    for (std::size_t i = 0; i < of_first.branches.size(); ++i) {
        if (of_first.branches[i] == kNoBranch) continue;
        ++found.vessels;
        found.others += of_second.branches[i] == of_first.branches[i] ? 0 : 1;
        for (std::size_t k = 4 * i; k < 4 * i + 3; ++k) found.sum += std::abs(first.rgba[k] - second.rgba[k]) / 3.0;
    }
    return found;
}

} // namespace

TEST_CASE("vessels that overlap look the same while the view moves" * doctest::test_suite("slow")) {
    for (const double radius : {4.0, 2.0}) {
        for (const double share : {0.5, 0.75, 1.0}) {
            CAPTURE(radius);
            CAPTURE(share);
            const ramus::test::WatchedContext context(GlVersion{99, 0});
            const auto still = Renderer::create().value(), moving = Renderer::create().value();
            Frame frame = crossing_frame(share * (4.0 + radius), radius);
            frame.camera = turned(frame.camera, 25.0, 20.0);
            const Image triangles = drawn_as(*moving, frame, Quality::kInteractive);
            for (const bool cones : {false, true}) {
                CAPTURE(cones);
                const Frame drawn = cones ? by_cones(frame) : frame;
                const Image surface = drawn_as(*still, drawn, Quality::kFull);
                const Image quick = drawn_as(*moving, drawn, Quality::kInteractive);
                CHECK((ramus::test::largest_difference(quick, triangles) > 0) == cones);
                const Compared found = compared(surface, quick, still->read_branches(), moving->read_branches());
                const double mean = found.sum / double(found.vessels);
                MESSAGE(std::string(cones ? "cones" : "triangles")
                        << ", radius " << radius << ", " << share << " of the radii apart: mean difference " << mean
                        << " of 255, " << 100.0 * double(found.others) / double(found.vessels)
                        << " % show another branch");
                REQUIRE(found.vessels > 20'000);
                CHECK(mean < 2.0); // as of vessels without contacts
                CHECK(double(found.others) < 0.01 * double(found.vessels));
            }
        }
    }
}

TEST_CASE("a wall between vessels of glass is one layer" * doctest::test_suite("slow")) {
    for (const GlVersion version : {GlVersion{99, 0}, GlVersion{3, 3}}) {
        CAPTURE(version.text());
        const ramus::test::WatchedContext context(version);
        const auto renderer = Renderer::create().value();
        // In the middle of the picture one looks through both vessels: apart from each other, or through their wall.
        const auto middle = [&](double distance, Quality quality) {
            Frame frame = crossing_frame(distance, 4.0);
            frame.states.assign(2, BranchState::kDefocused);
            const Image picture = drawn_as(*renderer, frame, quality);
            double sum = 0.0;
            for (int y = 232; y < 248; ++y)
                for (int x = 232; x < 248; ++x) sum += picture.pixel(x, y)[1] / 256.0;
            return sum;
        };
        const double apart = middle(10.0, Quality::kFull), wall = middle(4.0, Quality::kFull);
        const double moving = middle(4.0, Quality::kInteractive);
        MESSAGE("apart " << apart << ", with a wall " << wall << ", while it moves " << moving);
        CHECK(std::abs(wall - apart) < 6.0); // a layer more or less is 20
        CHECK(std::abs(moving - wall) < 6.0);
    }
}
