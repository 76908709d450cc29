// Surfaces that go through themselves, and what becomes of them: a sphere whose vertices were dragged across each
// other, and the surfaces of trees. The witness looks at all pairs of triangles (mesh_intersections.h).
#include "core/io/trees/tree_file.h"
#include "core/mesh/surface.h"
#include "core/mesh/untangle/patches.h"
#include "core/mesh/untangle/untangle.h"
#include "tests/support/icosphere.h"
#include "tests/support/mesh_intersections.h"
#include "tests/support/mesh_topology.h"
#include "tests/support/packed_trees.h"
#include "tests/support/shared_data.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <doctest/doctest.h>
#include <glm/geometric.hpp>
#include <iterator>
#include <random>
#include <set>
#include <span>
#include <vector>

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
    std::uniform_real_distribution<float> away(-0.5F, 0.5F);
    for (glm::vec3& p : crumpled.positions) p += glm::vec3(away(random), away(random), away(random));
    const mesh::TriangleMesh as_it_was = crumpled;
    const mesh::Untangled many = mesh::untangle(crumpled, {}, job);
    CHECK(many.looked_at_all);
    CHECK(many.found > 4096);
    CHECK(many.found == test::intersecting_triangles(crumpled).size());
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

TEST_CASE("what is too much to look at is told, and stays") {
    // Long triangles around one line, each of which has a box that meets all others.
    mesh::TriangleMesh bundle;
    constexpr int kTriangles = 3000;
    for (int n = 0; n < kTriangles; ++n) {
        const float angle = 0.2F + 0.0002F * static_cast<float>(n);
        const glm::vec3 outward(std::cos(angle), std::sin(angle), 0.0F);
        const auto first = static_cast<std::uint32_t>(bundle.positions.size());
        for (const glm::vec3& p : {0.1F * outward, outward + glm::vec3(0, 0, 1), outward - glm::vec3(0, 0, 1)})
            bundle.positions.push_back(p);
        bundle.triangles.emplace_back(first, first + 1, first + 2);
    }
    bundle.normals.assign(bundle.positions.size(), glm::vec3(0.0F)); // all are suspected
    bundle.radii.assign(bundle.positions.size(), 1.0F);
    const mesh::TriangleMesh before = bundle;
    Job job;
    const mesh::Untangled pairs = mesh::untangle(bundle, {}, job);
    CHECK(!pairs.looked_at_all);
    CHECK(pairs.left == pairs.found);
    CHECK(bundle == before);
    mesh::Untangled all{3, 1, true, {}};
    all.add({2, 2, true, {glm::vec3(1.0F)}});
    CHECK(all.places.size() == 1);
    CHECK((all.found == 5 && all.left == 3 && all.looked_at_all));
    all.add(pairs);
    CHECK(!all.looked_at_all);
}

TEST_CASE("triangles that meet are found wherever many lie side by side") {
    // Two plates across the axis along which they lie apart: 160,000 triangles.
    constexpr int kSide = 200;
    mesh::TriangleMesh plates;
    std::mt19937 random(20051025);
    std::uniform_real_distribution<float> jitter(-0.2F, 0.2F);
    for (const float x : {0.0F, 1000.0F}) {
        const auto first = static_cast<std::uint32_t>(plates.positions.size());
        for (int i = 0; i <= kSide; ++i)
            for (int k = 0; k <= kSide; ++k)
                plates.positions.emplace_back(x + jitter(random), static_cast<float>(i), static_cast<float>(k));
        for (std::uint32_t i = 0; i < kSide; ++i)
            for (std::uint32_t k = 0; k < kSide; ++k) {
                const std::uint32_t a = first + i * (kSide + 1) + k, b = a + kSide + 1;
                plates.triangles.emplace_back(a, b, b + 1);
                plates.triangles.emplace_back(a, b + 1, a + 1);
            }
    }
    for (const std::size_t triangle : {1000U, 50000U, 120001U}) drag(plates, triangle, 0.6F);
    const auto met = test::intersecting_triangles(plates);
    REQUIRE(met.size() > 3);
    const mesh::TriangleBoxes boxes(plates.positions, plates.triangles);
    const std::vector<mesh::Compared> all(plates.triangles.size(), mesh::Compared::kWithAll);
    Job job;
    const mesh::IntersectingTriangles found = mesh::intersecting_triangles(boxes, all, {}, job);
    CHECK(found.pairs == met);
    CHECK(found.count == met.size());
    const mesh::IntersectingTriangles many = mesh::intersecting_triangles(boxes, all, {3, 400}, job);
    CHECK(many.pairs.empty()); // more than are to be listed
    CHECK(many.count == met.size());
    CHECK(many.looked_at_all);
    CHECK(!mesh::intersecting_triangles(boxes, all, {3, 1}, job).looked_at_all);
    job.cancel();
    CHECK(!mesh::intersecting_triangles(boxes, all, {}, job).looked_at_all);
}

