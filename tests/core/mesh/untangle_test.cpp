// Surfaces that go through themselves, and what becomes of them: a sphere whose vertices were dragged across each
// other, and the surfaces of trees. The witness looks at all pairs of triangles (mesh_intersections.h).
#include "core/io/trees/tree_file.h"
#include "core/mesh/surface.h"
#include "core/mesh/untangle/untangle.h"
#include "tests/support/icosphere.h"
#include "tests/support/mesh_intersections.h"
#include "tests/support/mesh_topology.h"
#include "tests/support/packed_trees.h"
#include "tests/support/shared_data.h"

#include <cmath>
#include <doctest/doctest.h>
#include <glm/geometric.hpp>
#include <random>

using namespace ramus;

namespace {

mesh::TriangleMesh sphere() {
    mesh::TriangleMesh mesh = test::icosphere(4, {1.0, 2.0, 3.0}, 5.0);
    mesh.radii.assign(mesh.positions.size(), 5.0F);
    return mesh;
}

// Moves a vertex that far past a neighbour, along the surface.
void drag(mesh::TriangleMesh& mesh, std::size_t triangle, float past) {
    const glm::uvec3& t = mesh.triangles[triangle];
    mesh.positions[t.x] += (1.0F + past) * (mesh.positions[t.y] - mesh.positions[t.x]);
}

// And a sphere of the same size.
mesh::TriangleMesh with_another(mesh::TriangleMesh two, const glm::dvec3& centre) {
    const mesh::TriangleMesh other = test::icosphere(4, centre, 5.0);
    const auto first = static_cast<std::uint32_t>(two.positions.size());
    two.positions.insert(two.positions.end(), other.positions.begin(), other.positions.end());
    two.normals.insert(two.normals.end(), other.normals.begin(), other.normals.end());
    two.radii.resize(two.positions.size(), 5.0F);
    for (const glm::uvec3& t : other.triangles) two.triangles.push_back(t + first);
    return two;
}

mesh::Surface untangled(const tree::VesselTree& tree, const mesh::SurfaceOptions& options) {
    Job job;
    auto surface = mesh::make_untangled_surface(tree, options, job);
    REQUIRE(surface.has_value());
    return std::move(*surface);
}

} // namespace

TEST_CASE("what does not go through itself stays what it is, to the bit") {
    mesh::TriangleMesh mesh = sphere();
    const mesh::TriangleMesh before = mesh;
    Job job;
    const mesh::Untangled pairs = mesh::untangle(mesh, {}, job);
    CHECK(pairs.found == 0);
    CHECK(pairs.left == 0);
    CHECK(mesh == before);
}

TEST_CASE("a surface that goes through itself is drawn apart there, and nowhere else") {
    const mesh::TriangleMesh whole = sphere();
    for (const float past : {0.1F, 0.6F, 1.5F}) {
        CAPTURE(past);
        mesh::TriangleMesh mesh = whole;
        for (const std::size_t triangle : {100U, 2000U, 4000U}) drag(mesh, triangle, past);
        const mesh::TriangleMesh before = mesh;
        const std::size_t met = test::intersecting_triangles(mesh).size();
        REQUIRE(met > 0);
        Job job;
        const mesh::Untangled pairs = mesh::untangle(mesh, {}, job);
        CHECK(pairs.found == met);
        CHECK(pairs.left == 0);
        CHECK(test::intersecting_triangles(mesh).empty());
        CHECK(mesh.triangles == before.triangles);
        CHECK(mesh.normals == before.normals);
        std::size_t moved = 0;
        for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
            moved += mesh.positions[v] != before.positions[v];
            CHECK(glm::distance(mesh.positions[v], before.positions[v]) < 2.5F); // half of the radius
            CHECK(std::abs(glm::distance(mesh.positions[v], glm::vec3(1, 2, 3)) - 5.0F) < 0.25F);
        }
        CHECK(moved > 0);
        CHECK(moved < 150);
    }
}

