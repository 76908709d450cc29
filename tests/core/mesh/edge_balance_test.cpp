#include "core/mesh/edge_balance.h"
#include "core/mesh/systems.h"
#include "tests/support/icosphere.h"

#include <algorithm>
#include <cstdio>
#include <doctest/doctest.h>

namespace ramus::mesh {

namespace {

// Two spheres of 20,480 triangles.
TriangleMesh two_spheres() {
    TriangleMesh mesh = test::icosphere(5, {0, 0, 0}, 1.0);
    append(mesh, test::icosphere(5, {10, 20, 30}, 1.0));
    return mesh;
}

} // namespace

TEST_CASE("a closed surface is in balance, in any order") {
    TriangleMesh mesh = two_spheres();
    CHECK(check_balance(mesh));
    std::reverse(mesh.triangles.begin(), mesh.triangles.end());
    CHECK(check_balance(mesh));
}

TEST_CASE("an open surface is not in balance, and the error names the place") {
    const TriangleMesh mesh = two_spheres();
    const auto said_of = [](const TriangleMesh& open) {
        const auto result = check_balance(open);
        REQUIRE(!result);
        CHECK(!result.error().hint.empty());
        return result.error().what;
    };
    SUBCASE("a triangle is missing") {
        for (const std::size_t n : {std::size_t{0}, mesh.triangles.size() / 3, mesh.triangles.size() - 1}) {
            TriangleMesh open = mesh;
            open.triangles.erase(open.triangles.begin() + static_cast<std::ptrdiff_t>(n));
            CHECK(said_of(open).starts_with("the surface is not closed near ("));
        }
    }
    SUBCASE("a triangle faces the other way") {
        TriangleMesh turned = mesh;
        std::swap(turned.triangles[5].x, turned.triangles[5].y);
        CHECK(said_of(turned).starts_with("the surface is not closed near ("));
    }
    SUBCASE("a triangle is there twice") {
        TriangleMesh doubled = mesh;
        doubled.triangles.push_back(doubled.triangles[5]);
        CHECK(said_of(doubled).starts_with("the surface is not closed near ("));
    }
    SUBCASE("the place is on the sphere that is open") {
        TriangleMesh open = mesh;
        open.triangles.pop_back();
        float x = 0.0F, y = 0.0F, z = 0.0F;
        REQUIRE(std::sscanf(said_of(open).c_str(), "the surface is not closed near (%f, %f, %f)", &x, &y, &z) == 3);
        CHECK(glm::distance(glm::vec3(x, y, z), glm::vec3(10, 20, 30)) == doctest::Approx(1.0).epsilon(0.001));
    }
}

} // namespace ramus::mesh
