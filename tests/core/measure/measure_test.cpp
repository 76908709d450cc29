#include "core/io/trees/swc.h"
#include "core/measure/connectivity.h"
#include "core/measure/tree_measure.h"

#include <doctest/doctest.h>
#include <numbers>

using namespace ramus;

TEST_CASE("components are counted over shared vertices, unused vertices left out") {
    mesh::TriangleMesh mesh;
    CHECK(measure::component_count(mesh) == 0);
    mesh.positions.resize(12);
    mesh.triangles = {{0, 1, 2}, {5, 4, 3}, {6, 7, 8}};
    CHECK(measure::component_count(mesh) == 3);
    mesh.triangles.push_back({8, 9, 3}); // joins the last two, and a vertex with them
    CHECK(measure::component_count(mesh) == 2);
    mesh.triangles.push_back({2, 9, 0});
    CHECK(measure::component_count(mesh) == 1);
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
    CHECK(measure::connectivity_of(torus) == measure::Connectivity{1, 1});
    const std::uint32_t first = 25;
    torus.positions.resize(first + 4);
    for (const glm::uvec3 face : {glm::uvec3(0, 1, 2), glm::uvec3(0, 2, 3), glm::uvec3(0, 3, 1), glm::uvec3(1, 3, 2)})
        torus.triangles.push_back(face + first); // and a tetrahedron beside it
    CHECK(measure::connectivity_of(torus) == measure::Connectivity{2, 1});

    tree::VesselTree tree;
    tree.points.resize(6);
    tree.branches.resize(3);
    tree.branches[0].points = {0, 1, 2};
    tree.branches[1].points = {2, 3, 0};
    tree.branches[2].points = {4, 5};
    CHECK(measure::connectivity_of(tree) == measure::Connectivity{2, 1});
    CHECK(measure::connectivity_of(tree, std::vector<std::uint8_t>{0, 1, 0}) == measure::Connectivity{2, 0});
    CHECK(measure::connectivity_of(tree, std::vector<std::uint8_t>{1, 1, 1}) == measure::Connectivity{0, 0});
}

TEST_CASE("a cone's figures are those of geometry, however finely it is sampled") {
    const char* coarse = "1 0 0 0 0 3 -1\n2 0 0 0 12 1 1\n";
    const char* fine = "1 0 0 0 0 3 -1\n2 0 0 0 0.6 2.9 1\n3 0 0 0 1.2 2.8 2\n4 0 0 0 12 1 3\n";
    for (const char* text : {coarse, fine}) {
        const auto tree = io::parse_tree(text, "cone.swc");
        REQUIRE(tree);
        const measure::TreeStatistics figures = measure::tree_statistics(*tree);
        CHECK(figures.length_mm == doctest::Approx(12.0));
        CHECK(figures.volume_mm3 == doctest::Approx(std::numbers::pi / 3.0 * 12.0 * (9.0 + 3.0 + 1.0)));
        CHECK(figures.radius_mm.min == 1.0);
        CHECK(figures.radius_mm.mean == doctest::Approx(2.0));
        CHECK(figures.radius_mm.max == 3.0);
        REQUIRE(figures.branches.size() == 1);
        CHECK(figures.branches[0].diameter_mm.mean == doctest::Approx(4.0));
        CHECK(figures.generations == 1);
        CHECK(figures.leaves == 1);
    }
}
