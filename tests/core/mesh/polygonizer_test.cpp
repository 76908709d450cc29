// A surface that follows its tree is the one that is made from nothing, bit for bit.
#include "core/field/vessel_field.h"
#include "core/mesh/polygonize/polygonizer.h"
#include "tests/support/grown_tree.h"
#include "tests/support/mesh_topology.h"
#include "tests/support/tree_field.h"

#include <algorithm>
#include <doctest/doctest.h>
#include <random>

using namespace ramus;

namespace {

// A copy of a polygonizer's mesh that only ever hears of its edits.
class Follower {
public:
    void take(mesh::Polygonizer& polygonizer) {
        const mesh::SurfaceEdit edit = polygonizer.take_edit();
        const mesh::TriangleMesh& from = polygonizer.slots();
        if (edit.whole) mesh_ = from;
        mesh_.positions.resize(from.positions.size());
        mesh_.triangles.resize(from.triangles.size());
        for (const mesh::SlotRange& range : edit.vertices)
            std::copy_n(from.positions.begin() + static_cast<std::ptrdiff_t>(range.first), range.count,
                        mesh_.positions.begin() + static_cast<std::ptrdiff_t>(range.first));
        for (const mesh::SlotRange& range : edit.triangles)
            std::copy_n(from.triangles.begin() + static_cast<std::ptrdiff_t>(range.first), range.count,
                        mesh_.triangles.begin() + static_cast<std::ptrdiff_t>(range.first));
    }
    // Triangles with an area, by the positions of their corners.
    [[nodiscard]] std::size_t triangles() const {
        return static_cast<std::size_t>(
            std::ranges::count_if(mesh_.triangles, [](const glm::uvec3& t) { return t.x != t.y; }));
    }
    [[nodiscard]] double volume() const {
        double volume = 0.0;
        for (const glm::uvec3& t : mesh_.triangles)
            volume += glm::dot(glm::dvec3(mesh_.positions[t.x]),
                               glm::cross(glm::dvec3(mesh_.positions[t.y]), glm::dvec3(mesh_.positions[t.z]))) /
                      6.0;
        return volume;
    }

private:
    mesh::TriangleMesh mesh_;
};

void check_update(mesh::Polygonizer& polygonizer, Follower& follower, const field::Field& field,
                  const mesh::PolygonizeOptions& options) {
    Job job;
    REQUIRE(polygonizer.update(field, options, job));
    const mesh::TriangleMesh updated = polygonizer.compact();
    const auto whole = mesh::polygonize(field, options, job);
    REQUIRE(whole);
    CHECK(updated == *whole);
    follower.take(polygonizer);
    const test::Topology topology = test::topology(*whole);
    CHECK(topology.closed_manifold());
    CHECK(follower.triangles() == whole->triangles.size());
    CHECK(follower.volume() == doctest::Approx(topology.volume).epsilon(1e-6));
}

} // namespace

TEST_CASE("hiding and showing branches gives the surface made from nothing, bit for bit" *
          doctest::test_suite("slow")) {
    const tree::VesselTree tree = test::grown(150);
    for (const double cell : {0.0, 0.5}) {
        mesh::PolygonizeOptions options;
        options.cell_mm = cell;
        mesh::Polygonizer polygonizer;
        Follower follower;
        std::vector<std::uint8_t> hidden(tree.branches.size(), 0);
        std::mt19937 random(5);
        check_update(polygonizer, follower, test::make_field(tree, {}, hidden), options);
        for (int round = 0; round < 12; ++round) {
            const int branch = static_cast<int>(random() % tree.branches.size());
            const auto value = static_cast<std::uint8_t>(hidden[static_cast<std::size_t>(branch)] == 0 ? 1 : 0);
            if (round % 3 == 2)
                hidden[static_cast<std::size_t>(branch)] = value;
            else
                for (const int below : tree::subtree(tree, branch)) hidden[static_cast<std::size_t>(below)] = value;
            if (std::ranges::all_of(hidden, [](std::uint8_t h) { return h != 0; })) hidden.assign(hidden.size(), 0);
            check_update(polygonizer, follower, test::make_field(tree, {}, hidden), options);
        }
    }
}

TEST_CASE("pruning, smoothing, width and detail give the surface made from nothing, bit for bit" *
          doctest::test_suite("slow")) {
    const tree::VesselTree tree = test::grown(120);
    mesh::Polygonizer polygonizer;
    Follower follower;
    mesh::PolygonizeOptions options;
    mesh::SurfaceOptions surface;
    check_update(polygonizer, follower, test::make_field(tree, surface, {}), options);
    for (const double ratio : {0.3, 0.5, 0.2, 0.0}) {
        surface.prune_ratio = ratio;
        check_update(polygonizer, follower, test::make_field(tree, surface, {}), options);
    }
    surface.smooth_passes = 3;
    check_update(polygonizer, follower, test::make_field(tree, surface, {}), options);
    surface.width = 2.0;
    check_update(polygonizer, follower, test::make_field(tree, surface, {}), options);
    options.detail = 12;
    check_update(polygonizer, follower, test::make_field(tree, surface, {}), options);
}

TEST_CASE("a change costs in proportion to what it touches") {
    const tree::VesselTree tree = test::grown(400);
    std::vector<std::uint8_t> hidden(tree.branches.size(), 0);
    mesh::Polygonizer polygonizer;
    Job job;
    REQUIRE(polygonizer.update(test::make_field(tree, {}, hidden), {}, job));
    const std::uint64_t whole = polygonizer.statistics().evaluations;
    hidden.back() = 1; // a twig
    REQUIRE(polygonizer.update(test::make_field(tree, {}, hidden), {}, job));
    const std::uint64_t twig = polygonizer.statistics().evaluations;
    CHECK(twig > 0);
    CHECK(100 * twig < 3 * whole);
    REQUIRE(polygonizer.update(test::make_field(tree, {}, hidden), {}, job));
    CHECK(polygonizer.statistics().evaluations == 0);
    MESSAGE("of ", whole, " evaluations hiding one twig of ", tree.branches.size(), " branches does ", twig);
}

TEST_CASE("a polygonizer whose work was cancelled starts anew") {
    const tree::VesselTree tree = test::grown(60);
    mesh::Polygonizer polygonizer;
    Job cancelled;
    cancelled.cancel();
    std::vector<std::uint8_t> hidden(tree.branches.size(), 0);
    CHECK_FALSE(polygonizer.update(test::make_field(tree, {}, hidden), {}, cancelled));
    Follower follower;
    check_update(polygonizer, follower, test::make_field(tree, {}, hidden), {});
    hidden.back() = 1;
    CHECK_FALSE(polygonizer.update(test::make_field(tree, {}, hidden), {}, cancelled));
    check_update(polygonizer, follower, test::make_field(tree, {}, hidden), {});
}

TEST_CASE("a tree of which everything is hidden has no surface, and gets it back") {
    const tree::VesselTree tree = test::grown(30);
    mesh::Polygonizer polygonizer;
    Follower follower;
    std::vector<std::uint8_t> hidden(tree.branches.size(), 0);
    check_update(polygonizer, follower, test::make_field(tree, {}, hidden), {});
    hidden.assign(hidden.size(), 1);
    Job job;
    REQUIRE(polygonizer.update(test::make_field(tree, {}, hidden), {}, job));
    CHECK(polygonizer.compact().triangles.empty());
    follower.take(polygonizer);
    CHECK(follower.triangles() == 0);
    hidden.assign(hidden.size(), 0);
    check_update(polygonizer, follower, test::make_field(tree, {}, hidden), {});
}
