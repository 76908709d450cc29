#include "tests/support/peak_memory.h"
#include "tests/support/round_trip.h"
#include "tests/support/tree_bytes.h"

#include <doctest/doctest.h>

using namespace ramus;

namespace {

std::string vvg_voxel(double x, double y, double z, const std::string& distances) {
    return "{\"pos\":[" + std::to_string(x) + "," + std::to_string(y) + "," + std::to_string(z) + "]," + distances +
           "\"numSurfaceVoxels\":3,\"volume\":2.5}";
}

std::string vvg_distances(double least, double mean, double most) {
    return "\"minDistToSurface\":" + std::to_string(least) + ",\"maxDistToSurface\":" + std::to_string(most) +
           ",\"avgDistToSurface\":" + std::to_string(mean) + ",";
}

const std::string kUnknown = "\"minDistToSurface\":Infinity,\"maxDistToSurface\":0,\"avgDistToSurface\":-nan,";

std::string vvg_node(int id, const std::string& position, const std::string& radius) {
    return "{\"id\":" + std::to_string(id) + ",\"edges\":[1,2],\"pos\":[" + position +
           "],\"voxels_\":[[1,2,3],[4,5,6]],\"radius\":" + radius + ",\"isAtSampleBorder\":false}";
}

// Ids out of order; a stem with voxels, of which the last two know no distance, and two branches from its end: one with
// a voxel, one without any.
std::string vvg_graph() {
    return "{\"graph\":{\"nodes\":[" + vvg_node(7, "0,0,0", "3") + "," + vvg_node(2, "0,0,9", "0") + "," +
           vvg_node(5, "4,0,9", "0.5") + ",\n" + vvg_node(0, "-4,0,9", "0.25") +
           "],\n\"edges\":[{\"id\":1,\"node1\":7,\"node2\":2," + "\"distance\":9,\"skeletonVoxels\":[" +
           vvg_voxel(0, 0, 3, vvg_distances(1, 2, 3)) + "," + vvg_voxel(0, 0, 5, kUnknown) + "," +
           vvg_voxel(0, 0, 7, kUnknown) + "]},\n{\"id\":2,\"node1\":2,\"node2\":5," + "\"skeletonVoxels\":[" +
           vvg_voxel(2, 0, 9, vvg_distances(0.5, 0.75, 1)) +
           "]},\n{\"id\":3,\"node1\":2,\"node2\":0,\"distance\":4,\"pathProperties\":{\"length\":4,\"avgRadiusAvg\":1}}"
           "]}}\n";
}

std::string vvg_refused(const std::string& text) { return test::refusal(text, "t.vvg"); }

} // namespace

TEST_CASE("Voreen's graphs read, with the mean distance to the surface as the radius") {
    const auto tree = io::parse_tree(vvg_graph(), "by its content");
    REQUIRE_MESSAGE(tree.has_value(), (tree ? std::string() : tree.error().message()));
    REQUIRE(tree->points.size() == 8);
    CHECK(tree->branches.size() == 3);
    CHECK(tree->roots == std::vector<std::uint32_t>{0});
    CHECK(tree->points[0] == tree::Point{{0, 0, 0}, 3.0});
    CHECK(tree->points[4] == tree::Point{{0, 0, 3}, 2.0});
    // The joint is as wide as the nearest voxel of its widest vessel, and the voxels between have what lies between.
    CHECK(tree->points[1].radius == 2.0);
    CHECK(tree->points[5].radius == 2.0);
    CHECK(tree->points[7] == tree::Point{{2, 0, 9}, 0.75});
    CHECK(test::says(*tree, "3 points without a distance to the surface"));
    CHECK(test::says(*tree, "names no unit"));
    io::ReadOptions options;
    options.columns["radius"] = "maxDistToSurface";
    const auto widest = io::parse_tree(vvg_graph(), "t.vvg", options);
    REQUIRE(widest.has_value());
    CHECK(widest->points[4].radius == 3.0);
    // What is between tapers along the vessel.
    const auto tapered =
        io::parse_tree(test::replaced(vvg_graph(), vvg_node(2, "0,0,9", "0"), vvg_node(2, "0,0,9", "0.5")), "t.vvg");
    REQUIRE(tapered.has_value());
    CHECK(tapered->points[5].radius == doctest::Approx(1.5)); // a third of the way from 2 to 0.5
    CHECK(tapered->points[6].radius == doctest::Approx(1.0));
}

TEST_CASE("a graph without the object around it, and one whose radii stand at nodes alone") {
    std::string bare = vvg_graph().substr(9);
    bare.erase(bare.rfind('}'));
    const auto tree = io::parse_tree(bare, "t.json");
    REQUIRE_MESSAGE(tree.has_value(), (tree ? std::string() : tree.error().message()));
    CHECK(tree->points.size() == 8);
    std::string at_nodes = vvg_graph();
    for (const std::string& distances : {vvg_distances(1, 2, 3), vvg_distances(0.5, 0.75, 1), kUnknown, kUnknown})
        at_nodes = test::replaced(at_nodes, distances, "");
    const auto from_nodes = io::parse_tree(at_nodes, "t.vvg");
    REQUIRE_MESSAGE(from_nodes.has_value(), (from_nodes ? std::string() : from_nodes.error().message()));
    CHECK(from_nodes->points[1].radius == 1.0);                        // of the edge's properties
    CHECK(from_nodes->points[4].radius == doctest::Approx(7.0 / 3.0)); // a third of the way from 3 to 1
}

TEST_CASE("what is wrong with a Voreen graph is told with its place") {
    const test::PeakMemory memory;
    const auto with = [&](const std::string& from, const std::string& to) {
        return vvg_refused(test::replaced(vvg_graph(), from, to));
    };
    const auto has = [](const std::string& text, const char* words) { return text.find(words) != std::string::npos; };
    CHECK(has(with("\"id\":5", "\"id\":7"), "nodes[2]: the id 7 is there twice"));
    CHECK(has(with("\"id\":5", "\"id\":\"5\""), "nodes[2]: the node has no id"));
    CHECK(has(with("\"pos\":[4,0,9]", "\"pos\":[4,9]"), "nodes[2]: pos is not [x, y, z]"));
    CHECK(has(with("\"pos\":[4,0,9]", "\"pos\":[4,Infinity,9]"), "nodes[2]: pos is not [x, y, z]"));
    CHECK(has(with("\"pos\":[4,0,9]", "\"pos\":[4,1e400,9]"), "t.vvg:1: the number 1e400 is too large"));
    CHECK(has(with("\"node2\":5", "\"node2\":1000000000"), "edges[1]: node2 names no node"));
    CHECK(has(with("\"node1\":7", "\"node1\":7.5"), "edges[0]: node1 names no node"));
    CHECK(has(with("\"edges\":[{", "\"lines\":[{"), "no list of edges"));
    CHECK(has(with("}]}}\n", "}]}"), "t.vvg:"));
    CHECK(has(with("\"distance\":4", "\"distance\":four"), "t.vvg:5: this is not valid JSON"));
    CHECK(has(vvg_refused("{\"graph\": {\"nodes\": [], \"edges\": []}}"), "no edge connects"));
    CHECK(memory.grown_mib() < 30.0);
}
