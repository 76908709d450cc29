#include "core/mesh/polygonize/join/unfolded_fan.h"

#include <doctest/doctest.h>
#include <glm/geometric.hpp>
#include <vector>

using namespace ramus;

namespace {

constexpr glm::vec3 kUp(0.0F, 0.0F, 1.0F);

bool faces_up(const std::vector<glm::vec3>& corners, const glm::vec3& centre) {
    for (std::size_t n = 0; n < corners.size(); ++n)
        if (glm::cross(corners[n] - centre, corners[(n + 1) % corners.size()] - centre).z <= 0.0F) return false;
    return true;
}

} // namespace

TEST_CASE("the centre of a fan that folds over goes to where no triangle faces away, and no further than it must") {
    const std::vector<glm::vec3> corners{{0, 0, 0}, {1, 0, 0.1F}, {0.5F, 1, -0.1F}};
    CHECK(!mesh::bricks::unfolded_centre(corners, kUp, {0.5F, 0.3F, 0.0F}));
    const glm::vec3 outside(0.5F, -0.1F, 0.0F);
    REQUIRE(!faces_up(corners, outside));
    const auto at = mesh::bricks::unfolded_centre(corners, kUp, outside);
    REQUIRE(at);
    CHECK(faces_up(corners, *at));
    CHECK(glm::distance(*at, outside) < 0.25F);
}

TEST_CASE("the centre of a fan that folds over wherever it is stays") {
    const std::vector<glm::vec3> star{{0, 0, 0}, {4, 1, 0}, {0, 2, 0}, {3, 1, 0}}; // its middle sees not all of it
    CHECK(!mesh::bricks::unfolded_centre(star, kUp, {-1.0F, 1.0F, 0.0F}));
}
