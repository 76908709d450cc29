// Whether triangles meet: general places, and all the ways to touch.
#include "core/mesh/untangle/exact_triangles.h"
#include "tests/support/mesh_intersections.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <doctest/doctest.h>
#include <glm/geometric.hpp>
#include <random>
#include <vector>

namespace ramus::test {

namespace {

using Corners = std::array<glm::vec3, 3>;

// Corners at the same place are one, or are not.
bool meet_by(const Corners& a, const Corners& b, bool shared) {
    std::vector<glm::vec3> positions(a.begin(), a.end());
    glm::uvec3 first(0, 1, 2), second(3, 4, 5);
    positions.insert(positions.end(), b.begin(), b.end());
    if (shared)
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j)
                if (positions[static_cast<std::size_t>(3 + i)] == positions[static_cast<std::size_t>(j)])
                    second[i] = first[j];
    const bool answer = mesh::triangles_meet(positions, first, second);
    // Neither the order of the two nor that of their corners matters.
    CHECK(mesh::triangles_meet(positions, second, first) == answer);
    for (int turn = 0; turn < 3; ++turn) {
        first = {first.y, first.z, first.x};
        CHECK(mesh::triangles_meet(positions, first, second) == answer);
        second = {second.z, second.y, second.x};
        CHECK(mesh::triangles_meet(positions, first, second) == answer);
        second = {second.y, second.z, second.x};
    }
    return answer;
}

constexpr Corners kFloor = {{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}};

} // namespace

TEST_CASE("triangles that share nothing meet where they go through each other or touch") {
    const auto meets = [](const Corners& other) { return meet_by(kFloor, other, false); };
    CHECK(meets({{{1, 1, -1}, {1, 1, 1}, {9, 9, 1}}}));           // through the inside
    CHECK_FALSE(meets({{{3, 3, -1}, {3, 3, 1}, {9, 9, 1}}}));     // past the long side
    CHECK(meets({{{2, 2, -1}, {2, 2, 1}, {9, 9, 1}}}));           // through the long side
    CHECK(meets({{{1, 1, 0}, {1, 1, 1}, {9, 9, 1}}}));            // a corner on the inside
    CHECK(meets({{{2, 2, 0}, {5, 5, 1}, {9, 9, 1}}}));            // a corner on a side
    CHECK(meets({{{4, 0, 0}, {5, 5, 1}, {9, 9, 1}}}));            // corner on corner
    CHECK_FALSE(meets({{{1, 1, 1e-30F}, {1, 1, 1}, {9, 9, 1}}})); // a hair above
    CHECK(meets({{{-1, 2, 0}, {5, 2, 0}, {2, 2, 5}}}));           // a side in the plane, across
    CHECK_FALSE(meets({{{-1, 5, 0}, {5, 5, 0}, {2, 2, 5}}}));     // a side in the plane, beside
    CHECK(meets({{{-9, 1, -9}, {9, 1, -9}, {1, 1, 9}}}));         // a large one that the floor goes through
}

TEST_CASE("triangles in one plane meet where they overlap or touch") {
    const auto meets = [](const Corners& other) { return meet_by(kFloor, other, false); };
    CHECK(meets({{{1, 1, 0}, {2, 1, 0}, {1, 2, 0}}}));       // within
    CHECK(meets({{{-9, -9, 0}, {40, -9, 0}, {-9, 40, 0}}})); // around
    CHECK(meets(kFloor));
    CHECK(meets({{{2, 2, 0}, {5, 5, 0}, {5, 4, 0}}}));  // a corner on a side
    CHECK(meets({{{4, 0, 0}, {5, 0, 0}, {5, 1, 0}}}));  // corner on corner
    CHECK(meets({{{3, 0, 0}, {7, 0, 0}, {5, -1, 0}}})); // side on side
    CHECK(meets({{{-1, 1, 0}, {9, 1, 0}, {9, 2, 0}}})); // across, no corner within the other
    CHECK_FALSE(meets({{{3, 2, 0}, {5, 5, 0}, {5, 4, 0}}}));
    CHECK_FALSE(meets({{{5, 0, 0}, {7, 0, 0}, {5, -1, 0}}})); // on one line with a side, beyond
}

