#include "core/mesh/loops/spanning_triangles.h"

#include <doctest/doctest.h>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <vector>

namespace ramus::mesh {

TEST_CASE("a closed line is spanned by triangles of least area") {
    const auto area = [](const std::vector<glm::dvec3>& line) {
        double sum = 0.0;
        for (const glm::uvec3& t : spanning_triangles(line)) {
            CHECK(t.x < t.y);
            CHECK(t.y < t.z);
            sum += 0.5 * glm::length(glm::cross(line[t.y] - line[t.x], line[t.z] - line[t.x]));
        }
        return sum;
    };
    const std::vector<glm::dvec3> bent{{0, 0, 0}, {4, 0, 0}, {4, 1, 0}, {1, 1, 0}, {1, 4, 0}, {0, 4, 0}};
    CHECK(spanning_triangles(bent).size() == 4);
    CHECK(area(bent) == doctest::Approx(7.0));
    // Of two diagonals the better one, wherever the line begins.
    CHECK(area({{0, 0, 0}, {1, 0, 1}, {2, 0, 0}, {1, 3, 0}}) == doctest::Approx(4.0));
    CHECK(area({{1, 0, 1}, {2, 0, 0}, {1, 3, 0}, {0, 0, 0}}) == doctest::Approx(4.0));
    CHECK(spanning_triangles(std::vector<glm::dvec3>{{0, 0, 0}, {1, 0, 0}}).empty());
}

} // namespace ramus::mesh
