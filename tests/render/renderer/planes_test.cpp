// Slices of a scan among vessels, against geometry: a tube along x of 5 mm radius, seen from the front without
// perspective, 0.1 mm a pixel. Planes that face the eye lie on whole pixels.
#include "render/scene/late_picture.h"
#include "render/scene/seen_plane.h"
#include "tests/support/beside_scene.h"
#include "tests/support/tube_scene.h"

#include <cmath>
#include <cstdint>
#include <doctest/doctest.h>
#include <glm/geometric.hpp>
#include <random>

using namespace ramus::render;
using namespace ramus::test;

namespace {

using SliceScene = ramus::test::BesideScene;

constexpr GlVersion kVersions[] = {{4, 5}, {3, 3}};

std::shared_ptr<const Image> grey(int value, glm::ivec2 size = {2, 2}) {
    auto image = std::make_shared<Image>(size.x, size.y);
    image->fill(glm::vec3(float(value) / 255.0F));
    return image;
}

std::shared_ptr<const Image> noise(glm::ivec2 size) {
    auto image = std::make_shared<Image>(size.x, size.y);
    std::mt19937 random(3);
    for (std::uint8_t& byte : image->rgba) byte = static_cast<std::uint8_t>(random());
    for (std::size_t i = 3; i < image->rgba.size(); i += 4) image->rgba[i] = 255;
    return image;
}

std::shared_ptr<const LatePicture> late(const std::shared_ptr<const Image>& picture) {
    return picture ? std::make_shared<const LatePicture>(*picture) : nullptr;
}

// 20 x 12 mm across the view axis, or turned about the vertical: y = slope x.
ScanPlane facing(double y, const std::shared_ptr<const Image>& picture) {
    return {{10, y, 6}, {-20, 0, 0}, {0, 0, -12}, late(picture), glm::vec3(0.9F), 0.0F};
}
ScanPlane slanted(double slope, const std::shared_ptr<const Image>& picture) {
    return {{14, 14 * slope, 6}, {-28, -28 * slope, 0}, {0, 0, -12}, late(picture), glm::vec3(0.9F), 0.0F};
}

constexpr glm::ivec2 kCorner{200, 90}, kPixels{200, 120}; // of facing(), in the picture

// Without `border` pixels at the slice's edge.
int largest_difference_to(const Image& image, const Image& slice, int border = 0) {
    int largest = 0;
    for (int y = border; y < kPixels.y - border; ++y)
        for (int x = border; x < kPixels.x - border; ++x)
            for (int c = 0; c < 4; ++c)
                largest =
                    std::max(largest, std::abs(image.pixel(kCorner.x + x, kCorner.y + y)[c] - slice.pixel(x, y)[c]));
    return largest;
}

bool is_grey(const std::uint8_t* pixel, int value) {
    return pixel[0] == value && pixel[1] == value && pixel[2] == value;
}

} // namespace

TEST_CASE("a slice that faces the eye shows its own bytes, from both sides, at rest and refined") {
    for (const GlVersion newest : kVersions)
        for (const bool from_behind : {false, true}) {
            CAPTURE(newest.text());
            SliceScene scene(newest);
            const auto picture = noise(kPixels);
            const Image without = scene.picture();
            ScanPlane plane = facing(20, picture);
            if (from_behind) { // the same pixels, but the corner's neighbours change places
                auto turned_over = std::make_shared<Image>(kPixels.y, kPixels.x);
                for (int y = 0; y < kPixels.y; ++y)
                    for (int x = 0; x < kPixels.x; ++x) std::copy_n(picture->pixel(x, y), 4, turned_over->pixel(y, x));
                std::swap(plane.right, plane.down);
                plane.picture = late(turned_over);
            }
            scene.frame.planes = {plane};
            const Image with = scene.picture();
            CHECK(largest_difference_to(with, *picture) == 0);
            for (bool more = true; more;) {
                const auto refined = scene.renderer->refine();
                REQUIRE(refined);
                more = refined->more;
            }
            CHECK(largest_difference_to(scene.renderer->read_image(), *picture, 1) == 0);
            // Beside it nothing changes.
            scene.frame.planes[0].corner.z += 1e-9; // shaded again
            Image rest = scene.picture();
            for (int y = 0; y < kPixels.y; ++y)
                std::copy_n(without.pixel(kCorner.x, kCorner.y + y), 4 * kPixels.x,
                            rest.pixel(kCorner.x, kCorner.y + y));
            CHECK(largest_difference(rest, without) == 0);
        }
}