TEST_CASE("triangles that share corners meet where they have more than these in common") {
    const auto meets = [](const Corners& other) { return meet_by(kFloor, other, true); };
    // A corner.
    CHECK_FALSE(meets({{{0, 0, 0}, {1, 1, 1}, {2, 1, 1}}}));   // rises from it
    CHECK_FALSE(meets({{{0, 0, 0}, {-1, 0, 0}, {0, -1, 0}}})); // in the plane, away
    CHECK(meets({{{0, 0, 0}, {1, 2, 0}, {2, 1, 0}}}));         // in the plane, over
    CHECK(meets({{{0, 0, 0}, {3, 0, 0}, {0, -3, 0}}}));        // in the plane, on a side
    CHECK(meets({{{0, 0, 0}, {1, 1, 1}, {1, 1, -1}}}));        // stands across
    CHECK(meets({{{0, 0, 0}, {9, 9, 9}, {9, 9, -9}}}));        // and reaches beyond
    CHECK_FALSE(meets({{{0, 0, 0}, {-1, -1, 1}, {-1, -1, -1}}}));
    CHECK(meets({{{0, 0, 0}, {1, 1, 0}, {1, 1, 1}}})); // a side lies on it
    // An edge.
    CHECK_FALSE(meets({{{0, 0, 0}, {4, 0, 0}, {1, 1, 1}}}));
    CHECK_FALSE(meets({{{0, 0, 0}, {4, 0, 0}, {1, 1, 1e-30F}}}));
    CHECK_FALSE(meets({{{0, 0, 0}, {4, 0, 0}, {1, -1, 0}}}));
    CHECK(meets({{{0, 0, 0}, {4, 0, 0}, {1, 1, 0}}})); // folded over
    // All.
    CHECK(meets(kFloor));
}

TEST_CASE("triangles without area meet like lines and points") {
    const auto meets = [](const Corners& other, bool shared) { return meet_by(kFloor, other, shared); };
    CHECK(meets({{{1, 1, -1}, {1, 1, 0.5F}, {1, 1, 1}}}, false));
    CHECK_FALSE(meets({{{5, 1, -1}, {5, 1, 0.5F}, {5, 1, 1}}}, false));
    CHECK(meets({{{1, 1, 0}, {1, 1, 0}, {1, 1, 0}}}, false));
    CHECK_FALSE(meets({{{1, 1, 1}, {1, 1, 1}, {1, 1, 1}}}, false));
    CHECK(meets({{{0, 0, 0}, {1, 1, 0}, {2, 2, 0}}}, true));
    CHECK_FALSE(meets({{{0, 0, 0}, {1, 1, 1}, {2, 2, 2}}}, true));
    CHECK_FALSE(meets({{{0, 0, 0}, {-1, -1, 0}, {-2, -2, 0}}}, true));
    const Corners line = {{{0, 0, 0}, {2, 0, 0}, {4, 0, 0}}};
    CHECK(meet_by(line, {{{1, 0, 0}, {1, 5, 0}, {1, 9, 0}}}, false));
    CHECK_FALSE(meet_by(line, {{{1, 0, 1}, {1, 5, 1}, {1, 9, 1}}}, false));
    CHECK(meet_by(line, {{{3, 0, 0}, {5, 0, 0}, {9, 0, 0}}}, false));
    CHECK_FALSE(meet_by(line, {{{5, 0, 0}, {6, 0, 0}, {9, 0, 0}}}, false));
}

