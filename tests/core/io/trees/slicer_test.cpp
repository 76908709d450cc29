#include "tests/support/grown_tree.h"
#include "tests/support/peak_memory.h"
#include "tests/support/round_trip.h"
#include "tests/support/tree_bytes.h"

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

using namespace ramus;
using nlohmann::json;

namespace {

json mrk_curve(const std::vector<std::array<double, 3>>& points, const std::vector<double>& radii) {
    json curve = {{"type", "Curve"},
                  {"coordinateSystem", "LPS"},
                  {"coordinateUnits", "mm"},
                  {"measurements", json::array()},
                  {"controlPoints", json::array()}};
    for (const auto& point : points)
        curve["controlPoints"].push_back({{"position", point}, {"positionStatus", "defined"}});
    curve["measurements"].push_back({{"name", "length"}, {"value", 3.0}});
    if (!radii.empty()) curve["measurements"].push_back({{"name", "Radius"}, {"controlPointValues", radii}});
    return curve;
}

// A stem and two branches, whose ends meet.
json mrk_tree() {
    return {{"@schema", "https://example.org/markups-schema-v1.0.3.json#"},
            {"markups",
             {mrk_curve({{0, 0, 0}, {1, 2, 5}, {0, 0, 10}}, {3, 2.5, 2}), mrk_curve({{0, 0, 10}, {4, 0, 14}}, {2, 1}),
              mrk_curve({{-4, 0, 14}, {0, 0, 10}}, {0.5, 1.5})}}};
}

Result<tree::VesselTree> mrk_read(const json& document, const io::ReadOptions& options = {}) {
    return io::parse_tree(document.dump(1), "t.mrk.json", options);
}

std::string mrk_refused(const json& document) { return test::refusal(document.dump(1), "t.mrk.json"); }

bool mrk_has(const std::string& text, const char* words) { return text.find(words) != std::string::npos; }

} // namespace

TEST_CASE("curves of 3D Slicer are joined where their ends meet, and turned to RAS") {
    const auto tree = io::parse_tree(mrk_tree().dump(), "by its content");
    REQUIRE_MESSAGE(tree.has_value(), (tree ? std::string() : tree.error().message()));
    REQUIRE(tree->points.size() == 5);
    CHECK(tree->branches.size() == 3);
    CHECK(tree->points[1] == tree::Point{{-1, -2, 5}, 2.5});
    CHECK(tree->points[2].radius == 2.0);
    CHECK(tree->roots == std::vector<std::uint32_t>{0});
    CHECK_FALSE(test::says(*tree, "unit"));
    CHECK_FALSE(test::says(*tree, "axes"));
}

TEST_CASE("curves in RAS, in other units, closed, with points not yet placed, and things that are no curves") {
    json mixed = mrk_tree();
    mixed["markups"][1]["coordinateSystem"] = "RAS";
    mixed["markups"][1]["controlPoints"][1]["position"] = {-4, 0, 14};
    CHECK(mrk_read(mixed)->points == mrk_read(mrk_tree())->points);
    json numbered = mrk_tree();
    for (json& markup : numbered["markups"]) markup["coordinateSystem"] = 0;
    CHECK(mrk_read(numbered)->points[1].position.x == 1.0);
    json centimetres = mrk_tree();
    for (json& markup : centimetres["markups"]) markup["coordinateUnits"] = {"cm", "UCUM", "centimeter"};
    CHECK(mrk_read(centimetres)->points[1] == tree::Point{{-10, -20, 50}, 25});
    json none = mrk_tree();
    for (json& markup : none["markups"]) markup.erase("coordinateUnits"), markup.erase("coordinateSystem");
    CHECK(test::says(*mrk_read(none), "names no unit"));
    CHECK(mrk_read(none)->points[1].position.x == -1.0);
    json closed = mrk_tree();
    closed["markups"][0]["type"] = "ClosedCurve";
    CHECK(mrk_read(closed)->loop_count == 1);
    json more = mrk_tree();
    more["markups"].push_back({{"type", "Fiducial"}, {"controlPoints", json::array()}});
    more["markups"][0]["controlPoints"].push_back({{"positionStatus", "undefined"}});
    more["markups"][0]["measurements"][1]["controlPointValues"].push_back(0.0);
    const auto tree = mrk_read(more);
    REQUIRE_MESSAGE(tree.has_value(), (tree ? std::string() : tree.error().message()));
    CHECK(tree->points == mrk_read(mrk_tree())->points);
    CHECK(test::says(*tree, "1 markup beside the curves left out"));
    CHECK(test::says(*tree, "1 control point without a place left out"));
}

TEST_CASE("radii of curves: a diameter, a name that is asked for, and those that have none") {
    json diameters = mrk_tree();
    for (json& markup : diameters["markups"]) markup["measurements"][1]["name"] = "Diameter";
    CHECK(mrk_read(diameters)->points[0].radius == 1.5);
    json own = mrk_tree();
    for (json& markup : own["markups"]) markup["measurements"][1]["name"] = "calibre";
    CHECK(mrk_has(mrk_refused(own), "no curve has a measurement of its radius"));
    io::ReadOptions options;
    options.columns["radius"] = "calibre";
    CHECK(mrk_read(own, options)->points[0].radius == 3.0);
    json bare = mrk_tree();
    bare["markups"][1]["measurements"] = json::array();
    const auto tree = mrk_read(bare);
    REQUIRE(tree.has_value());
    CHECK(tree->points[3].radius == 2.0); // of its neighbour
    CHECK(test::says(*tree, "1 curve without a measurement"));
}