TEST_CASE("vessels and slices hide each other where geometry says") {
    for (const GlVersion newest : kVersions) {
        CAPTURE(newest.text());
        SliceScene scene(newest);
        const Image tube = scene.picture();
        scene.frame.planes = {facing(0, grey(90))}; // through the axis
        const Image middle = scene.picture();
        for (double z = -5.9; z < 6.0; z += 0.1) {
            if (std::abs(std::abs(z) - kTube) < 0.15) continue; // a mixed pixel
            CAPTURE(z);
            const bool slice = std::abs(z) > kTube;
            CHECK(is_grey(scene.colour(middle, 3, z), 90) == slice);
            if (!slice) CHECK(apart(scene.colour(middle, 3, z), scene.colour(tube, 3, z)) == 0);
        }
        // y = x: before the front of the tube where x is over sqrt(25 - z^2).
        scene.frame.planes = {slanted(1.0, grey(90))};
        const Image across = scene.picture();
        for (const double z : {0.0, 2.0, -3.0, 4.0})
            for (double x = -13.0; x < 13.0; x += 0.1) {
                const double front = std::sqrt(kTube * kTube - z * z);
                if (std::abs(x - front) < 0.15) continue;
                CAPTURE(x);
                const bool slice = x > front;
                CHECK(is_grey(scene.colour(across, x, z), 90) == slice);
                if (!slice) CHECK(apart(scene.colour(across, x, z), scene.colour(tube, x, z)) == 0);
            }
    }
}

TEST_CASE("slices that cross show the nearer one on each side, and an outline where nothing hides it") {
    for (const GlVersion newest : kVersions) {
        CAPTURE(newest.text());
        SliceScene scene(newest);
        scene.frame.states[0] = BranchState::kHidden;
        scene.frame.planes = {slanted(1.0, grey(60)), slanted(-1.0, grey(180))};
        const Image both = scene.picture();
        for (double x = -13.5; x < 13.5; x += 0.1) {
            if (std::abs(x) < 0.15) continue;
            CAPTURE(x);
            CHECK(is_grey(scene.colour(both, x, 1.0), x > 0 ? 60 : 180));
        }
        scene.frame.planes = {facing(0, grey(60)), facing(10, grey(180))};
        scene.frame.planes[0].outline = glm::vec3(0.0F, 1.0F, 0.0F);
        scene.frame.planes[0].outline_width = 3.0F; // points, a pixel each
        scene.frame.planes[1].corner.x += 15.0;     // covers the left part
        const Image framed = scene.picture();
        const auto is_green = [&](double x, double z) {
            const std::uint8_t* p = scene.colour(framed, x, z);
            return p[0] == 0 && p[1] == 255 && p[2] == 0;
        };
        CHECK(is_green(0, 6.15));
        CHECK(is_green(0, -6.15));
        CHECK(is_green(-10.15, 0));
        CHECK_FALSE(is_green(0, 6.45));
        CHECK_FALSE(is_green(0, 5.85));
        CHECK(is_grey(scene.colour(framed, 9.85, 0), 180)); // before the left edge
    }
}

