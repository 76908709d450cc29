// What the writer of .vtp files promises; tests/cli/test_trees_with_vtk.py reads the same with VTK.
#include "core/io/trees/tree_file.h"
#include "tests/support/grown_tree.h"
#include "tests/support/round_trip.h"
#include "tests/support/temporary_folder.h"

#include <doctest/doctest.h>

using namespace ramus;

namespace {

tree::VesselTree through_a_file(const tree::VesselTree& tree, const std::vector<std::string>& comments = {}) {
    const TemporaryFolder folder;
    const auto file = folder.path() / "tree.vtp";
    REQUIRE(io::write_tree(tree, file, comments));
    auto read = io::read_tree(file);
    REQUIRE_MESSAGE(read.has_value(), (read ? std::string() : read.error().message()));
    return std::move(*read);
}

void check_same_tree(const tree::VesselTree& read, const tree::VesselTree& tree) {
    CHECK(read.points == tree.points); // to the bit
    CHECK(read.labels == tree.labels);
    CHECK(read.branches == tree.branches);
    CHECK(read.roots == tree.roots);
    CHECK(read.loop_count == tree.loop_count);
    CHECK(read.systems == tree.systems);
}

} // namespace

TEST_CASE("a grown tree comes back from a .vtp file to the bit") {
    tree::VesselTree tree = test::grown(300);
    for (std::size_t p = 0; p < tree.points.size(); ++p) tree.labels.push_back(static_cast<int>(p % 7) - 1);
    const tree::VesselTree read = through_a_file(tree, {"a -- comment --->", "one\nmore \x01 & <b>"});
    check_same_tree(read, tree);
    CHECK(sentences(read, tree::Note::Kind::kAssumed).empty());
    CHECK(sentences(read, tree::Note::Kind::kRepaired).empty());
}

TEST_CASE("networks with loops, pieces and points at one place come back from a .vtp file") {
    const tree::VesselTree tree = test::rings_and_crossings();
    check_same_tree(through_a_file(tree), tree);
}

TEST_CASE("systems come back from a .vtp file with their names and colours") {
    tree::Graph graph;
    graph.points = {{{0, 0, 0}, 2}, {{0, 0, 9}, 1}, {{5, 0, 0}, 2}, {{5, 0, 9}, 1.0 / 3.0}};
    graph.edges = {{0, 1}, {2, 3}};
    graph.systems = {{"Pfortader <&>", {10, 20, 255}}, {"V\xC3\xA4ne", {1, 2, 3}}};
    graph.point_systems = {1, 1, 0, 0};
    const auto tree = tree::build_tree(graph, tree::Repair::kUsual, [](std::uint32_t) { return std::string("g"); });
    REQUIRE(tree.has_value());
    REQUIRE(tree->branches[0].system == 1);
    check_same_tree(through_a_file(*tree), *tree);
}