TEST_CASE("triangles that are compared apart meet those alone that are compared and share no corner with them") {
    mesh::TriangleMesh two =
        with_another(sphere(), {1.0 + 10.0 - 0.01, 2.0, 3.0}); // two sides that go through each other
    drag(two, 100, 0.6F);                                      // and a fold
    const auto met = test::intersecting_triangles(two);
    const auto share = [&](const mesh::TrianglePair& pair) {
        const glm::uvec3 &s = two.triangles[pair.first], &t = two.triangles[pair.second];
        return std::ranges::any_of(std::array{s.x, s.y, s.z}, [&](auto n) { return n == t.x || n == t.y || n == t.z; });
    };
    std::vector<mesh::TrianglePair> beside, of_some;
    std::ranges::copy_if(met, std::back_inserter(beside), [&](const auto& pair) { return !share(pair); });
    REQUIRE(!beside.empty());
    REQUIRE(beside.size() < met.size());
    const mesh::TriangleBoxes boxes(two.positions, two.triangles);
    const auto pairs_of = [&](std::span<const mesh::Compared> compared) {
        Job job;
        return mesh::intersecting_triangles(boxes, compared, {}, job).pairs;
    };
    std::vector<mesh::Compared> compared(two.triangles.size(), mesh::Compared::kNotAdjacent);
    CHECK(pairs_of(compared) == beside);
    const std::uint32_t one = met.front().first;
    std::ranges::copy_if(met, std::back_inserter(of_some),
                         [&](const auto& pair) { return pair.first == one || pair.second == one || !share(pair); });
    compared[one] = mesh::Compared::kWithAll;
    CHECK(pairs_of(compared) == of_some);
    std::ranges::fill(compared, mesh::Compared::kNot);
    compared[one] = mesh::Compared::kNotAdjacent;
    CHECK(pairs_of(compared).empty());
}

TEST_CASE("pairs whose surroundings have a triangle in common are one place, and others are places of their own") {
    mesh::TriangleMesh mesh = sphere();
    drag(mesh, 100, 0.6F);
    const std::size_t of_one = test::intersecting_triangles(mesh).size();
    const auto across = [&](const glm::uvec3& t) { return mesh.positions[t.x].x; };
    const bool upper = across(mesh.triangles[100]) > 1.0F; // on the other side of the middle
    const auto other = upper ? std::ranges::min_element(mesh.triangles, {}, across)
                             : std::ranges::max_element(mesh.triangles, {}, across);
    drag(mesh, static_cast<std::size_t>(other - mesh.triangles.begin()), 0.6F);
    Job job;
    const mesh::TriangleBoxes boxes(mesh.positions, mesh.triangles);
    const auto pairs = mesh::intersecting_triangles(
                           boxes, std::vector<mesh::Compared>(mesh.triangles.size(), mesh::Compared::kWithAll), {}, job)
                           .pairs;
    REQUIRE(pairs.size() > of_one);
    const auto places = mesh::intersection_places(mesh, boxes, pairs);
    REQUIRE(places.size() == 2);
    std::set<std::uint32_t> triangles;
    std::size_t count = 0, in_all = 0;
    for (const mesh::IntersectionPlace& place : places) {
        CHECK(place.triangles.size() > place.pairs.size());
        const mesh::Patch patch = mesh::patch_around(mesh, place);
        CHECK(patch.triangles.size() == place.triangles.size());
        for (std::size_t n = 0; n < place.pairs.size(); ++n)
            CHECK(place.triangles[patch.pairs[n].first] == place.pairs[n].first);
        triangles.insert(place.triangles.begin(), place.triangles.end());
        count += place.triangles.size(), in_all += place.pairs.size();
    }
    CHECK(triangles.size() == count);
    CHECK(in_all == pairs.size());
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

TEST_CASE("surfaces of packed trees do not go through themselves, nor do caps where loops are cut" *
          doctest::test_suite("slow")) {
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

TEST_CASE("surfaces of real trees do not go through themselves" * doctest::test_suite("slow")) {
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
