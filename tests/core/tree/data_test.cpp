// What operations on trees do with arrays of data: each is walked over with an array that repeats where its points are,
// and one that repeats which branch it is, so that the geometry alone says what must come out.
#include "core/tree/branch_data.h"
#include "core/tree/curves.h"
#include "core/tree/edit_tree.h"
#include "core/tree/merge_trunks.h"
#include "core/tree/part_of_tree.h"
#include "core/tree/prepare.h"
#include "core/tree/smooth.h"

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

namespace ramus::tree {

namespace {

std::string named_point(std::uint32_t point) { return "point " + std::to_string(point); }

VesselTree built_with_data(Graph graph, Repair repair = Repair::kAll) {
    graph.point_data = {{"x", {}}, {"sum", {}}};
    for (const Point& point : graph.points) {
        graph.point_data[0].values.push_back(point.position.x);
        graph.point_data[1].values.push_back(point.position.x + 2.0 * point.position.y - point.position.z);
    }
    auto tree = build_tree(std::move(graph), repair, named_point);
    REQUIRE_MESSAGE(tree, (tree ? "" : tree.error().message()));
    return std::move(*tree);
}

// A stem of 40 mm along z, which forks into two; one of those forks again. Each edge has a number of its own, and the
// number of what it will be a branch of.
Graph forked() {
    Graph graph;
    graph.points = {{{0, 0, 0}, 3},   {{0, 0, 20}, 3},   {{0, 0, 40}, 3},    {{20, 0, 40}, 2},
                    {{40, 0, 45}, 2}, {{-20, 0, 40}, 1}, {{40, 0, 60}, 0.5}, {{40, 30, 45}, 0.5}};
    graph.edges = {{0, 1}, {1, 2}, {2, 3}, {3, 4}, {2, 5}, {4, 6}, {4, 7}};
    graph.roots = {0};
    graph.edge_data = {{"vessel", {10, 10, 11, 11, 12, 13, 14}}, {"flow", {6.5, 6.5, 4.25, 4.25, 2.25, 1, 3.25}}};
    return graph;
}

// Every point's data say where it is.
void check_places(const VesselTree& tree, double tolerance = 1e-9) {
    REQUIRE(tree.point_data.size() == 2);
    for (const DataArray& array : tree.point_data) REQUIRE(array.values.size() == tree.points.size());
    for (std::size_t p = 0; p < tree.points.size(); ++p) {
        const glm::dvec3& at = tree.points[p].position;
        CHECK(std::abs(tree.point_data[0].values[p] - at.x) <= tolerance);
        CHECK(std::abs(tree.point_data[1].values[p] - (at.x + 2.0 * at.y - at.z)) <= 4.0 * tolerance);
    }
    for (const DataArray& array : tree.branch_data) CHECK(array.values.size() == tree.branches.size());
}

double value(const VesselTree& tree, const std::string& name, std::size_t branch) {
    const DataArray* array = array_named(tree.branch_data, name);
    REQUIRE(array != nullptr);
    return array->values.at(branch);
}

VesselTree after(const VesselTree& tree, const Edit& edit) {
    auto edited = apply(tree, edit);
    REQUIRE_MESSAGE(edited, (edited ? "" : edited.error().message()));
    check_places(edited->tree);
    // What a branch is made of says its data.
    for (std::size_t b = 0; b < edited->tree.branches.size(); ++b) {
        const std::vector<int>& sources = edited->sources[b];
        if (sources.empty()) CHECK_FALSE(is_known(value(edited->tree, "vessel", b)));
        if (!sources.empty())
            CHECK(value(edited->tree, "vessel", b) == value(tree, "vessel", static_cast<std::size_t>(sources.front())));
    }
    return std::move(edited->tree);
}

} // namespace

TEST_CASE("data of points and edges become those of a tree's points and branches") {
    const VesselTree tree = built_with_data(forked());
    check_places(tree);
    REQUIRE(tree.branches.size() == 5);
    CHECK(tree.branch_data[0].values == std::vector<double>{10, 11, 12, 13, 14});
    CHECK(tree.branch_data[1].values == std::vector<double>{6.5, 4.25, 2.25, 1, 3.25});
}

TEST_CASE("data survive repairs: points at one place, points on their own, edges that are there twice") {
    Graph graph = forked();
    graph.points.insert(graph.points.begin() + 1, {{{5, 5, 5}, 1}, {{0, 0, 0}, 3}}); // alone; at the place of the first
    for (auto& [a, b] : graph.edges) a += a > 0 ? 2 : 0, b += 2;
    graph.edges.insert(graph.edges.begin(), {0, 2});
    graph.edges.emplace_back(graph.edges[3]);
    for (DataArray& array : graph.edge_data) array.values.insert(array.values.begin(), 99), array.values.push_back(98);
    const VesselTree tree = built_with_data(graph);
    CHECK(tree.points.size() == 8);
    check_places(tree);
    CHECK(tree.branch_data[0].values == std::vector<double>{10, 11, 12, 13, 14});
}

TEST_CASE("data survive joining of open ends, at a place between points and at a point") {
    for (const double x : {5.0, 10.2}) {
        Graph graph;
        graph.points = {{{0, 0, 0}, 2.0}, {{10, 0, 0}, 2.0}, {{20, 0, 0}, 2.0}, {{x, 10, 0}, 0.5}, {{x, 1.5, 0}, 0.5}};
        graph.edges = {{0, 1}, {1, 2}, {3, 4}};
        graph.roots = {0, 4};
        graph.edge_data = {{"vessel", {1, 1, 2}}};
        const VesselTree tree = built_with_data(graph);
        REQUIRE(tree.branches.size() == 3);
        check_places(tree);
        std::vector<double> values = tree.branch_data[0].values;
        std::ranges::sort(values);
        CHECK(values == std::vector<double>{1, 1, 2});
    }
}

TEST_CASE("data survive joining of polylines and merging of trunks that repeat each other") {
    Graph graph; // two centerlines from the same root: one trunk, two outlets
    const std::vector<Point> trunk{{{0, 0, 0}, 4}, {{0, 0, 10}, 4}, {{0, 0, 20}, 4}, {{0, 0, 30}, 4}};
    for (const double side : {1.0, -1.0}) {
        const auto first = static_cast<std::uint32_t>(graph.points.size());
        graph.points.insert(graph.points.end(), trunk.begin(), trunk.end());
        graph.points.push_back({{10 * side, 0, 40}, 3});
        graph.points.push_back({{25 * side, 0, 50}, 3});
        for (std::uint32_t p = first; p < first + 5; ++p) graph.edges.emplace_back(p, p + 1);
    }
    graph.edge_data = {{"centerline", {0, 0, 0, 0, 0, 1, 1, 1, 1, 1}}};
    graph.point_data = {{"x", {}}};
    for (const Point& point : graph.points) graph.point_data[0].values.push_back(point.position.x);
    SUBCASE("point by point") { CHECK(join_coincident(graph, false).edges == 3); }
    SUBCASE("within a part of the radius") {
        for (std::size_t p = 6; p < 10; ++p) graph.points[p].position.y += 0.5;
        CHECK(merge_repeated_trunks(graph).size() == 1);
    }
    CHECK(graph.edge_data[0].values.size() == graph.edges.size());
    CHECK(graph.point_data[0].values.size() == graph.points.size());
    graph.roots = {0};
    const VesselTree tree = built_with_data(std::move(graph));
    check_places(tree);
    REQUIRE(tree.branches.size() == 3);
    CHECK(tree.branch_data[0].values == std::vector<double>{0, 0, 1});
}

TEST_CASE("data survive pruning, thinning, smoothing and taking a part of a tree") {
    const VesselTree tree = built_with_data(forked());
    const PreparedTree pruned = prune(tree, 0.45); // the twig of 15 mm goes; what it was on is one branch
    REQUIRE(pruned.tree.branches.size() == 3);
    check_places(pruned.tree);
    CHECK(value(pruned.tree, "vessel", 0) == 10);
    check_places(thinned(tree, 5.0));

    std::vector<std::uint8_t> kept(tree.branches.size(), 1);
    kept[2] = 0;
    const VesselTree part = part_of(tree, kept);
    check_places(part);
    REQUIRE(part.branches.size() == 3); // stem and first branch are one
    const double stem = 40.0, next = 20.0 + std::sqrt(20.0 * 20.0 + 5.0 * 5.0);
    CHECK(value(part, "vessel", 0) == (stem > next ? 10 : 11)); // whole numbers: that of the greater length
    CHECK(value(part, "flow", 0) == doctest::Approx((stem * 6.5 + next * 4.25) / (stem + next)));

    VesselTree voxels = tree;
    voxels.voxels = Voxels{glm::dmat3(1.0), false};
    const VesselTree smoothed = smooth(voxels, 3);
    CHECK(smoothed.point_data == tree.point_data); // points move, by half a voxel at most, with what is theirs
    check_places(smoothed, 0.5);
}

TEST_CASE("data are interpolated along curves") {
    const VesselTree tree = built_with_data(forked());
    const auto pieces = pieces_of_curves(tree);
    const VesselTree curved = along_curves(prune(tree, 0.0), pieces).tree;
    REQUIRE(curved.points.size() > tree.points.size());
    check_places(curved, 0.5 * 3.0); // no point of a curve is farther from its segments than half a radius
    CHECK(curved.branch_data == tree.branch_data);
}

TEST_CASE("data survive every edit") {
    const VesselTree tree = built_with_data(forked());
    using Kind = Edit::Kind;
    const VesselTree cut = after(tree, {Kind::kCut, {1}, {0.4, 0.0}, 5.0});
    CHECK(cut.branches.size() == 6);
    after(tree, {Kind::kDelete, {2}, {}, 0.0});
    after(tree, {Kind::kMoveRoot, {4}, {1.0, 0.0}, 0.0});
    after(tree, {Kind::kFlip, {1}, {}, 0.0});
    after(tree, {Kind::kScale, {1, 3}, {}, 2.0});
    after(tree, {Kind::kRadius, {0}, {}, 1.0});
    const VesselTree joined = after(tree, {Kind::kJoin, {2, 1}, {1.0, 0.3}, 0.0});
    CHECK(joined.points.size() == tree.points.size() + 1);
}

TEST_CASE("equal data are equal, unknown values included, and a mean leaves them out") {
    const DataArray some{"flow", {1.0, kUnknownValue, 3.0}};
    CHECK(some == DataArray{"flow", {1.0, kUnknownValue, 3.0}});
    CHECK_FALSE(some == DataArray{"flow", {1.0, 2.0, 3.0}});
    CHECK(range_of(some).known == 2);
    CHECK(range_of(some).least == 1.0);
    VesselTree tree = built_with_data(forked());
    tree.point_data[0].values.assign(tree.points.size(), 4.0);
    tree.point_data[0].values[2] = kUnknownValue;
    CHECK(mean_of(tree, tree.point_data[0], 0) == 4.0);
    tree.point_data[0].values.assign(tree.points.size(), kUnknownValue);
    CHECK_FALSE(is_known(mean_of(tree, tree.point_data[0], 0)));
}

} // namespace ramus::tree
