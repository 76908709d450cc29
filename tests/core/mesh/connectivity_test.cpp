#include "core/mesh/connectivity.h"

#include <doctest/doctest.h>

using namespace ramus;

TEST_CASE("components are counted over shared vertices, unused vertices left out") {
    mesh::TriangleMesh mesh;
    CHECK(mesh::component_count(mesh) == 0);
    mesh.positions.resize(12);
    mesh.triangles = {{0, 1, 2}, {5, 4, 3}, {6, 7, 8}};
    CHECK(mesh::component_count(mesh) == 3);
    mesh.triangles.push_back({8, 9, 3}); // joins the last two, and a vertex with them
    CHECK(mesh::component_count(mesh) == 2);
    mesh.triangles.push_back({2, 9, 0});
    CHECK(mesh::component_count(mesh) == 1);
}

TEST_CASE("loops of a closed surface and of a tree are counted") {
    // A ring of 6 squares around a tube of 4, each square cut in two.
    mesh::TriangleMesh torus;
    constexpr std::uint32_t kAlong = 6, kAround = 4;
    const auto at = [](std::uint32_t i, std::uint32_t j) { return i % kAlong * kAround + j % kAround; };
    torus.positions.resize(kAlong * kAround + 1); // one that is not used
    for (std::uint32_t i = 0; i < kAlong; ++i)
        for (std::uint32_t j = 0; j < kAround; ++j) {
            torus.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
            torus.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
        }
    CHECK(mesh::connectivity_of(torus) == mesh::Connectivity{1, 1});
    const std::uint32_t first = 25;
    torus.positions.resize(first + 4);
    for (const glm::uvec3 face : {glm::uvec3(0, 1, 2), glm::uvec3(0, 2, 3), glm::uvec3(0, 3, 1), glm::uvec3(1, 3, 2)})
        torus.triangles.push_back(face + first); // and a tetrahedron beside it
    CHECK(mesh::connectivity_of(torus) == mesh::Connectivity{2, 1});

    tree::VesselTree tree;
    tree.points.resize(6);
    tree.branches.resize(3);
    tree.branches[0].points = {0, 1, 2};
    tree.branches[1].points = {2, 3, 0};
    tree.branches[2].points = {4, 5};
    CHECK(mesh::connectivity_of(tree) == mesh::Connectivity{2, 1});
    CHECK(mesh::connectivity_of(tree, std::vector<std::uint8_t>{0, 1, 0}) == mesh::Connectivity{2, 0});
    CHECK(mesh::connectivity_of(tree, std::vector<std::uint8_t>{1, 1, 1}) == mesh::Connectivity{0, 0});
}