TEST_CASE("of two pieces that go through each other nothing is moved, and where vertices may not move enough the rest "
          "is told") {
    mesh::TriangleMesh two = with_another(sphere(), {6.0, 2.0, 3.0});
    const mesh::TriangleMesh before = two;
    Job job;
    CHECK(mesh::untangle(two, {}, job).found == 0); // nothing folds over
    CHECK(two == before);

    mesh::TriangleMesh stiff = sphere();
    stiff.radii.assign(stiff.positions.size(), 0.0F);
    drag(stiff, 100, 0.6F);
    const mesh::TriangleMesh dragged = stiff;
    const mesh::Untangled pairs = mesh::untangle(stiff, {}, job);
    CHECK(pairs.found > 0);
    CHECK(pairs.left == pairs.found);
    CHECK(stiff == dragged);

    mesh::TriangleMesh crumpled = sphere();
    std::mt19937 random(20051025);
    std::uniform_real_distribution<float> place(0.0F, 5.0F);
    for (glm::vec3& p : crumpled.positions) p = {place(random), place(random), place(random)};
    const mesh::TriangleMesh as_it_was = crumpled;
    const mesh::Untangled many = mesh::untangle(crumpled, {}, job);
    CHECK(many.found > 10000);
    CHECK(many.left == many.found);
    CHECK(crumpled == as_it_was);

    drag(two, 100, 0.6F);
    const mesh::TriangleMesh tangled = two;
    Job cancelled;
    cancelled.cancel();
    const mesh::Untangled stopped = mesh::untangle(two, {}, cancelled);
    CHECK(stopped.left == stopped.found);
    CHECK(two == tangled);
}

TEST_CASE("sides that touch where nothing folds are drawn apart, at places where that is asked for") {
    constexpr double kApart = 10.0 - 0.01;
    mesh::TriangleMesh two = with_another(sphere(), {1.0 + kApart, 2.0, 3.0});
    const mesh::TriangleMesh before = two;
    const std::size_t met = test::intersecting_triangles(two).size();
    REQUIRE(met > 0);
    mesh::TriangleBox elsewhere, where;
    elsewhere.hold(glm::vec3(1.0F - 5.0F, 2.0F, 3.0F), 1.0F);
    where.hold(glm::vec3(1.0F + 5.0F, 2.0F, 3.0F), 1.0F);
    Job job;
    CHECK(mesh::untangle(two, std::vector{elsewhere}, job).found == 0);
    CHECK(two == before);
    const mesh::Untangled pairs = mesh::untangle(two, std::vector{elsewhere, where}, job);
    CHECK(pairs.found == met);
    CHECK(pairs.left == 0);
    CHECK(test::intersecting_triangles(two).empty());
}

TEST_CASE("surfaces of packed trees do not go through themselves, nor do caps where loops are cut") {
    mesh::SurfaceOptions options;
    for (const int seed : {25, 26, 43}) { // 26: walls alone, whose sides meet
        CAPTURE(seed);
        options.smooth_passes = seed == 26 ? 0 : 1;
        options.detail = seed == 43 ? 24 : 16;
        const mesh::Surface surface = untangled(test::packed_trees(seed), options);
        CHECK(surface.statistics.untangled.found > 0);
        CHECK(surface.statistics.untangled.left == 0);
        CHECK(test::intersecting_triangles(surface.mesh).empty());
        CHECK(test::topology(surface.mesh).closed_manifold());
    }
}

TEST_CASE("surfaces of real trees do not go through themselves") {
    std::size_t found = 0, trees = 0;
    for (const auto& path : test::shared_trees()) {
        CAPTURE(path.filename().string());
        const auto tree = io::read_tree(path);
        REQUIRE(tree.has_value());
        if (tree->points.size() > 50000) continue; // takes long
        mesh::SurfaceOptions options;
        options.detail = 8;
        for (const int passes : {0, 1}) {
            CAPTURE(passes);
            options.smooth_passes = passes;
            const mesh::Surface surface = untangled(*tree, options);
            CHECK(surface.statistics.untangled.left == 0);
            CHECK(test::intersecting_triangles(surface.mesh).empty());
            found += surface.statistics.untangled.found;
        }
        ++trees;
    }
    if (trees > 0) CHECK(found > 100); // else there is nothing to see here
}
