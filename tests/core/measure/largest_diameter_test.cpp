#include "core/measure/largest_diameter.h"
#include "tests/support/icosphere.h"

#include <algorithm>
#include <doctest/doctest.h>
#include <glm/geometric.hpp>
#include <random>
#include <vector>

using namespace ramus;

namespace {

double farthest_pair(const std::vector<glm::vec3>& points) {
    double best = 0.0;
    for (const glm::vec3& a : points)
        for (const glm::vec3& b : points) best = std::max(best, glm::distance(glm::dvec3(a), glm::dvec3(b)));
    return best;
}

} // namespace

TEST_CASE("the largest diameter is the greatest distance between two points, short by less than 0.1 %") {
    std::mt19937 random(5);
    std::normal_distribution<float> normal;
    for (const glm::vec3 shape : {glm::vec3(1, 1, 1), glm::vec3(9, 1, 1), glm::vec3(5, 5, 0), glm::vec3(0, 3, 0)})
        for (const std::size_t count : {2U, 3U, 17U, 600U}) {
            std::vector<glm::vec3> points(count);
            for (glm::vec3& point : points)
                point = glm::vec3(40, -8, 3) + shape * glm::vec3(normal(random), normal(random), normal(random));
            const double found = measure::largest_diameter(points), longest = farthest_pair(points);
            CHECK(found <= longest);
            CHECK(found > 0.999 * longest);
        }
    const auto ball = test::icosphere(3, {8, -3, 5}, 4.0).positions;
    CHECK(measure::largest_diameter(ball) == doctest::Approx(8.0).epsilon(1e-5));
}

TEST_CASE("points that are the same, or fewer than two, have no diameter") {
    CHECK(measure::largest_diameter({}) == 0.0);
    CHECK(measure::largest_diameter(std::vector<glm::vec3>{{1, 2, 3}}) == 0.0);
    CHECK(measure::largest_diameter(std::vector<glm::vec3>(100, {1, 2, 3})) == 0.0);
}
