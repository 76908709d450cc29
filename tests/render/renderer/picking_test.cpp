// What lies under a pixel.
#include "tests/support/small_tree.h"

#include <cmath>
#include <glm/geometric.hpp>

using namespace ramus::render;
using ramus::test::SmallTree;

TEST_CASE("picking finds the branch, at its position in the patient") {
    for (const bool orthographic : {false, true}) {
        SmallTree scene;
        scene.frame.camera = camera_for(scene.frame.mesh->positions(), View::kAnterior, scene.frame.size, orthographic);
        scene.draw();
        const double pixel_mm = mm_per_pixel(scene.frame.camera, scene.frame.size);
        // The anterior-most line of the trunk at z = -25: y = its radius there, 4.875 mm.
        const glm::dvec3 trunk(0.0, 4.875, -25.0);
        glm::dvec2 at = scene.pixel_of(trunk);
        Pick pick = scene.renderer->pick(at.x, at.y);
        CHECK(pick.branch == 0);
        CHECK(glm::distance(pick.position, trunk) < 1.0 * pixel_mm);
        // The twig lies before the trunk.
        const glm::dvec3 twig(0.0, 13.0, -12.0);
        at = scene.pixel_of(twig);
        pick = scene.renderer->pick(at.x, at.y);
        CHECK(pick.branch == 3);
        CHECK(glm::distance(pick.position, twig) < 1.5 * pixel_mm);
        // The arm to the patient's left is at the right of the picture.
        at = scene.pixel_of({-15.0, 0.0, 22.0});
        CHECK(at.x > 0.5 * scene.frame.size.x);
        CHECK(scene.renderer->pick(at.x, at.y).branch == 1);
        CHECK(scene.renderer->pick(1.0, 1.0).branch == kNoBranch);
        CHECK(scene.renderer->pick(-50.0, 1e9).branch == kNoBranch);
        CHECK(scene.renderer->pick(std::nan(""), 0.0).branch == kNoBranch);
    }
}

TEST_CASE("a thin vessel is picked up to four pixels beside it, and no farther") {
    SmallTree scene;
    scene.draw();
    // The twig's lower edge left of the trunk, in the picture.
    const glm::dvec2 on = scene.pixel_of({16.0, 12.0, -10.4});
    double edge = on.y;
    while (scene.draw() == scene.draw() && scene.renderer->pick(on.x, edge + 4.0).branch == 3) edge += 0.5;
    const double radius_pixels = 1.0 / mm_per_pixel(scene.frame.camera, scene.frame.size);
    CHECK(edge + 4.0 - on.y > radius_pixels + 3.0);
    CHECK(edge + 4.0 - on.y < radius_pixels + 7.5);
}

TEST_CASE("picking without waiting gives the same answers") {
    SmallTree scene;
    scene.draw();
    CHECK_FALSE(scene.renderer->poll_pick().has_value());
    for (const glm::dvec3& point :
         {glm::dvec3(0, 4.9, -25), glm::dvec3(0, 13, -12), glm::dvec3(-15, 0, 22), glm::dvec3(-30, 0, -30)}) {
        const glm::dvec2 at = scene.pixel_of(point);
        scene.renderer->request_pick(1.0, 1.0); // replaced
        scene.renderer->request_pick(at.x, at.y);
        std::optional<Pick> pick;
        for (int i = 0; i < 100000 && !pick; ++i) pick = scene.renderer->poll_pick();
        REQUIRE(pick.has_value());
        CHECK(*pick == scene.renderer->pick(at.x, at.y));
        CHECK_FALSE(scene.renderer->poll_pick().has_value());
    }
}

TEST_CASE("the picture of branches says what pick says") {
    SmallTree scene;
    scene.frame.states[2] = BranchState::kHidden;
    scene.frame.states[0] = BranchState::kDefocused;
    for (const Quality quality : {Quality::kFull, Quality::kInteractive}) {
        scene.frame.quality = quality;
        (void)scene.draw();
        const BranchPicture picture = scene.renderer->read_branches();
        REQUIRE(picture.width == 400);
        REQUIRE(picture.height == 300);
        std::array<int, 5> seen{};
        for (int y = 0; y < 300; y += 7)
            for (int x = 0; x < 400; x += 7) {
                const int branch = picture.at(x + 0.5, y + 0.5);
                ++seen[static_cast<std::size_t>(branch + 1)];
                // A pick finds also what a pixel just misses.
                if (branch != kNoBranch) CHECK(scene.renderer->pick(x + 0.5, y + 0.5).branch == branch);
            }
        for (const std::size_t i : {0, 1, 2, 4}) CHECK(seen[i] > 0);
        CHECK(seen[3] == 0); // it is hidden
        CHECK(picture.at(-0.5, 10.0) == kNoBranch);
        CHECK(picture.at(400.0, 10.0) == kNoBranch);
    }
}
