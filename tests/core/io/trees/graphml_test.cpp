// What the reader and the writer of GraphML promise.
#include "tests/support/grown_tree.h"
#include "tests/support/peak_memory.h"
#include "tests/support/round_trip.h"
#include "tests/support/tree_bytes.h"

#include <doctest/doctest.h>

using namespace ramus;

namespace {

std::string graphml(const std::string& nodes, const std::string& edges) {
    return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
           "<!-- Created by igraph -->\n"
           "<graphml xmlns=\"http://graphml.graphdrawing.org/xmlns\">\n"
           "<key id=\"v_X\" for=\"node\" attr.name=\"X\" attr.type=\"double\"/>\n"
           "<key id=\"v_Y\" for=\"node\" attr.name=\"Y\" attr.type=\"double\"/>\n"
           "<key id=\"v_Z\" for=\"node\" attr.name=\"Z\" attr.type=\"double\"/>\n"
           "<key id=\"e_radius_max\" for=\"edge\" attr.name=\"radius_max\" attr.type=\"double\"/>\n"
           "<key id=\"e_radius_avg\" for=\"edge\" attr.name=\"radius_avg\" attr.type=\"double\">"
           "<default>0.75</default></key>\n"
           "<graph id=\"G\" edgedefault=\"undirected\">\n" +
           nodes + edges + "</graph>\n</graphml>\n";
}

std::string graphml_node(const std::string& id, const std::string& x, const std::string& y, const std::string& z) {
    return "<node id=\"" + id + "\"><data key=\"v_X\">" + x + "</data><data key=\"v_Y\">" + y +
           "</data>\n<data key=\"v_Z\">" + z + "</data></node>\n";
}

std::string graphml_edge(const std::string& from, const std::string& to, const std::string& radius) {
    return "<edge source=\"" + from + "\" target=\"" + to + "\"><data key=\"e_radius_max\">99</data>" +
           (radius.empty() ? "" : "<data key=\"e_radius_avg\">" + radius + "</data>") + "</edge>\n";
}

std::string fork_as_graphml() {
    return graphml(graphml_node("n0", "0", "0", "0.25") + graphml_node("n1", "0", "0", "8") +
                       graphml_node("n2", "3", "0", "12") + graphml_node("n3", "-3", "0", "12"),
                   graphml_edge("n0", "n1", "2") + graphml_edge("n1", "n2", "1.5") + graphml_edge("n3", "n1", ""));
}

} // namespace

TEST_CASE("GraphML of VesselVio has the mean radius of an edge, or the one that its key declares") {
    const auto tree = io::parse_tree(fork_as_graphml(), "tree.graphml");
    REQUIRE_MESSAGE(tree.has_value(), (tree ? std::string() : tree.error().message()));
    REQUIRE(tree->points.size() == 4);
    CHECK(tree->branches.size() == 3);
    CHECK(tree->roots == std::vector<std::uint32_t>{0}); // the thickest end
    CHECK(tree->points[0].position == glm::dvec3(0, 0, 0.25));
    CHECK(tree->points[1].radius == 2.0);
    CHECK(tree->points[2].radius == 1.5);
    CHECK(tree->points[3].radius == 0.75);
    CHECK(io::parse_tree(fork_as_graphml(), "tree.dat").has_value());
    io::ReadOptions options;
    options.columns = {{"radius", "radius_max"}};
    const auto widest = io::parse_tree(fork_as_graphml(), "tree.graphml", options);
    REQUIRE(widest.has_value());
    CHECK(widest->points[2].radius == 99.0);
}

TEST_CASE("two vessels between the same nodes stay two") {
    const auto tree = io::parse_tree(
        graphml(graphml_node("n0", "0", "0", "0.25") + graphml_node("n1", "0", "0", "8"),
                graphml_edge("n0", "n1", "2") + graphml_edge("n1", "n0", "1") + graphml_edge("n1", "n1", "3")),
        "tree.graphml");
    REQUIRE(tree.has_value());
    CHECK(tree->loop_count == 1);
    CHECK(test::says(*tree, "1 edge from a node to itself"));
}