TEST_CASE("glass before a slice veils it as reckoned by hand, and glass behind it is not seen") {
    for (const GlVersion newest : kVersions) {
        CAPTURE(newest.text());
        SliceScene scene(newest);
        scene.frame.states[0] = BranchState::kHidden;
        scene.add_sphere(0.4F);
        scene.frame.planes = {facing(20, grey(120))};
        const Image before = scene.picture();
        CHECK(is_grey(scene.colour(before, 0, 0), 120));
        CHECK(is_grey(scene.colour(before, 8, 3), 120));
        for (const double y : {0.0, -20.0}) { // half of the sphere, and all of it: back faces are not drawn
            scene.frame.planes = {facing(y, grey(120))};
            const Image veiled = scene.picture();
            for (const glm::dvec2 at : {glm::dvec2(0.05, 0.05), {4.05, 3.05}, {-7.95, -2.05}}) {
                const glm::dvec2 across = at / kSphere;
                const glm::dvec3 normal(-across.x, across.y, std::sqrt(1.0 - glm::dot(across, across)));
                const glm::dvec4 veil = veil_of(kColour, 0.4, normal);
                for (int k = 0; k < 3; ++k) {
                    const double slice = double(linear(120.0F / 255.0F)), share = veil.w;
                    const double shown = share * (encoded(veil[k] / share) > 0 ? veil[k] / share : 0.0);
                    const double tone =
                        shown / share < 0.72 ? shown : share * double(linear(float(encoded(shown / share) / 255.0)));
                    const double light = tone + (1.0 - share) * slice;
                    const double byte = 255.0 * (1.055 * std::pow(light, 1.0 / 2.4) - 0.055);
                    CHECK(std::abs(byte - double(scene.colour(veiled, at.x, at.y)[k])) < 2.5);
                }
            }
        }
        // Glass vessels: the tube's front before the plane through its axis, nothing of its inside behind it.
        scene.frame.context.clear();
        scene.frame.states[0] = BranchState::kDefocused;
        scene.frame.planes = {facing(10, grey(120))};
        CHECK(is_grey(scene.colour(scene.picture(), 0, 0), 120));
        scene.frame.planes = {facing(0, grey(120))};
        const Image front = scene.picture();
        CHECK_FALSE(is_grey(scene.colour(front, 0, 4.5), 120));
        CHECK(is_grey(scene.colour(front, 0, 5.3), 120));
    }
}

TEST_CASE("a plane that moves, or shows another picture, draws no vessel again; an equal frame draws nothing") {
    for (const GlVersion newest : kVersions) {
        CAPTURE(newest.text());
        SliceScene scene(newest);
        scene.frame.planes = {slanted(1.0, noise({64, 40})), facing(-3, grey(50))};
        CHECK(scene.draw().geometry);
        CHECK_FALSE(scene.draw().shaded);
        for (int step = 0; step < 3; ++step) {
            scene.frame.planes[1].corner.y += 2.0;
            if (step == 1) scene.frame.planes[0].picture = late(noise({80, 20}));
            if (step == 2) scene.frame.planes.pop_back();
            const DrawStatistics done = scene.draw();
            CHECK(done.triangles == 0);
            CHECK_FALSE(done.geometry);
            CHECK(done.shaded);
            const auto afresh = Renderer::create().value();
            REQUIRE(afresh->draw(scene.frame));
            CHECK(largest_difference(scene.renderer->read_image(), afresh->read_image()) == 0);
            CHECK_FALSE(scene.draw().shaded);
        }
        scene.frame.planes.clear();
        const Image none = scene.picture();
        CHECK_FALSE(scene.draw().shaded);
        const auto afresh = Renderer::create().value();
        REQUIRE(afresh->draw(scene.frame));
        CHECK(largest_difference(none, afresh->read_image()) == 0);
    }
}

TEST_CASE("a click finds the plane and the place, unless a vessel is before it; depths count planes") {
    SliceScene scene;
    auto with_hole = std::make_shared<Image>(*grey(90, {20, 12}));
    for (int x = 0; x < 5; ++x)
        for (int y = 0; y < 12; ++y) with_hole->pixel(x, y)[3] = 0; // outside the scan: x over 5 mm
    scene.frame.planes = {facing(-30, grey(10)), slanted(1.0, grey(70)), facing(0, with_hole)};
    (void)scene.draw();
    const auto near = [](const glm::dvec3& a, const glm::dvec3& b) { return glm::distance(a, b) < 0.1; };
    const Pick vessel = scene.pick(2, 0); // its front is at y = 5, the slanted plane at y = 2
    CHECK(vessel.branch == 0);
    CHECK(vessel.plane == kNoPlane);
    const Pick front = scene.pick(8, 0);
    CHECK(front.branch == kNoBranch);
    CHECK(front.plane == 1);
    CHECK(near(front.position, {8, 8, 0}));
    const Pick middle = scene.pick(-8, 5.8);
    CHECK(middle.plane == 2);
    CHECK(near(middle.position, {-8, 0, 5.8}));
    scene.frame.planes.erase(scene.frame.planes.begin() + 1);
    (void)scene.draw();
    CHECK(scene.pick(-8, 5.8).plane == 1);
    CHECK(scene.pick(8, 5.8).plane == 0); // through the hole
    CHECK(scene.pick(13, 8).plane == kNoPlane);

    const auto map = scene.renderer->read_depths();
    REQUIRE(map);
    const auto point = map->point_at(glm::dvec2(scene.at(-8, 5.8)) + 0.5, 2.0);
    REQUIRE(point);
    CHECK(std::abs(point->y) < 0.05);
    const auto on_tube = map->point_at(glm::dvec2(scene.at(-8, 0)) + 0.5, 2.0);
    REQUIRE(on_tube);
    CHECK(std::abs(on_tube->y - kTube) < 0.05);
}