TEST_CASE("signs of determinants are exact where doubles round") {
    // A plane through a far corner, and points on it, above and below by the last bit of a coordinate.
    std::mt19937 random(5);
    std::uniform_real_distribution<float> far(100.0F, 200.0F);
    std::array<int, 3> signs{};
    for (int n = 0; n < 2000; ++n) {
        const glm::vec3 a(far(random), far(random), far(random));
        const glm::vec3 b(far(random), far(random), far(random));
        // c - a = 2 (b - a), exactly where it is representable; p on the line beyond.
        const glm::vec3 c = b + (b - a);
        const glm::vec3 p(far(random), far(random), far(random));
        using Exact = long double; // 64 bits: differences and products of two of 25 bits have room, sums of three too
        const auto d = [&](const glm::vec3& to, int i) { return static_cast<Exact>(to[i]) - static_cast<Exact>(a[i]); };
        for (int axis = 0; axis < 3; ++axis) {
            const int x = (axis + 1) % 3, y = (axis + 2) % 3;
            const Exact det = d(b, x) * d(c, y) - d(b, y) * d(c, x);
            const int sign = det > 0 ? 1 : det < 0 ? -1 : 0;
            CHECK(mesh::exact::turn(a, b, c, axis) == sign);
            ++signs[static_cast<std::size_t>(sign + 1)];
        }
        // Any point is in one plane with three of a line, and with two others and itself.
        CHECK(mesh::exact::side_of_plane(a, b, p, a) == 0);
        CHECK(mesh::exact::side_of_plane(a, b, p, b) == 0);
        CHECK(mesh::exact::side_of_plane(a, b, p, p) == 0);
        const int side = mesh::exact::side_of_plane(a, b, c, p);
        CHECK(mesh::exact::side_of_plane(b, a, c, p) == -side);
        CHECK(mesh::exact::side_of_plane(b, c, a, p) == side);
        CHECK(mesh::exact::side_of_plane(p, c, b, a) == -mesh::exact::side_of_plane(a, c, b, p));
    }
    CHECK(std::ranges::min(signs) > 0);
}

TEST_CASE("which side of a plane a point is on is exact, as whole numbers tell") {
    std::mt19937 random(11);
    std::uniform_int_distribution<int> far(-4'000'000, 4'000'000), near(-200, 200), times(-3000, 3000), hair(-1, 1);
    std::array<int, 3> signs{};
    for (int n = 0; n < 4000; ++n) {
        const auto pick = [&](auto& from) { return glm::ivec3(from(random), from(random), from(random)); };
        const glm::ivec3 a = pick(far), u = pick(near), v = pick(near);
        const glm::ivec3 b = a + times(random) * u, c = a + times(random) * v;
        const glm::ivec3 p = a + times(random) * u + times(random) * v + pick(hair); // in the plane, or a hair off
        __extension__ using Whole = __int128;
        const auto d = [&](const glm::ivec3& to, int i) { return static_cast<Whole>(to[i] - a[i]); };
        Whole det = 0;
        for (int i = 0; i < 3; ++i) {
            const int j = (i + 1) % 3, k = (i + 2) % 3;
            det += d(b, i) * (d(c, j) * d(p, k) - d(c, k) * d(p, j));
        }
        const int sign = det > 0 ? 1 : det < 0 ? -1 : 0;
        CHECK(mesh::exact::side_of_plane(glm::vec3(a), glm::vec3(b), glm::vec3(c), glm::vec3(p)) == sign);
        ++signs[static_cast<std::size_t>(sign + 1)];
    }
    CHECK(std::ranges::min(signs) > 50);
}

TEST_CASE("the tree of boxes finds the pairs that a look at all of them finds") {
    std::mt19937 random(3);
    std::uniform_real_distribution<float> place(0.0F, 10.0F), size(-1.0F, 1.0F);
    mesh::TriangleMesh mesh;
    for (std::uint32_t n = 0; n < 600; ++n) {
        const glm::vec3 middle(place(random), place(random), place(random));
        for (int i = 0; i < 3; ++i)
            mesh.positions.push_back(middle + glm::vec3(size(random), size(random), size(random)));
        mesh.triangles.push_back({3 * n, 3 * n + 1, 3 * n + 2});
    }
    std::vector<IntersectingPair> all;
    for (std::uint32_t a = 0; a < 600; ++a)
        for (std::uint32_t b = a + 1; b < 600; ++b)
            if (mesh::triangles_meet(mesh.positions, mesh.triangles[a], mesh.triangles[b])) all.push_back({a, b});
    CHECK(all.size() > 20);
    CHECK(intersecting_triangles(mesh) == all);
}

} // namespace ramus::test
