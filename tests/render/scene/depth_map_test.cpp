// What lies under a pixel, and the middle of what is visible, from depths.
#include "render/overlay/scale_bar.h"
#include "render/scene/camera_moves.h"
#include "render/scene/depth_map.h"

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

using namespace ramus::render;

namespace {

const glm::ivec2 kPicture(400, 300);

DepthMap map_of(const Camera& camera) {
    DepthMap map;
    map.camera = camera;
    map.picture = kPicture;
    map.size = DepthMap::size_for(kPicture);
    map.depths.assign(static_cast<std::size_t>(map.size.x) * static_cast<std::size_t>(map.size.y), DepthMap::kEmpty);
    return map;
}

// The places under these pixels of the picture (from the top left) are so far away.
void fill(DepthMap& map, glm::ivec2 from, glm::ivec2 to, float depth) {
    for (int y = from.y / 2; y < to.y / 2; ++y)
        for (int x = from.x / 2; x < to.x / 2; ++x)
            map.depths[static_cast<std::size_t>(map.size.y - 1 - y) * static_cast<std::size_t>(map.size.x) +
                       static_cast<std::size_t>(x)] = depth;
}

} // namespace

TEST_CASE("a pixel shows the point at its depth, and one beside it the nearest within reach") {
    for (const bool orthographic : {false, true}) {
        Camera camera;
        camera.orthographic = orthographic;
        DepthMap map = map_of(camera);
        CHECK_FALSE(map.point_at({100.0, 50.0}, 4.0));
        CHECK_FALSE(map.nearest_point({100.0, 50.0}));
        fill(map, {100, 40}, {120, 60}, 480.0F);
        const auto under = map.point_at({110.3, 50.7}, 4.0);
        REQUIRE(under);
        CHECK(glm::distance(*under, unproject(camera, kPicture, {110.3, 50.7}, 480.0)) < 1e-6);
        const auto beside = map.point_at({97.5, 50.7}, 4.0);
        REQUIRE(beside);
        const glm::dvec3 seen = *project(camera, kPicture, *beside);
        CHECK(seen.x == doctest::Approx(101.0)); // the middle of the first place
        CHECK(seen.z == doctest::Approx(480.0));
        CHECK_FALSE(map.point_at({90.0, 50.0}, 4.0));
        CHECK_FALSE(map.point_at({-30.0, 1e7}, 4.0));
        const auto far = map.nearest_point({399.0, 299.0});
        REQUIRE(far);
        CHECK(project(camera, kPicture, *far)->x == doctest::Approx(119.0));
        CHECK(project(camera, kPicture, *far)->y == doctest::Approx(59.0));
    }
}

TEST_CASE("the middle of what is visible is that of its box, and tells how deep it is") {
    const Camera camera;
    DepthMap map = map_of(camera);
    CHECK_FALSE(visible_in(std::vector<DepthMap>{}));
    CHECK_FALSE(visible_in(std::vector{map}));
    fill(map, {100, 100}, {200, 200}, 400.0F); // a quarter of this and as much of that
    fill(map, {200, 100}, {300, 200}, 600.0F);
    const auto visible = visible_in(std::vector{map});
    REQUIRE(visible);
    const glm::dvec3 middle = *project(camera, kPicture, visible->middle);
    CHECK(middle.x == doctest::Approx(200.0).epsilon(0.02));
    CHECK(middle.y == doctest::Approx(150.0).epsilon(0.02));
    CHECK(middle.z == doctest::Approx(500.0));
    CHECK(visible->half_depth_mm == doctest::Approx(100.0));
    // A length at 400 mm looks 25 % longer, at 600 mm 17 % shorter; of the middle's depth it is 20 %.
    const auto scale = scale_of(camera, kPicture, *visible);
    REQUIRE(scale);
    CHECK(scale->share == doctest::Approx(0.2));
    CHECK(scale->mm_per_pixel == doctest::Approx(mm_per_pixel_at(camera, kPicture, 500.0)));
    // A speck far away is not what one looks at.
    DepthMap speck = map;
    fill(speck, {300, 200}, {310, 210}, 3000.0F);
    CHECK(visible_in(std::vector{speck})->half_depth_mm == doctest::Approx(100.0));
    // The viewports of a picture are one.
    DepthMap other = map_of(camera);
    fill(other, {100, 100}, {300, 200}, 700.0F);
    CHECK(project(camera, kPicture, visible_in(std::vector{map, other})->middle)->z == doctest::Approx(550.0));
}

TEST_CASE("where what is farthest is more than twice as far as what is nearest, no length holds") {
    const Camera camera;
    for (const auto& [far, holds] : {std::pair{790.0F, true}, std::pair{810.0F, false}}) {
        DepthMap map = map_of(camera);
        fill(map, {100, 100}, {200, 200}, 400.0F);
        fill(map, {200, 100}, {300, 200}, far);
        const auto scale = scale_of(camera, kPicture, visible_in(std::vector{map}).value());
        CHECK(scale.has_value() == holds);
    }
    CHECK_FALSE(scale_at(camera, kPicture, camera.position + glm::dvec3(0, 1, 0), Scale::At::kPointer));
    Camera parallel;
    parallel.orthographic = true;
    CHECK_FALSE(scale_at(parallel, kPicture, glm::dvec3(0.0), Scale::At::kPointer));
    CHECK(scale_bar_of(parallel, kPicture, {}, 100.0));
    CHECK_FALSE(scale_bar_of(camera, kPicture, {}, 100.0));
}