TEST_CASE("a grown tree comes back from GraphML to the bit, and so do networks with loops") {
    tree::VesselTree tree = test::grown(300);
    for (std::size_t p = 0; p < tree.points.size(); ++p) tree.labels.push_back(static_cast<int>(p % 7) - 1);
    const tree::VesselTree read = test::through_a_file(tree, ".graphml", {"a -- comment --->", "one\nmore \x01 & <b>"});
    test::check_same_network(read, tree);
    CHECK(read.labels == tree.labels);
    CHECK(sentences(read, tree::Note::Kind::kAssumed).empty());
    CHECK(sentences(read, tree::Note::Kind::kRepaired).empty());
    const tree::VesselTree rings = test::rings_and_crossings();
    test::check_same_network(test::through_a_file(rings, ".graphml"), rings);
}

TEST_CASE("systems come back from GraphML with their names and colours") {
    tree::Graph graph;
    graph.points = {{{0, 0, 0}, 2}, {{0, 0, 9}, 1}, {{5, 0, 0}, 2}, {{5, 0, 9}, 1.0 / 3.0}};
    graph.edges = {{0, 1}, {2, 3}};
    graph.systems = {{"Pfortader <&>", {10, 20, 255}}, {"V\xC3\xA4ne", {1, 2, 3}}};
    graph.point_systems = {0, 0, 1, 1};
    const auto tree = tree::build_tree(graph, tree::Repair::kUsual, [](std::uint32_t) { return std::string("g"); });
    REQUIRE(tree.has_value());
    for (const char* extension : {".graphml", ".csv"}) {
        CAPTURE(extension);
        const tree::VesselTree read = test::through_a_file(*tree, extension);
        test::check_same_network(read, *tree);
        CHECK(read.systems == tree->systems);
        REQUIRE(read.branches.size() == 2);
        CHECK(read.branches[1].system == tree->branches[1].system);
    }
}

TEST_CASE("GraphML that is wrong is refused with its line") {
    using test::refusal, test::replaced;
    const std::string good = fork_as_graphml();
    CHECK(refusal(replaced(good, "source=\"n3\"", "source=\"n7\""), "t.graphml").find("t.graphml:20: the edge") == 0);
    CHECK(refusal(replaced(good, ">12<", ">1,2<"), "t.graphml").find("decimal point") != std::string::npos);
    CHECK(refusal(replaced(good, ">1.5<", ">inf<"), "t.graphml").find("not positive") != std::string::npos);
    CHECK(refusal(replaced(good, "<data key=\"v_Y\">0</data>", ""), "t.graphml").find("y is missing") !=
          std::string::npos);
    CHECK(refusal(replaced(good, "\"n1\"", "\"n0\""), "t.graphml").find("is there twice") != std::string::npos);
    CHECK(refusal(replaced(good, "attr.name=\"X\"", "attr.name=\"U\""), "t.graphml").find("positions") !=
          std::string::npos);
    std::string bare =
        replaced(replaced(good, "radius_max\" attr.type", "a\" attr.type"), "radius_avg\" attr.type", "b\" attr.type");
    CHECK(refusal(bare, "t.graphml").find("gives the radius") != std::string::npos);
    for (std::size_t part = 0; part < 20; ++part) {
        CAPTURE(part);
        CHECK_FALSE(refusal(good.substr(0, good.size() * part / 20), "t.graphml").empty());
    }
}

TEST_CASE("GraphML with many keys takes no more than its bytes") {
    const test::PeakMemory memory;
    std::string keys;
    for (int key = 0; key < 20'000; ++key)
        keys += "<key id=\"k" + std::to_string(key) + "\" for=\"node\" attr.name=\"a\" attr.type=\"double\"/>\n";
    std::string nodes;
    for (int node = 0; node < 20'000; ++node) nodes += "<node id=\"m" + std::to_string(node) + "\"/>\n";
    CHECK_FALSE(io::parse_tree(test::replaced(fork_as_graphml(), "<graph id", keys + "<graph id"), "t.graphml")
                    .value()
                    .points.empty());
    CHECK(test::refusal(test::replaced(test::replaced(fork_as_graphml(), "<graph id", keys + "<graph id"), "<node id",
                                       nodes + "<node id"),
                        "t.graphml")
              .find("x is missing") != std::string::npos);
    CHECK(memory.grown_mib() < 100.0);
}
