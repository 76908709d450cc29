// Loops of surfaces: found, cut, and left alone where the tree has a cycle.
#include "core/mesh/connectivity.h"
#include "core/mesh/loops/cut_along.h"
#include "core/mesh/loops/false_loops.h"
#include "core/mesh/loops/loop_patch.h"
#include "core/mesh/loops/match_tree.h"
#include "core/mesh/systems.h"
#include "tests/support/mesh_topology.h"

#include <array>
#include <cmath>
#include <doctest/doctest.h>
#include <glm/geometric.hpp>
#include <map>
#include <numbers>
#include <set>

namespace ramus::mesh {

namespace {

constexpr float kRadius = 10.0F, kTube = 3.0F; // of a torus
constexpr double kEnough = 1e9;                // bytes

// Around the z axis.
TriangleMesh torus(int along = 48, int around = 16, const glm::vec3& middle = glm::vec3(0.0F)) {
    TriangleMesh mesh;
    for (int i = 0; i < along; ++i)
        for (int k = 0; k < around; ++k) {
            const float u = 2.0F * std::numbers::pi_v<float> * static_cast<float>(i) / static_cast<float>(along);
            const float v = 2.0F * std::numbers::pi_v<float> * static_cast<float>(k) / static_cast<float>(around);
            const glm::vec3 outward(std::cos(u), std::sin(u), 0.0F);
            const glm::vec3 normal = std::cos(v) * outward + std::sin(v) * glm::vec3(0.0F, 0.0F, 1.0F);
            mesh.positions.push_back(middle + kRadius * outward + kTube * normal);
            mesh.normals.push_back(normal);
            const auto at = [&](int a, int b) { return static_cast<std::uint32_t>(a % along * around + b % around); };
            mesh.triangles.push_back({at(i, k), at(i + 1, k), at(i + 1, k + 1)});
            mesh.triangles.push_back({at(i, k), at(i + 1, k + 1), at(i, k + 1)});
        }
    mesh.radii.resize(mesh.positions.size(), kTube);
    mesh.branches.resize(mesh.positions.size(), 0);
    mesh.dominance.resize(mesh.positions.size());
    return mesh;
}

// Along the middle of the torus's tube, from one angle to another, in turns.
tree::VesselTree arc(double from, double to) {
    constexpr int kSteps = 60;
    tree::VesselTree tree;
    tree::Branch branch;
    for (int n = 0; n <= kSteps; ++n) {
        const double angle = 2.0 * std::numbers::pi * (from + (to - from) * n / kSteps);
        const bool closes = n == kSteps && to - from == 1.0;
        branch.points.push_back(closes ? 0U : static_cast<std::uint32_t>(tree.points.size()));
        if (!closes) tree.points.push_back({{kRadius * std::cos(angle), kRadius * std::sin(angle), 0.0}, kTube});
    }
    tree.branches.push_back(branch);
    return tree;
}

// A plate of cubes with so many square holes along each of two sides: bars around the holes, one cube thick.
TriangleMesh plate(int holes) {
    const int size = 2 * holes + 1;
    const auto is_cube = [&](int x, int y, int z) {
        return z == 0 && x >= 0 && y >= 0 && x < size && y < size && (x % 2 == 0 || y % 2 == 0);
    };
    TriangleMesh mesh;
    std::map<std::array<int, 3>, std::uint32_t> numbers;
    const auto corner = [&](const glm::ivec3& p) {
        const auto [number, fresh] = numbers.try_emplace({p.x, p.y, p.z}, numbers.size());
        if (fresh) mesh.positions.emplace_back(p), mesh.normals.emplace_back(0.0F);
        return number->second;
    };
    for (int x = 0; x < size; ++x)
        for (int y = 0; y < size; ++y)
            for (int axis = 0; axis < 3; ++axis)
                for (const int side : {0, 1}) {
                    glm::ivec3 way(0), u(0), v(0);
                    way[axis] = 2 * side - 1, u[(axis + 1) % 3] = 1, v[(axis + 2) % 3] = 1;
                    if (!is_cube(x, y, 0) || is_cube(x + way.x, y + way.y, way.z)) continue;
                    glm::ivec3 at(x, y, 0);
                    at[axis] += side;
                    if (side == 0) std::swap(u, v);
                    const std::array corners{corner(at), corner(at + u), corner(at + u + v), corner(at + v)};
                    mesh.triangles.emplace_back(corners[0], corners[1], corners[2]);
                    mesh.triangles.emplace_back(corners[0], corners[2], corners[3]);
                    for (const std::uint32_t n : corners) mesh.normals[n] += glm::vec3(way);
                }
    for (glm::vec3& normal : mesh.normals) normal = glm::normalize(normal);
    mesh.radii.resize(mesh.positions.size(), 0.5F);
    mesh.branches.resize(mesh.positions.size(), 0);
    mesh.dominance.resize(mesh.positions.size());
    return mesh;
}

// The axes of its bars, but for so many of those along y.
tree::VesselTree bars(int holes, int missing) {
    tree::VesselTree tree;
    const auto number = [&](int x, int y) { return static_cast<std::uint32_t>(y * (holes + 1) + x); };
    for (int y = 0; y <= holes; ++y)
        for (int x = 0; x <= holes; ++x) {
            tree.points.push_back({{2.0 * x + 0.53, 2.0 * y + 0.48, 0.51}, 0.5});
            if (x < holes) tree.branches.emplace_back().points = {number(x, y), number(x + 1, y)};
            if (y < holes && missing-- <= 0) tree.branches.emplace_back().points = {number(x, y), number(x, y + 1)};
        }
    return tree;
}

// A fan on the other side of an open surface's rim.
TriangleMesh closed_by_point(TriangleMesh mesh, const ClosedLine& rim) {
    const auto tip = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.emplace_back(0.5F, 0.0F, 5.0F);
    for (std::size_t n = 0; n < rim.vertices.size(); ++n)
        mesh.triangles.emplace_back(rim.vertices[(n + 1) % rim.vertices.size()], rim.vertices[n], tip);
    return mesh;
}

std::size_t edges_of_loops(const TriangleMesh& mesh) {
    Job job;
    const SurfaceGraph graph(mesh);
    return ClosedLines(graph, {}, job).edges().size();
}

std::vector<ClosedLine> shortest_lines(const TriangleMesh& mesh, std::uint32_t vertex, double longest) {
    Job job;
    const SurfaceGraph graph(mesh);
    std::size_t visited = 0;
    return ClosedLines(graph, {}, job).shortest(vertex, longest, visited);
}

SurfaceParts parts_at(const TriangleMesh& mesh, std::span<const Bounds<glm::vec3>> places) {
    const TriangleBoxes boxes(mesh.positions, mesh.triangles);
    return SurfaceParts(mesh, boxes, triangles_at(mesh, boxes, places));
}

// All that are too many.
std::size_t cut_all(TriangleMesh& mesh, const tree::VesselTree& tree, double memory_bytes, Job& job,
                    std::span<const Bounds<glm::vec3>> walls = {}) {
    return cut_false_loops(mesh, tree::prune(tree, 0.0), parts_at(mesh, walls), memory_bytes, job).cut;
}

double angle_of(const glm::vec3& p) { return std::atan2(p.y, p.x) / (2.0 * std::numbers::pi); } // in turns

} // namespace

TEST_CASE("each loop of a surface has a line around its tube and one along it") {
    Job job;
    TriangleMesh mesh = torus();
    {
        const SurfaceGraph graph(mesh);
        const ClosedLines lines(graph, {}, job);
        std::size_t visited = 0;
        CHECK(graph.edges().size() == 3 * mesh.triangles.size() / 2);
        CHECK(lines.edges().size() == 2);
        const auto shortest = lines.shortest(0, 100.0, visited);
        REQUIRE(shortest.size() == 3); // around the tube, along it, and both
        const double meridian = 2.0 * 16 * kTube * std::sin(std::numbers::pi / 16);
        const double inner = 2.0 * 48 * (kRadius - kTube) * std::sin(std::numbers::pi / 48);
        CHECK(shortest[0].length == doctest::Approx(meridian).epsilon(1e-5));
        CHECK(shortest[0].vertices.size() == 16);
        // Vertex 0 is on the torus's outside: the line goes to its inside and back.
        CHECK(shortest[1].length > inner);
        for (const ClosedLine& line : shortest) {
            const std::set<std::uint32_t> each(line.vertices.begin(), line.vertices.end());
            CHECK(each.size() == line.vertices.size());
        }
        const auto inside = lines.shortest(8, 100.0, visited); // on the torus's inside
        REQUIRE(inside.size() == 3);
        CHECK(inside[1].length == doctest::Approx(inner).epsilon(1e-5));
        CHECK(lines.shortest(0, 0.99 * meridian, visited).empty());
    }
    append(mesh, torus(30, 12, {40, 0, 0}));
    CHECK(edges_of_loops(mesh) == 4);
    CHECK(cut_along(mesh, shortest_lines(mesh, 0, 20.0).front()));
    CHECK(edges_of_loops(mesh) == 2);
}

TEST_CASE("what is told of loops does not depend on how many there are") {
    constexpr int kMany = 100; // of two rows of triangles each: more than labels have bits
    TriangleMesh mesh;
    for (int n = 0; n < kMany; ++n) append(mesh, torus(12, 8, {40.0F * static_cast<float>(n), 0, 0}));
    CHECK(edges_of_loops(mesh) == 2 * kMany);
    for (const std::uint32_t first : {0U, 96U * 50U, 96U * 99U}) {
        const auto of_many = shortest_lines(mesh, first, 100.0), of_one = shortest_lines(torus(12, 8), 0, 100.0);
        REQUIRE(of_many.size() == of_one.size());
        for (std::size_t n = 0; n < of_one.size(); ++n)
            CHECK(of_many[n].length == doctest::Approx(of_one[n].length).epsilon(1e-4));
    }
}

TEST_CASE("of thousands of loops the false one is found" * doctest::test_suite("slow")) {
    constexpr int kHoles = 50;
    Job job;
    TriangleMesh mesh = plate(kHoles);
    REQUIRE(test::topology(mesh).closed_manifold());
    REQUIRE(connectivity_of(mesh) == Connectivity{1, kHoles * kHoles});
    CHECK(cut_all(mesh, bars(kHoles, 0), kEnough, job) == 0);
    CHECK(cut_all(mesh, bars(kHoles, 1), kEnough, job) == 1);
    CHECK(job.progress() == 1.0F);
    CHECK(test::topology(mesh).closed_manifold());
    CHECK(connectivity_of(mesh) == Connectivity{1, kHoles * kHoles - 1});
    const std::size_t whole = plate(kHoles).positions.size();
    REQUIRE(mesh.positions.size() > whole);
    for (std::size_t v = whole; v < mesh.positions.size(); ++v) // around the first bar along y
        CHECK(glm::distance(mesh.positions[v], glm::vec3(0.5F, 1.5F, 0.5F)) < 1.0F);
}

TEST_CASE("homology classes are independent if no sum of some of them is 0") {
    IndependentClasses classes;
    CHECK(!classes.allow({0, 0}));
    for (const HomologyClass& homology : {HomologyClass{6, 1}, HomologyClass{0, 3}, HomologyClass{5, 0}}) {
        REQUIRE(classes.allow(homology));
        classes.add(homology);
        CHECK(!classes.allow(homology));
    }
    CHECK(!classes.allow({6, 2})); // the first two
    CHECK(!classes.allow({3, 1})); // the first and the third
    CHECK(!classes.allow({3, 2})); // all three
    CHECK(classes.allow({3, 0}));
    CHECK(classes.allow({0, 1}));
}

TEST_CASE("several loops of one part are cut, no more than asked for, and together they do not part the surface") {
    constexpr int kHoles = 6, kLoops = kHoles * kHoles, kBars = kHoles + 1; // bars along y, of a row of holes
    for (const int missing : {2, kBars, kBars + 3}) {
        const int loops = missing - missing / kBars; // without all bars of a row the plate would be parted
        for (const int most : {1, 2, loops}) {
            CAPTURE(missing);
            CAPTURE(most);
            Job job;
            TriangleMesh mesh = plate(kHoles);
            const std::size_t whole = mesh.positions.size();
            const tree::VesselTree tree = bars(kHoles, missing);
            const Axes axes(tree);
            CHECK(FalseLoops(mesh, axes, false, {}).cut(static_cast<std::size_t>(most), job) ==
                  static_cast<std::size_t>(most));
            CHECK(test::topology(mesh).closed_manifold());
            CHECK(connectivity_of(mesh) == Connectivity{1, kLoops - most});
            for (std::size_t v = whole; v < mesh.positions.size(); ++v) { // around bars that are missing
                const glm::vec3 place = mesh.positions[v];
                const int row = static_cast<int>(0.5F * (place.y - 0.5F)),
                          bar = static_cast<int>(0.5F * (place.x + 0.5F));
                CHECK(row * kBars + bar < missing);
            }
        }
    }
}

TEST_CASE("where loops are far too many to cut in a while all stay") {
    constexpr int kHoles = 100;
    Job job;
    TriangleMesh mesh = plate(kHoles);
    const TriangleMesh before = mesh;
    CHECK(cut_all(mesh, bars(kHoles, kHoles * kHoles / 2), kEnough, job) == 0);
    CHECK(mesh == before);
}

TEST_CASE("caps that would have an edge of the surface have a vertex in their middle instead") {
    const ClosedLine ring{{0, 1, 2, 3}, 10.0}; // whose caps of least area have an edge from 0 to 2
    for (const bool taken : {true, false}) {
        TriangleMesh mesh;
        mesh.positions = {{0, 0, 0}, {1, 0, 1}, {2, 0, 0}, {1, 3, 0}};
        mesh.triangles = {{0, 1, taken ? 2U : 3U}, {taken ? 0U : 1U, 2, 3}};
        mesh = closed_by_point(mesh, ring);
        mesh.normals.resize(mesh.positions.size(), {0, 0, 1}), mesh.radii.resize(mesh.positions.size(), 1.0F);
        CHECK(cut_along(mesh, ring));
        CHECK(test::topology(mesh).closed_manifold());
        CHECK(connectivity_of(mesh) == Connectivity{2, 0});
        CHECK(mesh.positions.size() == (taken ? 11 : 9));
        CHECK(mesh.normals.size() == mesh.positions.size());
        if (taken) CHECK(glm::dot(mesh.normals[9], mesh.normals[10]) < -0.9F); // they face each other
    }
}

TEST_CASE("a surface whose triangles do not all face one way is not cut, and nobody waits forever") {
    for (const std::uint32_t triangle : {14U, 15U, 16U, 17U}) {
        CAPTURE(triangle);
        TriangleMesh mesh = torus();
        const ClosedLine line = shortest_lines(mesh, 8, 100.0).front();
        std::swap(mesh.triangles[triangle].x, mesh.triangles[triangle].y);
        const TriangleMesh before = mesh;
        CHECK(!cut_along(mesh, line));
        CHECK(mesh == before);
    }
}

TEST_CASE("a surface with a hole has no edges that could be cut along") {
    Job job;
    TriangleMesh mesh = torus();
    mesh.triangles.pop_back();
    CHECK(!SurfaceGraph(mesh).is_closed());
    const TriangleMesh before = mesh;
    const tree::VesselTree tree = arc(-0.4, 0.4);
    const Axes axes(tree);
    CHECK(FalseLoops(mesh, axes, true, {}).cut(1, job) == 0);
    CHECK(mesh == before);
}

TEST_CASE("a surface cut along a line is closed, with a loop less and a hair's breadth between its caps") {
    for (const std::size_t kind : {0U, 1U}) {
        CAPTURE(kind);
        TriangleMesh mesh = torus();
        const TriangleMesh before = mesh;
        const ClosedLine line = shortest_lines(before, 8, 100.0)[kind];
        CHECK(cut_along(mesh, line));
        CHECK(test::topology(mesh).closed_manifold());
        CHECK(connectivity_of(mesh) == Connectivity{1, 0});
        CHECK(mesh.positions.size() == before.positions.size() + line.vertices.size());
        CHECK(mesh.triangles.size() == before.triangles.size() + 2 * (line.vertices.size() - 2));
        CHECK(mesh.dominance.size() == mesh.positions.size());
        for (std::size_t n = 0; n < line.vertices.size(); ++n) {
            const glm::vec3 left = mesh.positions[line.vertices[n]];
            const glm::vec3 right = mesh.positions[before.positions.size() + n];
            CHECK(glm::distance(left, right) > 0.01F * kTube);
            CHECK(glm::distance(left, right) < 0.03F * kTube);
            CHECK(glm::distance(left, before.positions[line.vertices[n]]) < 0.015F * kTube);
        }
    }
}

TEST_CASE("a loop that the tree has no cycle for is cut where no vessel runs, and another one stays") {
    Job job;
    TriangleMesh mesh = torus();
    const TriangleMesh before = mesh;
    CHECK(matches_tree(mesh, arc(0.0, 1.0)));
    CHECK(cut_all(mesh, arc(0.0, 1.0), kEnough, job) == 0);
    CHECK(mesh == before);
    CHECK(!matches_tree(mesh, arc(-0.4, 0.4)));
    CHECK(cut_all(mesh, arc(-0.4, 0.4), 100e3, job) == 0); // it has 1,536 triangles
    CHECK(mesh == before);
    CHECK(cut_all(mesh, arc(-0.4, 0.4), kEnough, job) == 1);
    CHECK(test::topology(mesh).closed_manifold());
    CHECK(connectivity_of(mesh) == Connectivity{1, 0});
    for (std::size_t v = before.positions.size(); v < mesh.positions.size(); ++v)
        CHECK(std::abs(angle_of(mesh.positions[v])) > 0.4);
    CHECK(matches_tree(mesh, arc(-0.4, 0.4)));
}

TEST_CASE("pieces of the rest that have loops are told, and no others") {
    // A torus with a ball next to it. What is near parts the torus to two tubes, or only borders on a disk.
    for (const bool across : {true, false}) {
        CAPTURE(across);
        TriangleMesh mesh = torus();
        const std::size_t ring = mesh.triangles.size();
        TriangleMesh other;
        other.positions = {{0, 0, 20}, {1, 0, 21}, {2, 0, 20}, {1, 3, 20}};
        other.triangles = {{0, 1, 3}, {1, 2, 3}};
        other = closed_by_point(other, {{0, 1, 2, 3}, 1.0});
        const auto first = static_cast<std::uint32_t>(mesh.positions.size());
        mesh.positions.insert(mesh.positions.end(), other.positions.begin(), other.positions.end());
        for (const glm::uvec3& t : other.triangles) mesh.triangles.push_back(t + first);
        LargeArray<std::uint32_t> near;
        for (std::uint32_t n = 0; n < ring; ++n) {
            const glm::vec3 at = mesh.positions[mesh.triangles[n].x];
            if (across ? std::abs(at.y) < 2.0F : at.x > 12.0F && std::abs(at.y) < 2.0F) near.push_back(n);
        }
        const SurfaceParts parts(mesh, TriangleBoxes(mesh), near, Rest::kLoops);
        CHECK(parts.of_surface() == Connectivity{2, 1});
        CHECK(parts.rest_with_loops().size() == (across ? 0 : ring - parts.parts().front().triangles.size()));
        CHECK(std::ranges::all_of(parts.rest_with_loops(), [&](std::uint32_t n) { return n < ring; }));
    }
}

TEST_CASE("a loop is cut at a place that it leads through, and at none that it does not") {
    // Boxes around parts of the torus, by the angle of their middles in turns; the vessel ends at 0.4 and -0.4.
    const auto box_at = [](double turns) {
        const double angle = 2.0 * std::numbers::pi * turns;
        const glm::vec3 middle(kRadius * std::cos(angle), kRadius * std::sin(angle), 0.0);
        return Bounds<glm::vec3>{middle - 3.5F, middle + 3.5F};
    };
    Job job;
    for (const std::vector<double>& places : std::vector<std::vector<double>>{{0.5}, {0.1, 0.5, 0.8}, {0.2, 0.3}}) {
        TriangleMesh mesh = torus();
        std::vector<Bounds<glm::vec3>> boxes;
        for (const double place : places) boxes.push_back(box_at(place));
        CHECK(cut_all(mesh, arc(-0.4, 0.4), kEnough, job, boxes) == 1);
        CHECK(test::topology(mesh).closed_manifold());
        CHECK(connectivity_of(mesh) == Connectivity{1, 0});
        for (std::size_t v = torus().positions.size(); v < mesh.positions.size(); ++v)
            CHECK(std::abs(angle_of(mesh.positions[v])) > 0.4);
    }
}

TEST_CASE("a part of a surface with its borders closed has the loops that lead through it, and is put back as it was") {
    TriangleMesh mesh = torus();
    append(mesh, torus(30, 12, {60, 0, 0}));
    for (const float reach : {1.5F, 3.0F, 4.5F, 6.0F, 15.0F}) { // of a box in the middle of one side of the first
        CAPTURE(reach);
        const std::vector<Bounds<glm::vec3>> box{{{10.0F - reach, -reach, -reach}, {10.0F + reach, reach, reach}}};
        const SurfaceParts parts = parts_at(mesh, box);
        CHECK(parts.of_surface() == Connectivity{2, 2});
        REQUIRE(!parts.parts().empty());
        for (const SurfacePart& part : parts.parts()) {
            LoopPatch patch(mesh, part);
            CHECK(test::topology(patch.closed()).closed_manifold());
            CHECK(connectivity_of(patch.closed()) == Connectivity{1, part.has_loops ? 1 : 0});
            CHECK(part.has_loops == (part.borders.size() != 1));
            TriangleMesh again = mesh;
            patch.put_back(again);
            CHECK(again == mesh);
        }
    }
    const SurfaceParts none = parts_at(mesh, {});
    CHECK(none.parts().empty());
    CHECK(none.of_surface() == Connectivity{2, 2});
}

TEST_CASE("where a vessel runs all along a loop, its hole is filled, unless another vessel goes through") {
    Job job;
    const tree::VesselTree open = arc(0.005, 1.01); // its ends pass each other
    TriangleMesh mesh = torus();
    CHECK(cut_all(mesh, open, kEnough, job) == 1);
    CHECK(connectivity_of(mesh) == Connectivity{1, 0});
    tree::VesselTree threaded = open;
    threaded.points.push_back({{0.5, 0.3, -20.0}, 1.0});
    threaded.points.push_back({{0.5, 0.3, 20.0}, 1.0});
    threaded.branches.push_back({});
    threaded.branches.back().points = {static_cast<std::uint32_t>(threaded.points.size() - 2),
                                       static_cast<std::uint32_t>(threaded.points.size() - 1)};
    mesh = torus();
    const TriangleMesh before = mesh;
    CHECK(cut_all(mesh, threaded, kEnough, job) == 0);
    CHECK(mesh == before);
}

} // namespace ramus::mesh