TEST_CASE("trees come back from .mrk.json files to the bit, with labels, systems and roots") {
    tree::VesselTree labelled = test::grown(300);
    for (std::size_t p = 0; p < labelled.points.size(); ++p) labelled.labels.push_back(static_cast<int>(p % 7) - 1);
    tree::Graph graph;
    graph.points = {{{0, 0, 0}, 2}, {{0, 0, 9}, 1}, {{0, 0, 0}, 2}, {{5, 0, 9}, 1.0 / 3.0}};
    graph.edges = {{0, 1}, {2, 3}};
    graph.systems = {{"Pfortader \"<&>\"", {10, 20, 255}}, {"V\xC3\xA4ne", {1, 2, 3}}};
    graph.point_systems = {1, 1, 0, 0};
    graph.roots = {1, 2};
    const auto systems = tree::build_tree(graph, tree::Repair::kUsual, [](std::uint32_t) { return std::string("g"); });
    REQUIRE(systems.has_value());
    for (const tree::VesselTree& tree : {labelled, *systems, test::rings_and_crossings()}) {
        const tree::VesselTree read = test::through_a_file(tree, ".mrk.json");
        test::check_same_network(read, tree);
        CHECK(read.branches == tree.branches);
        CHECK(read.labels == tree.labels);
        CHECK(read.systems == tree.systems);
        CHECK(sentences(read, tree::Note::Kind::kAssumed).empty());
        CHECK(sentences(read, tree::Note::Kind::kRepaired).empty());
    }
}

TEST_CASE("a written file whose curves were changed since is read by its curves") {
    const TemporaryFolder folder;
    const tree::VesselTree tree = *mrk_read(mrk_tree());
    REQUIRE(io::write_tree(tree, folder.path() / "a.mrk.json"));
    const json written = json::parse(folder.text("a.mrk.json"));
    CHECK(written["markups"].size() == 3);
    CHECK(written["markups"][0]["controlPoints"][1]["position"] == json({1, 2, 5})); // LPS
    json moved = written;
    moved["markups"][0]["controlPoints"][2]["position"] = {0, 0, 11};
    const auto read = mrk_read(moved);
    REQUIRE_MESSAGE(read.has_value(), (read ? std::string() : read.error().message()));
    // Apart now, and joined where the end lies within the other vessel.
    CHECK(read->points.size() == tree.points.size() + 2);
    CHECK(test::says(*read, "an end within another vessel was joined to it"));
    CHECK(test::says(*read, "not as ramus wrote them"));
    for (const char* key : {"curves", "roots", "labels"}) {
        json damaged = written;
        damaged["ramus"][key] = {1000000000, -3};
        const auto by_curves = mrk_read(damaged);
        REQUIRE_MESSAGE(by_curves.has_value(), (by_curves ? std::string() : by_curves.error().message()));
        CHECK(by_curves->points == tree.points);
    }
    json removed = written;
    removed["markups"].erase(1);
    CHECK(mrk_read(removed)->branches.size() == 1); // the stem and one branch are one vessel
}

TEST_CASE("what is wrong with curves is told with the curve") {
    const test::PeakMemory memory;
    const auto with = [](const char* pointer, const json& value) {
        json document = mrk_tree();
        document[json::json_pointer(pointer)] = value;
        return mrk_refused(document);
    };
    CHECK(mrk_has(with("/markups", 3), "no list of markups"));
    CHECK(mrk_has(with("/markups", json::array()), "0 markups, but no curve of two points"));
    CHECK(mrk_has(with("/markups/1/controlPoints", 3), "t.mrk.json: markups[1]: the curve has no list"));
    CHECK(mrk_has(with("/markups/1/controlPoints/1/position", {1, 2}), "markups[1], point 1: the position is not"));
    CHECK(mrk_has(with("/markups/1/controlPoints/1/position/2", nullptr), "markups[1], point 1: the position is not"));
    CHECK(mrk_has(with("/markups/1/coordinateSystem", "XYZ"), "its coordinateSystem is 'XYZ'"));
    CHECK(mrk_has(with("/markups/1/coordinateUnits", "furlong"), "coordinateUnits 'furlong' are not known"));
    CHECK(mrk_has(with("/markups/1/coordinateUnits", "cm"), "in cm, those of other curves in mm"));
    CHECK(
        mrk_has(with("/markups/1/measurements/1/controlPointValues", {1, 2, 3}), "has 3 values for 2 control points"));
    CHECK(mrk_has(with("/markups/0/measurements/1/controlPointValues/1", -2), "radius -2 is negative"));
    const std::string text = mrk_tree().dump(1);
    CHECK(mrk_has(test::refusal(text.substr(0, text.size() / 2), "t.mrk.json"), "this is not valid JSON"));
    CHECK(memory.grown_mib() < 30.0);
}
