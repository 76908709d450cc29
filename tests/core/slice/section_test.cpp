// Sections of meshes: closed loops on the mesh's edges, exactly in the plane, with the area of the analytic section.
#include "core/mesh/sphere_mesh.h"
#include "core/slice/section.h"

#include <cmath>
#include <doctest/doctest.h>
#include <glm/geometric.hpp>
#include <numbers>
#include <random>

using namespace ramus;

namespace {

slice::Plane plane_across(const glm::dvec3& normal, const glm::dvec3& point) { return {point, glm::normalize(normal)}; }

// An octahedron whose vertices have whole coordinates, so that planes pass through vertices and along edges.
mesh::TriangleMesh octahedron() {
    mesh::TriangleMesh mesh;
    for (const glm::vec3& at : {glm::vec3(1, 0, 0), glm::vec3(-1, 0, 0), glm::vec3(0, 1, 0), glm::vec3(0, -1, 0),
                                glm::vec3(0, 0, 1), glm::vec3(0, 0, -1)})
        mesh.positions.push_back(at);
    for (const glm::uvec3& triangle :
         {glm::uvec3(0, 2, 4), glm::uvec3(2, 1, 4), glm::uvec3(1, 3, 4), glm::uvec3(3, 0, 4), glm::uvec3(2, 0, 5),
          glm::uvec3(1, 2, 5), glm::uvec3(3, 1, 5), glm::uvec3(0, 3, 5)})
        mesh.triangles.push_back(triangle);
    return mesh;
}

} // namespace

TEST_SUITE("slice") {
    TEST_CASE("a ball's section is one closed circle, its inside on the left") {
        const glm::dvec3 centre(3.0, -2.0, 5.0);
        const mesh::TriangleMesh ball = mesh::sphere_mesh(centre, 10.0);
        const slice::MeshBlocks blocks(ball);
        std::mt19937 random(3);
        std::uniform_real_distribution<double> unit(-1.0, 1.0);
        for (int n = 0; n < 50; ++n) {
            const glm::dvec3 normal = glm::normalize(glm::dvec3(unit(random), unit(random), unit(random)));
            const double height = 8.0 * unit(random);
            const slice::Plane plane = plane_across(normal, centre + height * normal);
            const std::vector<slice::Loop> loops = slice::section(blocks, plane);
            REQUIRE(loops.size() == 1);
            CHECK(loops[0].closed);
            for (const slice::EdgePoint& point : loops[0].points) {
                REQUIRE(std::abs(plane.height(point.at)) < 1e-12);
                const glm::dvec3 on_edge = (1.0 - double{point.share}) * glm::dvec3(ball.positions[point.first]) +
                                           double{point.share} * glm::dvec3(ball.positions[point.second]);
                REQUIRE(glm::distance(on_edge, point.at) < 1e-5);
            }
            const double area = std::numbers::pi * (100.0 - height * height);
            CHECK(slice::enclosed_mm2(loops, normal) == doctest::Approx(area).epsilon(0.003)); // inscribed
        }
    }

    TEST_CASE("a plane beyond the mesh cuts nothing") {
        const mesh::TriangleMesh ball = mesh::sphere_mesh(glm::dvec3(0.0), 1.0);
        CHECK(slice::section(ball, plane_across({0.0, 0.0, 1.0}, {0.0, 0.0, 1.5})).empty());
    }

    TEST_CASE("planes through vertices and along edges give closed loops") {
        const mesh::TriangleMesh mesh = octahedron();
        for (const glm::dvec3& normal :
             {glm::dvec3(0, 0, 1), glm::dvec3(1, 1, 0), glm::dvec3(1, 0, 0), glm::dvec3(1, 1, 1)})
            for (const double height : {0.0, 0.25, -0.25}) {
                const slice::Plane plane = plane_across(normal, height * glm::normalize(normal));
                const std::vector<slice::Loop> loops = slice::section(mesh, plane);
                REQUIRE(loops.size() == 1);
                CHECK(loops[0].closed);
                CHECK(slice::enclosed_mm2(loops, plane.normal) > 0.5);
            }
        // The square of the equator, whose edges lie in the plane.
        CHECK(slice::enclosed_mm2(slice::section(mesh, plane_across({0, 0, 1}, {0, 0, 0})), {0, 0, 1}) ==
              doctest::Approx(2.0));
    }

    TEST_CASE("holes are clockwise, and their area is subtracted") {
        mesh::TriangleMesh shell = mesh::sphere_mesh(glm::dvec3(0.0), 3.0);
        const mesh::TriangleMesh inner = mesh::sphere_mesh(glm::dvec3(0.0), 2.0);
        const auto first = static_cast<std::uint32_t>(shell.positions.size());
        shell.positions.insert(shell.positions.end(), inner.positions.begin(), inner.positions.end());
        for (const glm::uvec3& triangle : inner.triangles) // turned inside out
            shell.triangles.emplace_back(first + triangle.x, first + triangle.z, first + triangle.y);
        const std::vector<slice::Loop> loops = slice::section(shell, plane_across({0, 0, 1}, {0, 0, 0.1}));
        REQUIRE(loops.size() == 2);
        CHECK(slice::enclosed_mm2(loops, {0, 0, 1}) == doctest::Approx(std::numbers::pi * 5.0).epsilon(0.003));
    }

    TEST_CASE("a mesh with a hole gives an open polyline") {
        mesh::TriangleMesh mesh = octahedron();
        mesh.triangles.erase(mesh.triangles.begin());
        const std::vector<slice::Loop> loops = slice::section(mesh, plane_across({0, 0, 1}, {0, 0, 0.5}));
        REQUIRE(loops.size() == 1);
        CHECK_FALSE(loops[0].closed);
        CHECK(loops[0].points.size() == 4);
    }
}