TEST_CASE("while the view moves the caster draws planes as they are drawn at rest") {
    const WatchedContext context;
    const auto renderer = Renderer::create().value();
    Frame frame = tube(5.0F, {300, 200});
    frame.planes = {{{10, 0, 7}, {-20, 0, 0}, {0, 0, -14}, late(grey(120)), glm::vec3(0.9F, 0.8F, 0.1F), 2.0F},
                    {{0, 9, 9}, {0, -18, 0}, {0, 0, -18}, late(grey(60)), glm::vec3(0.9F), 0.0F}};
    frame.camera = turned(frame.camera, 25.0, 20.0);
    REQUIRE(renderer->draw(frame));
    frame.quality = Quality::kInteractive;
    frame.camera = turned(frame.camera, 5.0, 0.0);
    const auto moving = renderer->draw(frame);
    REQUIRE(moving);
    CHECK(moving->cones > 0);
    const Image cast = renderer->read_image();
    const glm::dvec3 seen = *project(frame.camera, frame.size, {-6, 0, 6.2});
    const Pick pick = renderer->pick(seen.x, seen.y);
    CHECK(pick.plane == 0);
    CHECK(glm::distance(pick.position, glm::dvec3(-6, 0, 6.2)) < 0.1);
    frame.quality = Quality::kFull;
    REQUIRE(renderer->draw(frame));
    const auto difference = compare(cast, renderer->read_image(), 24);
    REQUIRE(difference);
    CHECK(difference->fraction() < 0.004);
    const std::uint8_t* p = cast.pixel(int(seen.x), int(seen.y));
    CHECK(is_grey(p, 120));
}

TEST_CASE("a plane seen from its edge, behind the eye or around it draws no wrong pixel") {
    SliceScene scene;
    const Image without = scene.picture();
    scene.frame.planes = {{{0, -10, 6}, {0, 20, 0}, {0, 0, -12}, late(grey(90)), glm::vec3(0.0F), 0.0F}};
    CHECK(largest_difference(scene.picture(), without) == 0);
    scene.frame.planes[0].right = {0, 0, 0}; // no area
    CHECK(largest_difference(scene.picture(), without) == 0);
    scene.frame.planes = {facing(20, nullptr), facing(20, std::make_shared<Image>())}; // no pixels
    auto broken = std::make_shared<Image>();
    broken->width = broken->height = 20;
    broken->rgba.assign(100, 200);
    scene.frame.planes.push_back(facing(20, broken));
    scene.frame.planes.push_back(facing(std::nan(""), grey(90)));
    CHECK(largest_difference(scene.picture(), without) == 0);
    CHECK(scene.pick(0, 0).branch == 0);
    scene.frame.camera.orthographic = false;
    scene.frame.planes.clear();
    const Image perspective = scene.picture();
    const glm::dvec3 eye = scene.frame.camera.position;
    scene.frame.planes = {
        {eye + glm::dvec3(10, 30, 10), {-20, 0, 0}, {0, 0, -20}, late(grey(90)), glm::vec3(0.0F), 2.0F}};
    CHECK(largest_difference(scene.picture(), perspective) == 0);
    // Below the eye and through it: only the lower half of the picture shows it.
    scene.frame.planes = {
        {eye + glm::dvec3(100, 100, -1), {-200, 0, 0}, {0, -200, 0}, late(grey(90)), glm::vec3(0.0F), 2.0F}};
    const Image floor = scene.picture();
    const int height = scene.frame.size.y;
    for (int y = 0; y < height / 2; ++y)
        for (int x = 0; x < floor.width; x += 7) CHECK(apart(floor.pixel(x, y), perspective.pixel(x, y)) == 0);
    CHECK(is_grey(floor.pixel(300, height - 1), 90));
}
