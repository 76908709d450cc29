// What the reader of GXL promises, on files that are written here as VascuSynth and OpenCCO write them.
#include "tests/support/peak_memory.h"
#include "tests/support/round_trip.h"
#include "tests/support/tree_bytes.h"

#include <doctest/doctest.h>

using namespace ramus;

namespace {

std::string gxl_node(const std::string& id, const std::string& type, const std::string& numbers) {
    return "<node id=\"" + id + "\"><attr name=\" nodeType\"><string> " + type +
           " </string></attr>\n<attr name=\" position\"><tup>" + numbers + "</tup></attr></node>\n";
}

std::string gxl_edge(const std::string& from, const std::string& to, const std::string& radius) {
    return "<edge id=\"e\" to=\"" + to + "\" from=\"" + from +
           "\"><attr name=\" flow\"><float>9</float></attr><attr name=\" radius\"><float>" + radius +
           "</float></attr></edge>\n";
}

std::string gxl(const std::string& body) { return "<gxl><graph id=\"t\">\n" + body + "</graph></gxl>\n"; }

std::string floats(const std::string& x, const std::string& y, const std::string& z = {}) {
    return "<float>" + x + "</float>\n<float>" + y + "</float>" + (z.empty() ? "" : "<float>" + z + "</float>");
}

// A fork whose second node is called the root, though flow comes to it.
std::string fork_as_gxl() {
    return gxl(gxl_node("n0", "bifurication", floats("0", "0", "0")) +
               gxl_node("n1", "root node", floats("0", "0", "8")) +
               gxl_node("n2", "terminal node", floats("3", "0", "12")) +
               gxl_node("n3", "terminal node", floats("-3", "0", "12")) + gxl_edge("n1", "n2", "1.5") +
               gxl_edge("n0", "n1", "2") + gxl_edge("n1", "n3", "1"));
}

} // namespace

TEST_CASE("GXL has the radius of an edge, and its root where no edge leads to") {
    const auto tree = io::parse_tree(fork_as_gxl(), "tree.xml");
    REQUIRE_MESSAGE(tree.has_value(), (tree ? std::string() : tree.error().message()));
    REQUIRE(tree->points.size() == 4);
    CHECK(tree->roots == std::vector<std::uint32_t>{0});
    CHECK(tree->branches.size() == 3);
    CHECK(tree->points[2].position == glm::dvec3(3, 0, 12));
    CHECK(tree->points[0].radius == 2.0);
    CHECK(tree->points[1].radius == 2.0);
    CHECK(tree->points[2].radius == 1.5);
    CHECK(tree->points[3].radius == 1.0);
    CHECK(test::says(*tree, "names no unit"));
    // Found by its content, whatever it is called.
    CHECK(io::parse_tree("<?xml version=\"1.0\"?>\n<!-- <x> -->\n" + fork_as_gxl(), "tree.dat").has_value());
}

TEST_CASE("GXL of two dimensions lies in a plane") {
    const auto tree = io::parse_tree(gxl(gxl_node("a", "root", floats("1", "2")) +
                                         gxl_node("b", "leaf", floats("1", "9")) + gxl_edge("a", "b", "0.5")),
                                     "flat.gxl");
    REQUIRE(tree.has_value());
    CHECK(tree->points[1].position == glm::dvec3(1, 9, 0));
}

TEST_CASE("GXL that is wrong is refused with its line") {
    using test::refusal, test::replaced;
    const std::string good = fork_as_gxl();
    CHECK(refusal(replaced(good, "to=\"n2\"", "to=\"n9\""), "t.xml").find("t.xml:14: the edge names the node 'n9'") ==
          0);
    CHECK(refusal(replaced(good, "<float>12</float>", "<float>up</float>"), "t.xml").find("z 'up' is not a number") !=
          std::string::npos);
    CHECK(refusal(replaced(good, "<float>1.5</float>", "<float>-1.5</float>"), "t.xml").find("t.xml:14") == 0);
    CHECK(refusal(replaced(good, "<float>1.5</float>", "<float>nan</float>"), "t.xml").find("not positive") !=
          std::string::npos);
    CHECK(refusal(replaced(good, "\"n1\"", "\"n0\""), "t.xml").find("is there twice") != std::string::npos);
    CHECK(refusal(replaced(good, "name=\" position\"", "name=\"place\""), "t.xml").find("0 numbers") !=
          std::string::npos);
    CHECK(refusal(gxl(""), "t.xml").find("no nodes") != std::string::npos);
    CHECK(refusal("<gxl></gxl>", "t.xml").find("no graph") != std::string::npos);
    CHECK(refusal("<svg></svg>", "t.xml").find("no graph") != std::string::npos);
    CHECK(refusal("", "t.xml").find("not valid XML") != std::string::npos);
    const std::string cut = good.substr(0, good.size() / 2);
    CHECK(refusal(cut, "t.xml").find("not valid XML") != std::string::npos);
}

TEST_CASE("entities that double each other and elements within elements do no harm") {
    const test::PeakMemory memory;
    std::string entities = "<!DOCTYPE gxl [\n<!ENTITY a0 \"12345678901234567890\">\n";
    for (int level = 1; level < 64; ++level) {
        const std::string below = "&a" + std::to_string(level - 1) + ";";
        entities += "<!ENTITY a" + std::to_string(level) + " \"" + below + below + "\">\n";
    }
    entities += "]>\n";
    const std::string bomb = entities + test::replaced(fork_as_gxl(), "<float>12</float>", "<float>&a63;</float>");
    CHECK(test::refusal(bomb, "t.xml").find("z '&a63;' is not a number") != std::string::npos);

    constexpr std::size_t kDepth = 200'000;
    std::string open, close;
    for (std::size_t level = 0; level < kDepth; ++level) open += "<a>", close += "</a>";
    CHECK(test::refusal(open, "t.xml").find("not valid XML") != std::string::npos);
    CHECK(test::refusal(gxl(open + close), "t.xml").find("no nodes") != std::string::npos);
    const std::string within =
        test::replaced(fork_as_gxl(), "<float>12</float>", "<float>" + open + close + "</float>");
    CHECK(test::refusal(within, "t.xml").find("z is missing") != std::string::npos);
    CHECK(memory.grown_mib() < 200.0);
}
