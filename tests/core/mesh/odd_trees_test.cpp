// Trees that nobody has and that files can hold: vessels far thinner than cells, far shorter than thick, far away.
#include "core/field/vessel_field.h"
#include "core/mesh/lost_pieces.h"
#include "core/mesh/polygonize/octree/sizing.h"
#include "core/mesh/polygonize/polygonize.h"
#include "core/mesh/surface.h"
#include "tests/support/built_tree.h"
#include "tests/support/tree_field.h"

#include <doctest/doctest.h>
#include <glm/geometric.hpp>
#include <utility>
#include <vector>

using namespace ramus;

namespace {

tree::VesselTree vessel(glm::dvec3 from, glm::dvec3 to, double radius) {
    return test::built_tree({{from, radius}, {to, radius}}, {{0, 1}});
}

} // namespace

TEST_CASE("a thin vessel across has bricks along it, not in its box") {
    const glm::dvec3 end(90.0, -40.0, 0.0);
    const field::Field field = test::make_field(vessel(glm::dvec3(0.0), end, 1.5e-3), {}, {});
    constexpr double kCell = 0.25;
    Job job;
    mesh::PolygonizeStatistics statistics;
    REQUIRE(mesh::polygonize(field, {.cell_mm = kCell}, job, &statistics));
    // Bricks of 4 cells a side: the line passes 91 + 41 of them, its support may touch one more at each plane that it
    // crosses, and in z it runs between two layers. Its box has 90 x 40 in each layer.
    CHECK(statistics.bricks <= 2 * 2 * (91 + 41));
}

TEST_CASE("forecasts hold for vessels that turn back, and for those that are shorter than thick") {
    const std::vector<tree::VesselTree> trees = {
        test::built_tree({{{0, 0, 0}, 4.0}, {{6, 0, 0}, 4.0}, {{3, 1e-3, 0}, 4.0}}, {{0, 1}, {1, 2}}),
        test::built_tree({{{0, 0, 0}, 4.0}, {{6, 0, 0}, 4.0}, {{3, 1e-12, 0}, 4.0}}, {{0, 1}, {1, 2}, {2, 0}}),
        vessel({0, 0, 0}, {0, 0, 0.6}, 4.0)};
    for (const tree::VesselTree& tree : trees)
        for (const double cell : {0.0, 0.2}) {
            CAPTURE(cell);
            const field::Field field = test::make_field(tree, {}, {});
            Job job;
            const auto surface = mesh::polygonize(field, {.cell_mm = cell}, job);
            REQUIRE(surface);
            CHECK(surface->triangles.size() > 0);
            // As check_feasible() reckons: up to twice as many in the end.
            const double expected = mesh::bricks::make_sizing(field, 16, cell).expected_triangles;
            CHECK(static_cast<double>(surface->triangles.size()) <= 2.0 * expected);
        }
}

TEST_CASE("what has no surface is an error, and pieces that have none are known") {
    Job job;
    const tree::VesselTree good = vessel({0, 0, 0}, {0, 0, 10}, 1.0), short_one = vessel({0, 0, 0}, {0, 0, 0.1}, 5.0);
    CHECK(mesh::make_surface(good, {}, job));
    for (const double cell : {0.0, 0.5, 1e9}) {
        CAPTURE(cell);
        const auto made = mesh::make_surface(short_one, {.cell_mm = cell}, job);
        REQUIRE_FALSE(made);
        CHECK(made.error().what.starts_with("the surface is empty"));
        CHECK_FALSE(made.error().hint.empty());
    }
    const tree::VesselTree both = test::built_tree(
        {{{0, 0, 0}, 1.0}, {{0, 0, 10}, 1.0}, {{50, 0, 0}, 5.0}, {{50, 0, 0.1}, 5.0}}, {{0, 1}, {2, 3}}, {0, 2});
    const auto made = mesh::make_surface(both, {}, job);
    REQUIRE(made);
    mesh::SeenBranches seen(both.branches.size());
    seen.add(made->mesh.branches);
    CHECK(mesh::lost_pieces(both, {}, seen) == std::vector<std::vector<int>>{{1}});
    const std::vector<std::uint8_t> hidden{0, 1};
    CHECK(mesh::lost_pieces(both, hidden, seen).empty());
    CHECK(mesh::lost_pieces(both, {}, mesh::SeenBranches(2)) == std::vector<std::vector<int>>{{0}, {1}});
}

TEST_CASE("cells that single precision cannot tell apart are refused") {
    Job job;
    // There single precision goes in steps of 1 mm.
    for (const double radius : {1e-8, 1e-3, 0.5}) {
        const auto made = mesh::make_surface(vessel({-9.9e6, 0, 0}, {-9.9e6, 10.0 * radius, 0}, radius), {}, job);
        REQUIRE_FALSE(made);
        CHECK(made.error().what.find("cannot be told apart") != std::string::npos);
    }
    CHECK(mesh::make_surface(vessel({-9.9e6, 0, 0}, {-9.9e6, 100, 0}, 10.0), {}, job));
    CHECK(mesh::make_surface(vessel({-1e3, 0, 0}, {-1e3, 0.1, 0}, 0.01), {}, job));
}

TEST_CASE("what cannot be made is known before contacts are looked for, and stops when it is told to") {
    Job cancelled;
    cancelled.cancel();
    const tree::VesselTree tree = vessel({0, 0, 0}, {0, 0, 10}, 1.0);
    CHECK(mesh::make_surface(tree, {}, cancelled).error().what == "cancelled");
    Job job;
    const auto refused = mesh::make_surface(tree, {.cell_mm = 1e-12}, job);
    REQUIRE_FALSE(refused);
    CHECK(refused.error().what.find("e+") !=
          std::string::npos); // 1e20 triangles and more: a number, not what is left of one
    CHECK(refused.error().what.find('-') == std::string::npos);
}
