// The quick ways that bricks find their neighbours and join their edges, against plain ones.
#include "core/field/vessel_field.h"
#include "core/mesh/polygonize/join/edge_polygons.h"
#include "core/mesh/polygonize/join/join_triangles.h"
#include "core/mesh/polygonize/octree/subtree_groups.h"
#include "core/mesh/tree_field.h"
#include "core/mesh/triangle_mesh.h"
#include "tests/support/brute_force_field.h"
#include "tests/support/grown_tree.h"
#include "tests/support/tree_field.h"

#include <algorithm>
#include <array>
#include <doctest/doctest.h>
#include <map>
#include <numeric>
#include <tuple>
#include <vector>

using namespace ramus;
using namespace ramus::mesh;
using namespace ramus::mesh::bricks;

namespace {

// An adaptive octree: bricks meet others of the same size, larger and smaller ones, and none at all.
struct Scene {
    tree::VesselTree tree = *test::grown_tree(150);
    field::Field field = test::make_field(tree, {.blend = Blend::kPaper}, {}); // walls are tested elsewhere
    Octree octree;
    std::vector<std::uint32_t> subtrees;
    SurfaceCells cells;

    Scene() {
        const Sizing sizing = make_sizing(field, 10, 0.0);
        Job job;
        octree = build_octree(field, sizing, job);
        subtrees.resize(octree.subtrees.size());
        std::iota(subtrees.begin(), subtrees.end(), 0U);
        find_neighbours(octree, subtrees, cells.neighbours);
    }
};

using BrickKey = std::tuple<int, int, int, int>; // corner and level

// All bricks in order, with the segments that reach them, of an octree whose subtrees are found in groups.
std::vector<std::pair<BrickKey, std::vector<std::uint32_t>>> bricks_by_groups(const Scene& scene, std::size_t most) {
    const Sizing sizing = make_sizing(scene.field, 10, 0.0);
    Octree octree = begin_octree(scene.field, sizing);
    const Splitter splitter{scene.field, sizing, octree.lattice};
    Job job;
    const SubtreeGroups groups(splitter, octree, most, job);
    CHECK((groups.size() > 1) == (most < scene.tree.segment_count()));
    for (std::size_t n = 0; n < groups.size(); ++n) {
        SubtreeGroup group = groups.group(n, job);
        enter_upper(octree, group);
        append_subtrees(splitter, group.seeds, octree, job);
    }
    CHECK(std::ranges::is_sorted(octree.subtrees_in_order()));
    std::vector<std::pair<BrickKey, std::vector<std::uint32_t>>> bricks;
    for (const Brick& b : octree.bricks) {
        const auto list = octree.segments_of(b);
        bricks.push_back({{b.corner.x, b.corner.y, b.corner.z, b.level}, {list.begin(), list.end()}});
    }
    return bricks;
}

// Corners in a fixed order that keeps their sense of rotation.
template <std::size_t N> std::array<std::uint32_t, N> turned(std::array<std::uint32_t, N> polygon) {
    std::rotate(polygon.begin(), std::ranges::min_element(polygon), polygon.end());
    return polygon;
}
std::vector<std::array<std::uint32_t, 4>> quads_of(const std::vector<JoinedSubtree>& joined) {
    std::vector<std::array<std::uint32_t, 4>> all;
    for (const JoinedSubtree& subtree : joined)
        for (const glm::uvec4& q : subtree.quads) all.push_back(turned<4>({q.x, q.y, q.z, q.w}));
    std::ranges::sort(all);
    return all;
}
std::vector<std::array<std::uint32_t, 3>> triangles_of(const std::vector<JoinedSubtree>& joined) {
    std::vector<std::array<std::uint32_t, 3>> all;
    for (const JoinedSubtree& subtree : joined)
        for (const glm::uvec3& t : subtree.triangles)
            if (((t.x | t.y | t.z) & kAddedBit) == 0) all.push_back(turned<3>({t.x, t.y, t.z}));
    std::ranges::sort(all);
    return all;
}

} // namespace

TEST_CASE("an octree does not depend on the groups in which its subtrees are found") {
    const Scene scene;
    const auto in_one = bricks_by_groups(scene, kGroupSegments);
    CHECK(in_one.size() == scene.octree.bricks.size());
    for (const std::size_t most : {1U, 20U, 100U}) {
        CAPTURE(most);
        CHECK(bricks_by_groups(scene, most) == in_one);
    }
}

