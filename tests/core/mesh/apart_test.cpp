// What surfaces with vessels kept apart share with the plain sum's, and what they promise like them.
#include "core/field/vessel_field.h"
#include "core/io/trees/tree_file.h"
#include "core/mesh/polygonize/polygonize.h"
#include "core/mesh/polygonize/polygonizer.h"
#include "core/mesh/surface.h"
#include "core/mesh/tree_field.h"
#include "tests/support/built_tree.h"
#include "tests/support/grown_tree.h"
#include "tests/support/kept_apart.h"
#include "tests/support/mesh_topology.h"
#include "tests/support/packed_trees.h"
#include "tests/support/shared_data.h"
#include "tests/support/surface_shape.h"
#include "tests/support/tree_field.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <doctest/doctest.h>
#include <glm/geometric.hpp>
#include <numbers>
#include <random>
#include <span>
#include <unordered_map>
#include <vector>

namespace ramus::mesh {

namespace {

TriangleMesh surface_with(const tree::VesselTree& tree, const SurfaceOptions& options,
                          const std::vector<std::uint8_t>& hidden = {}) {
    Job job;
    auto surface = make_surface(tree, options, job, hidden);
    REQUIRE_MESSAGE(surface, (surface ? "" : surface.error().message()));
    CHECK(surface->statistics.matched.false_loops.cut == 0);
    return std::move(surface->mesh);
}

struct BitsOfPosition {
    std::size_t operator()(const glm::vec3& p) const {
        std::array<std::uint32_t, 3> bits{};
        std::memcpy(bits.data(), &p, sizeof(bits));
        return (bits[0] * 73856093ULL) ^ (bits[1] * 19349663ULL << 7) ^ (bits[2] * 83492791ULL << 13);
    }
};

constexpr std::uint32_t kNoVertex = 0xFFFFFFFFU;

// For each vertex of one mesh the one of the other that is the same in every bit.
std::vector<std::uint32_t> same_vertices(const TriangleMesh& mesh, const TriangleMesh& other) {
    std::unordered_map<glm::vec3, std::uint32_t, BitsOfPosition> at;
    for (std::uint32_t v = 0; v < other.positions.size(); ++v) at.emplace(other.positions[v], v);
    std::vector<std::uint32_t> same(mesh.positions.size(), kNoVertex);
    for (std::uint32_t v = 0; v < mesh.positions.size(); ++v) {
        const auto found = at.find(mesh.positions[v]);
        if (found == at.end()) continue;
        const std::uint32_t w = found->second;
        if (mesh.normals[v] == other.normals[w] && mesh.radii[v] == other.radii[w] &&
            mesh.branches[v] == other.branches[w] && mesh.dominance[v] == other.dominance[w])
            same[v] = w;
    }
    return same;
}

// Triangles, as corners from the lowest on, of a mesh whose vertices all `counts`.
template <class Counts, class Name>
std::vector<std::array<std::uint32_t, 3>> triangles_where(const TriangleMesh& mesh, const Counts& counts,
                                                          const Name& name) {
    std::vector<std::array<std::uint32_t, 3>> all;
    for (const glm::uvec3& t : mesh.triangles) {
        if (!counts(t.x) || !counts(t.y) || !counts(t.z)) continue;
        std::array<std::uint32_t, 3> corners{name(t.x), name(t.y), name(t.z)};
        std::rotate(corners.begin(), std::ranges::min_element(corners), corners.end());
        all.push_back(corners);
    }
    std::ranges::sort(all);
    return all;
}

struct Agreement {
    std::size_t far = 0, near = 0; // vertices of the first
    std::size_t vertices = 0;      // far, and not in the other mesh
    bool triangles = false;        // the far ones are the same
};

// Whether two meshes are the same in every bit where nothing is `near`.
template <class Near> Agreement agreement(const TriangleMesh& mesh, const TriangleMesh& other, const Near& near) {
    Agreement found;
    const std::vector<std::uint32_t> same = same_vertices(mesh, other), back = same_vertices(other, mesh);
    std::vector<bool> far_here(mesh.positions.size()), far_there(other.positions.size());
    for (std::uint32_t v = 0; v < mesh.positions.size(); ++v) {
        far_here[v] = !near(glm::dvec3(mesh.positions[v]));
        ++(far_here[v] ? found.far : found.near);
        found.vertices += far_here[v] && same[v] == kNoVertex ? 1 : 0;
    }
    for (std::uint32_t v = 0; v < other.positions.size(); ++v) {
        far_there[v] = !near(glm::dvec3(other.positions[v]));
        found.vertices += far_there[v] && back[v] == kNoVertex ? 1 : 0;
    }
    found.triangles =
        triangles_where(
            mesh, [&](std::uint32_t v) { return far_here[v]; }, [&](std::uint32_t v) { return same[v]; }) ==
        triangles_where(
            other, [&](std::uint32_t v) { return far_there[v]; }, [](std::uint32_t v) { return v; });
    return found;
}

// A kernel reaches 1.7 radii. A vertex is told of the corners of its cell, the diagonal away at most, and a cell is
// twice 2 pi / 16 of the radius where that of a neighbour made it larger. Such a cell has fans all around where one of
// the finer cells that touch it is beside a contact: a finer one on its other side is one cell farther.
constexpr double kConcern = 1.7 + std::numbers::sqrt3 * (2.0 + 1.0) * 2.0 * std::numbers::pi / 16.0;

// A tree of which all pieces of the surface are told apart by themselves.
bool has_shape_of(const TriangleMesh& mesh, const tree::PreparedTree& prepared) {
    return test::wrong_pieces(mesh, test::pieces_of(mesh), test::pieces_of(prepared)).none();
}

// A fork whose daughters part to a closeness of 1.3, come close again to `least`, and part for good; turned at random.
tree::VesselTree fork_with_gap(double least, std::mt19937& random) {
    constexpr double kRadius = 0.8, kMost = 1.3;
    std::normal_distribution<double> normal;
    const auto any = [&] { return glm::dvec3(normal(random), normal(random), normal(random)); };
    const glm::dvec3 along = glm::normalize(any()), aside = glm::normalize(glm::cross(along, any()));
    std::vector<tree::Point> points;
    std::vector<tree::Edge> edges;
    for (int n = 0; n <= 20; ++n) points.push_back({(0.5 * n - 10.0) * along, 1.0});
    for (std::uint32_t n = 1; n < points.size(); ++n) edges.emplace_back(n - 1, n);
    const auto joint = static_cast<std::uint32_t>(points.size() - 1);
    for (const double side : {-1.0, 1.0}) {
        std::uint32_t before = joint;
        for (int n = 1; n <= 60; ++n) {
            const double x = 0.5 * n, ebb = 0.5 * (1.0 - std::cos((x - 4.0) / 10.0 * 2.0 * std::numbers::pi));
            const double closeness = x < 4.0    ? kMost * x / 4.0
                                     : x < 14.0 ? kMost - (kMost - least) * ebb
                                                : kMost + 0.4 * (x - 14.0);
            points.push_back({x * along + side * kRadius * closeness * aside, kRadius});
            const auto here = static_cast<std::uint32_t>(points.size() - 1);
            edges.emplace_back(before, here);
            before = here;
        }
    }
    return test::built_tree(std::move(points), std::move(edges));
}

} // namespace

TEST_CASE("a grown tree without contacts has the plain sum's surface, to the bit") {
    const tree::VesselTree tree = test::grown(101);
    SurfaceOptions options;
    const tree::Contacts contacts =
        tree::find_contacts(prepare_tree(tree, options), tree::limits_of_gaussian(options.width));
    REQUIRE(contacts.list.empty());
    const TriangleMesh apart = surface_with(tree, options);
    options.blend = Blend::kPaper;
    CHECK(apart == surface_with(tree, options));
}

TEST_CASE("away from contacts the surface is the plain sum's, to the bit" * doctest::test_suite("slow")) {
    // Packed trees, with forks and loops among what touches, and a real one.
    std::vector<std::pair<std::string, tree::VesselTree>> trees;
    for (const std::uint64_t seed : {1U, 2U, 5U}) trees.emplace_back(std::to_string(seed), test::packed_trees(seed));
    trees.emplace_back("grown", test::grown(1504));
    for (const auto& path : test::shared_trees())
        if (path.filename() == "brain_BG001.swc") trees.emplace_back("BG001", io::read_tree(path).value());
    for (const auto& one : trees) {
        const std::string& name = one.first;
        const tree::VesselTree& tree = one.second;
        CAPTURE(name);
        SurfaceOptions options;
        const tree::PreparedTree prepared = prepare_tree(tree, options);
        const tree::Contacts contacts = tree::find_contacts(prepared, tree::limits_of_gaussian(options.width));
        REQUIRE_FALSE(contacts.list.empty());
        const auto segments = test::kept_apart(prepared, contacts, true);
        const TriangleMesh apart = surface_with(tree, options);
        options.blend = Blend::kPaper;
        const TriangleMesh merged = surface_with(tree, options);
        const test::Concern concern(segments, contacts, kConcern);
        const Agreement found = agreement(apart, merged, [&](const glm::dvec3& p) { return concern.at(p); });
        MESSAGE(name << ": " << found.far << " vertices away from contacts, " << found.near << " near them");
        CHECK(found.vertices == 0);
        CHECK(found.triangles);
        CHECK(found.far > 10000);
        CHECK(found.near > 0);
    }
}

TEST_CASE("where one side of a contact is hidden the other is the plain sum's, to the bit" *
          doctest::test_suite("slow")) {
    const tree::VesselTree tree = test::packed_trees(5);
    SurfaceOptions options;
    const tree::PreparedTree prepared = prepare_tree(tree, options);
    const tree::Contacts contacts = tree::find_contacts(prepared, tree::limits_of_gaussian(options.width));
    const auto all = test::kept_apart(prepared, contacts, true);
    int whole = 0;
    for (std::size_t n = 0; n < std::min<std::size_t>(contacts.list.size(), 8); ++n) {
        const tree::Contact& contact = contacts.list[n];
        if (contact.sides[0].branch == contact.sides[1].branch) continue;
        CAPTURE(n);
        std::vector<std::uint8_t> hidden(tree.branches.size(), 0);
        for (const int branch : contact.sides[0].branches) hidden[static_cast<std::size_t>(branch)] = 1;
        if (hidden[static_cast<std::size_t>(contact.sides[1].branch)] != 0) continue;
        auto left = all;
        std::erase_if(left, [&](const auto& one) { return hidden[static_cast<std::size_t>(one.branch)] != 0; });
        options.blend = Blend::kTree;
        const TriangleMesh apart = surface_with(tree, options, hidden);
        options.blend = Blend::kPaper;
        const TriangleMesh merged = surface_with(tree, options, hidden);
        // Around the contact, unless others are there too.
        const glm::dvec3 at = contact.sides[1].at;
        const double around = 3.0 * contact.sides[1].radius;
        const test::Concern concern(left, contacts, kConcern);
        const Agreement found = agreement(
            apart, merged, [&](const glm::dvec3& p) { return glm::distance(p, at) > around || concern.at(p); });
        CHECK(found.vertices == 0);
        CHECK(found.triangles);
        whole += found.far > 100 ? 1 : 0;
    }
    CHECK(whole >= 2);
}

TEST_CASE("with contacts too, threads and a second run give the same bits") {
    const tree::VesselTree tree = test::packed_trees(40); // with specks across subtrees
    SurfaceOptions options;
    options.detail = 8;
    options.smooth_passes = 0;
    options.threads = 1;
    const TriangleMesh one = surface_with(tree, options);
    options.threads = 2;
    CHECK(surface_with(tree, options) == one);
    CHECK(surface_with(tree, options) == one);
}

TEST_CASE("with contacts too, what follows the tree is what is made from nothing, bit for bit" *
          doctest::test_suite("slow")) {
    struct Case {
        std::uint64_t seed;
        int detail, smooth_passes;
    };
    for (const Case& one : {Case{5, 16, 1}, Case{40, 8, 0}}) { // the second has specks across subtrees
        CAPTURE(one.seed);
        const tree::VesselTree tree = test::packed_trees(one.seed);
        SurfaceOptions surface;
        surface.smooth_passes = one.smooth_passes;
        PolygonizeOptions options;
        options.detail = one.detail;
        const tree::ContactLimits limits = tree::limits_of_gaussian(surface.width);
        REQUIRE(tree::find_contacts(prepare_tree(tree, surface), limits).list.size() > 2);
        Polygonizer polygonizer;
        Job job;
        std::mt19937 random(7);
        std::vector<std::uint8_t> hidden(tree.branches.size(), 0);
        const auto check = [&](const field::Field& field) {
            REQUIRE(polygonizer.update(field, options, job));
            const auto anew = polygonize(field, options, job);
            REQUIRE(anew.has_value());
            CHECK(polygonizer.compact() == *anew);
            CHECK(test::topology(*anew).closed_manifold());
        };
        check(test::make_field(tree, surface, hidden));
        for (int round = 0; round < 8; ++round) {
            CAPTURE(round);
            const int branch = static_cast<int>(random() % tree.branches.size());
            const auto value = static_cast<std::uint8_t>(1 - hidden[static_cast<std::size_t>(branch)]);
            for (const int below : tree::subtree(tree, branch)) hidden[static_cast<std::size_t>(below)] = value;
            if (std::ranges::count(hidden, 1) == static_cast<long>(hidden.size())) hidden.assign(hidden.size(), 0);
            check(test::make_field(tree, surface, hidden));
        }
        surface.smooth_passes = 3;
        check(test::make_field(tree, surface, hidden));
        surface.blend = Blend::kPaper;
        check(test::make_field(tree, surface, hidden));
        surface.blend = Blend::kTree;
        surface.prune_ratio = 0.3;
        check(test::make_field(tree, surface, {}));
    }
}

TEST_CASE("contacts are apart at other widths, at one cell size, smoothed and pruned" * doctest::test_suite("slow")) {
    for (const std::uint64_t seed : {1U, 4U}) {
        const tree::VesselTree tree = test::packed_trees(seed);
        std::vector<SurfaceOptions> all;
        for (const double width : {2.0, 10.0}) all.push_back({.width = width});
        all.push_back({.cell_mm = 0.4});
        all.push_back({.smooth_passes = 0});
        all.push_back({.smooth_passes = 4});
        all.push_back({.prune_ratio = 0.5});
        for (const SurfaceOptions& options : all) {
            CAPTURE(seed);
            CAPTURE(options.width);
            CAPTURE(options.cell_mm);
            CAPTURE(options.smooth_passes);
            CAPTURE(options.prune_ratio);
            const TriangleMesh mesh = surface_with(tree, options);
            CHECK(test::topology(mesh).closed_manifold());
            CHECK(has_shape_of(mesh, prepare_tree(tree, options)));
        }
    }
}

TEST_CASE("the thin gap between daughters of a fork is not bridged by cells that are larger") {
    std::mt19937 random(1);
    int bridged = 0; // in the plain sum
    for (const double least : {1.13, 1.16, 1.2, 1.25})
        for (int turn = 0; turn < 4; ++turn) {
            CAPTURE(least);
            CAPTURE(turn);
            const tree::VesselTree tree = fork_with_gap(least, random);
            SurfaceOptions options;
            options.detail = 8;
            options.smooth_passes = 0;
            const tree::PreparedTree prepared = prepare_tree(tree, options);
            CHECK(tree::find_contacts(prepared, tree::limits_of_gaussian(options.width)).list.empty());
            const TriangleMesh mesh = surface_with(tree, options);
            CHECK(test::topology(mesh).closed_manifold());
            CHECK(has_shape_of(mesh, prepared));
            options.blend = Blend::kPaper;
            bridged += has_shape_of(surface_with(tree, options), prepared) ? 0 : 1;
        }
    CHECK(bridged > 8);
}

// What was found wrong once: bricks that did not agree whose a point is, since axes nearby are moved in one of them
// only; single grid points that became pieces; vessels cut apart that are connected by way of a face's centre alone.
TEST_CASE("contacts of many vessels at one place leave closed surfaces, and no specks" * doctest::test_suite("slow")) {
    struct Case {
        std::uint64_t seed;
        int detail;
        int smooth_passes;
    };
    for (const Case& one : {Case{11, 24, 0}, Case{2, 24, 0}, Case{20, 24, 0}, Case{40, 8, 0}, Case{43, 8, 0},
                            Case{35, 8, 0}, Case{35, 8, 1}}) {
        CAPTURE(one.seed);
        const tree::VesselTree tree = test::packed_trees(one.seed);
        SurfaceOptions options;
        options.detail = one.detail;
        options.smooth_passes = one.smooth_passes;
        const TriangleMesh mesh = surface_with(tree, options);
        CHECK(test::topology(mesh).closed_manifold());
        CHECK(has_shape_of(mesh, prepare_tree(tree, options)));
    }
}

} // namespace ramus::mesh
