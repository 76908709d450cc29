#include "core/mesh/polygonize/cells/fans.h"
#include "core/mesh/polygonize/cells/wall_pairs.h"

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

using namespace ramus;
using namespace ramus::mesh::bricks;

namespace {

// A square around a cell of edge 1, across x.
Fan square_at(float x) {
    const glm::vec3 a(x, 0, 0), b(x, 1, 0), c(x, 1, 1), d(x, 0, 1);
    return {{{a, b}, {b, c}, {c, d}, {d, a}}};
}

} // namespace

TEST_CASE("fans meet where the vertex of one is beyond the other") {
    const Fan a = square_at(0.4F), b = square_at(0.6F);
    CHECK(!fans_meet(a, {0.4F, 0.5F, 0.5F}, b, {0.6F, 0.5F, 0.5F}));
    CHECK(!fans_meet(a, {0.5F, 0.5F, 0.5F}, b, {0.9F, 0.2F, 0.7F}));
    CHECK(fans_meet(a, {0.8F, 0.5F, 0.5F}, b, {0.6F, 0.5F, 0.5F}));
    CHECK(fans_meet(a, {0.4F, 0.5F, 0.5F}, b, {0.1F, 0.3F, 0.5F}));
}

TEST_CASE("fans that meet are parted, whichever way their vertices went wrong") {
    const std::vector<Fan> fans{square_at(0.4F), square_at(0.6F), square_at(0.45F)};
    std::vector<glm::vec3> toward(3, glm::vec3(0.0F)),
        vertices{{0.8F, 0.5F, 0.5F}, {0.3F, 0.3F, 0.6F}, {0.9F, 0.9F, 0.5F}};
    CHECK(part_fans(fans, toward, glm::vec3(0.01F), glm::vec3(0.99F), vertices));
    for (std::size_t a = 0; a < 3; ++a)
        for (std::size_t b = 0; b < a; ++b) CHECK(!fans_meet(fans[a], vertices[a], fans[b], vertices[b]));
}

TEST_CASE("lines on a face meet where they cross") {
    CHECK(lines_meet({{{0, 0, 0}, {1, 1, 0}, {2, 0, 0}}}, {{{0, 1, 0}, {1, 0, 0}, {2, 1, 0}}}, 2));
    CHECK(!lines_meet({{{0, 0, 0}, {1, 1, 0}, {2, 0, 0}}}, {{{0, 1, 0}, {1, 2, 0}, {2, 1, 0}}}, 2));
}

TEST_CASE("places on both sides of a wall are moved a hair's breadth apart, and stay in their room") {
    const Span room{glm::vec3(0.0F), glm::vec3(1.0F)};
    for (const float x : {-0.1F, 0.0F, 0.5F, 1.0F, 1.1F}) {
        field::OwnedPoint first{{x, 0.5F, 0.5F}, {1, 0, 0}, 2.0F}, second{{x, 0.5F, 0.5F}, {-1, 0, 0}, 5.0F};
        part(first, second, {1, 0, 0}, room);
        CHECK(second.at.x - first.at.x == doctest::Approx(0.04)); // 0.02 of the thinner radius
        CHECK(first.at.x >= 0.0F);
        CHECK(second.at.x <= 1.0F);
    }
}