TEST_CASE("a brick's neighbours are those that a search of all bricks finds" * doctest::test_suite("slow")) {
    const Scene scene;
    const SurfaceOptions options;
    const test::BruteForceField witness(prepare_tree(scene.tree, options), options.width);
    std::map<BrickKey, std::uint32_t> bricks;
    int top = 0;
    for (std::uint32_t b = 0; b < scene.octree.bricks.size(); ++b) {
        const Brick& brick = scene.octree.bricks[b];
        bricks[{brick.corner.x, brick.corner.y, brick.corner.z, brick.level}] = b;
        top = std::max(top, static_cast<int>(brick.level));
    }
    // The brick of that size over a point, if there is one.
    const auto find = [&](glm::ivec3 point, int level) {
        const int units = brick_units(level);
        const auto down = [&](int c) { return (c < 0 ? (c - units + 1) : c) / units * units; };
        const auto found = bricks.find({down(point.x), down(point.y), down(point.z), level});
        return found == bricks.end() ? -1 : static_cast<std::int64_t>(found->second);
    };
    std::array<int, 4> kinds{};
    int full = 0;
    for (std::uint32_t b = 0; b < scene.octree.bricks.size(); ++b) {
        const Brick& brick = scene.octree.bricks[b];
        const Neighbourhood& around = scene.cells.neighbours[b];
        for (int d = 0; d < kDirections; ++d) {
            const int size = brick_units(brick.level);
            const glm::ivec3 corner = brick.corner + glm::ivec3(d % 3 - 1, d / 3 % 3 - 1, d / 9 - 1) * size;
            const Neighbour kind = around.kind(d);
            ++kinds[static_cast<std::size_t>(kind)];
            const std::int64_t same = find(corner, brick.level);
            std::int64_t larger = -1;
            for (int level = brick.level + 1; level <= top; ++level) larger = std::max(larger, find(corner, level));
            bool smaller = false;
            for (int level = 0; level < brick.level && !smaller; ++level)
                for (int z = 0; z < size && !smaller; z += brick_units(level))
                    for (int y = 0; y < size && !smaller; y += brick_units(level))
                        for (int x = 0; x < size && !smaller; x += brick_units(level))
                            smaller = find(corner + glm::ivec3(x, y, z), level) >= 0;
            const bool named = kind == Neighbour::kSame || kind == Neighbour::kCoarser;
            REQUIRE((kind == Neighbour::kSame) == (same >= 0));
            REQUIRE((kind == Neighbour::kCoarser) == (larger >= 0));
            if (named) REQUIRE(around.brick[static_cast<std::size_t>(d)] == std::max(same, larger));
            if (smaller) REQUIRE(kind == Neighbour::kFiner); // which may have lost all its bricks
            if (kind != Neighbour::kAbsent) continue;
            const bool inside = (around.full >> d & 1U) != 0;
            full += inside ? 1 : 0;
            const glm::dvec3 middle = scene.octree.lattice.position(corner + glm::ivec3(size / 2));
            REQUIRE(inside == (witness.value(middle) >= witness.isovalue()));
        }
    }
    for (const int count : kinds) CHECK(count > 1000);
    CHECK(full > 50);
}

TEST_CASE("edges joined by tables make the polygons that each makes by itself") {
    Scene scene;
    Job job;
    const JobRange range(job, 0.0F, 1.0F);
    fill_subtrees(scene.field, scene.octree, scene.subtrees, scene.cells, range);
    // One after the other: where a subtree's vertices wait is where they stay.
    SurfaceVertices all;
    for (const std::uint32_t subtree : scene.subtrees) {
        const SubtreeCells& made = scene.cells.subtrees[subtree];
        all.reserve(made.vertex_count);
        copy_vertices(*made.vertices, made.first_vertex, all, all.count, made.vertex_count);
        const Subtree& t = scene.octree.subtrees[subtree];
        for (std::uint32_t b = t.first_brick; b < t.first_brick + t.brick_count; ++b)
            if (scene.cells.cells[b].crossed)
                scene.cells.cells[b].first_vertex += static_cast<std::uint32_t>(all.count);
        all.count += made.vertex_count;
    }
    const auto filled = [&](const auto& array) { return std::span(array).first(all.count); };
    const VertexSpan vertices{filled(all.positions), filled(all.normals), filled(all.radii), filled(all.branches)};
    std::vector<JoinedSubtree> joined;
    join_subtrees(scene.field, scene.octree, scene.subtrees, scene.cells, vertices, joined, range);

    std::vector<JoinedSubtree> plain(1);
    const EdgePolygons polygons(scene.field, scene.octree, scene.cells, vertices);
    for (std::uint32_t b = 0; b < scene.octree.bricks.size(); ++b) {
        if (!scene.cells.cells[b].crossed) continue;
        const GridBits inside = scene.cells.cells[b].grid_bits();
        const auto is_inside = [&](glm::ivec3 p) { return (inside >> (p.x + 5 * p.y + 25 * p.z) & 1) != 0; };
        for (int axis = 0; axis < 3; ++axis)
            for (int n = 0; n < 125; ++n) {
                const glm::ivec3 first(n % 5, n / 5 % 5, n / 25);
                glm::ivec3 second = first;
                if (++second[axis] > 4 || is_inside(first) == is_inside(second)) continue;
                polygons.add(b, axis, first, is_inside(first), plain[0]);
            }
    }
    CHECK(quads_of(joined).size() > 10000);
    CHECK(quads_of(joined) == quads_of(plain));
    CHECK(triangles_of(joined).size() > 100);
    CHECK(triangles_of(joined) == triangles_of(plain));
}
