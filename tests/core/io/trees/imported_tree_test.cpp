// What a file leaves open is decided in one place, and told: unit, axes, radius or diameter, joints, repeated trunks.
#include "core/io/trees/imported_tree.h"
#include "core/io/trees/tree_file.h"

#include <algorithm>
#include <doctest/doctest.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

using namespace ramus;
using tree::Note;

namespace {

// A straight vessel along x of so many points.
io::ImportedTree straight(std::uint32_t points, double spacing, double radius) {
    io::ImportedTree imported;
    for (std::uint32_t i = 0; i < points; ++i) {
        imported.graph.points.push_back({{spacing * i, 0.0, 0.0}, radius});
        if (i > 0) imported.graph.edges.emplace_back(i - 1, i);
    }
    imported.place_of = [](std::uint32_t p) { return "file:" + std::to_string(p); };
    return imported;
}

tree::VesselTree read(io::ImportedTree imported, const io::ReadOptions& options = {}) {
    auto tree = io::tree_of(std::move(imported), options);
    REQUIRE_MESSAGE(tree.has_value(), (tree ? std::string() : tree.error().message()));
    return std::move(*tree);
}

// All sentences of this kind about this topic.
std::string told(const tree::VesselTree& tree, Note::Kind kind, const std::string& topic) {
    std::string all;
    for (const Note& note : tree.notes)
        if (note.kind == kind && note.topic == topic) all += note.text + "\n";
    return all;
}

bool says(const std::string& text, const std::string& words) { return text.find(words) != std::string::npos; }

io::ReadOptions in(const char* unit) {
    io::ReadOptions options;
    options.unit = io::length_unit(unit);
    REQUIRE(options.unit);
    return options;
}

} // namespace

TEST_CASE("a unit has its names, and a size of voxels is one") {
    CHECK(io::length_unit("um")->mm.x == 1e-3);
    CHECK(io::length_unit("cm") == io::length_unit("centimetre"));
    CHECK(io::length_unit("m")->mm.y == 1e3);
    CHECK(io::length_unit("0.62")->mm == glm::dvec3(0.62));
    CHECK(io::length_unit("0.3x0.4x0.6mm")->mm == glm::dvec3(0.3, 0.4, 0.6));
    for (const char* wrong : {"", "furlong", "0", "-1", "nan", "inf", "1x2", "1x2x3x4", "1x", "x1"})
        CHECK_FALSE_MESSAGE(io::length_unit(wrong), wrong);
    CHECK(io::length_unit("Centimeters") == io::length_unit("cm"));
    CHECK(io::name_of(*io::length_unit("cm")) == "cm");
    CHECK(io::named_unit_mm("microns") == 1e-3);
    CHECK_FALSE(io::named_unit_mm("0.62")); // a size is no name
}

TEST_CASE("a unit that the file does not name is taken as mm, with a word; one that it names, without") {
    const auto plain = read(straight(5, 10.0, 2.0));
    CHECK(says(told(plain, Note::Kind::kAssumed, "units"), "counts as 1 mm"));
    io::ImportedTree stated = straight(5, 1.0, 0.2);
    stated.unit = io::length_unit("cm");
    const auto cm = read(stated);
    CHECK(told(cm, Note::Kind::kAssumed, "units").empty());
    CHECK(cm.points[4].position.x == 40.0);
    CHECK(cm.points[4].radius == 2.0);
    // Whoever reads it says otherwise.
    const auto um = read(stated, in("um"));
    CHECK(um.points[4].position.x == doctest::Approx(0.004));
    CHECK(says(told(um, Note::Kind::kAssumed, "units"), "um as asked for; the file says cm"));
}

TEST_CASE("sizes that no vessels have make the unit suspect") {
    struct Case {
        double spacing, radius;
        const char* advice; // empty: nothing is suspect
    };
    for (const Case& one : {Case{10.0, 2.0, ""}, Case{1000.0, 2.0, "--units um"}, Case{10.0, 30.0, "--units um"},
                            Case{1.0, 0.3, "--units cm"}, Case{0.1, 0.01, "--units m is"}}) {
        CAPTURE(one.spacing);
        const std::string suspicion = told(read(straight(5, one.spacing, one.radius)), Note::Kind::kSuspect, "units");
        CHECK(suspicion.empty() == (*one.advice == '\0'));
        CHECK(says(suspicion, one.advice));
    }
    io::ImportedTree hinted = straight(5, 10.0, 2.0);
    hinted.unit_hint = "its arrays are those of a program that counts in cm";
    CHECK(says(told(read(hinted), Note::Kind::kSuspect, "units"), "that counts in cm: --units cm"));
    // A unit that is stated or asked for is held against sizes, too.
    CHECK(says(told(read(straight(5, 10.0, 2.0), in("m")), Note::Kind::kSuspect, "units"), "too large"));
    CHECK(says(told(read(straight(5, 10.0, 0.2), in("nm")), Note::Kind::kSuspect, "units"), "too small"));
    CHECK(told(read(straight(5, 10.0, 2.0), in("um")), Note::Kind::kSuspect, "units").empty());
}

TEST_CASE("many points with whole coordinates are likely those of voxels") {
    CHECK(says(told(read(straight(100, 1.0, 2.0)), Note::Kind::kSuspect, "units"), "voxel"));
    CHECK(told(read(straight(99, 1.0, 2.0)), Note::Kind::kSuspect, "units").empty());
    CHECK(told(read(straight(100, 1.25, 2.0)), Note::Kind::kSuspect, "units").empty());
    const auto voxels = read(straight(100, 1.0, 2.0), in("0.5x0.5x4"));
    CHECK(voxels.points[2].position.x == 1.0);
    CHECK(voxels.points[0].radius == doctest::Approx(2.0)); // the cube root of 0.5 * 0.5 * 4 is 1
    CHECK(says(told(voxels, Note::Kind::kAssumed, "units"), "geometric mean"));
}

TEST_CASE("axes and widths are as the file has them, as assumed, or as asked for") {
    io::ImportedTree imported = straight(3, 10.0, 2.0);
    CHECK(says(told(read(imported), Note::Kind::kAssumed, "axes"), "RAS"));
    io::ReadOptions lps;
    lps.orientation = io::Orientation::lps();
    CHECK(read(imported, lps).points[2].position == glm::dvec3(-20.0, 0.0, 0.0));
    CHECK(says(told(read(imported, lps), Note::Kind::kAssumed, "axes"), "as asked for"));
    io::ReadOptions wide;
    wide.radius_is = io::RadiusIs::kDiameter;
    CHECK(read(imported, wide).points[0].radius == 1.0);
    CHECK(says(told(read(imported, wide), Note::Kind::kAssumed, "radius-is"), "diameters as asked for"));
    CHECK(told(read(imported), Note::Kind::kAssumed, "radius-is").empty());
    imported.radius_name = "thickness";
    CHECK(says(told(read(imported), Note::Kind::kAssumed, "radius-is"), "\"thickness\" is taken as the radius"));
}

TEST_CASE("the radius of an edge stands at its far end, and the wrong number of them is refused") {
    io::ImportedTree imported = straight(3, 10.0, 0.0);
    imported.edge_radii = {3.0, 2.0};
    const auto tree = read(imported);
    CHECK(tree.points[0].radius == 3.0); // the thicker end is the root
    CHECK(tree.points[1].radius == 3.0);
    CHECK(tree.points[2].radius == 2.0);
    CHECK(says(told(tree, Note::Kind::kAssumed, "radius"), "far end"));
    imported.edge_radii.pop_back();
    const auto refused = io::tree_of(imported, {});
    REQUIRE_FALSE(refused);
    CHECK(says(refused.error().what, "1 radii for 2 connections"));
}

TEST_CASE("a connection to a point that does not exist is refused") {
    io::ImportedTree imported = straight(3, 10.0, 1.0);
    imported.graph.edges.emplace_back(1, 7);
    const auto refused = io::tree_of(imported, {});
    REQUIRE_FALSE(refused);
    CHECK(says(refused.error().what, "names point 7"));
}

TEST_CASE("what several polylines trace is kept once, told with its place, and left alone when that is asked for") {
    // Two polylines from one inlet: 0 to 30 along x together, then apart.
    io::ImportedTree imported;
    for (const double side : {1.0, -1.0})
        for (int i = 0; i < 5; ++i) {
            const auto index = static_cast<std::uint32_t>(imported.graph.points.size());
            imported.graph.points.push_back({{10.0 * i, i > 3 ? side * 20.0 : 0.0, 0.0}, 2.0});
            if (i > 0) imported.graph.edges.emplace_back(index - 1, index);
        }
    imported.place_of = [](std::uint32_t p) { return "file:" + std::to_string(p); };
    imported.joining = io::Joining::kAtCoincidingEnds;
    imported.may_repeat_trunks = true;
    const auto merged = read(imported);
    CHECK(merged.branches.size() == 3);
    REQUIRE(std::ranges::count(merged.notes, "repeated-trunks", &Note::topic) == 1);
    const Note& note = *std::ranges::find(merged.notes, "repeated-trunks", &Note::topic);
    CHECK(note.kind == Note::Kind::kRepaired);
    REQUIRE(note.at);
    CHECK(note.at->x >= 0.0);
    CHECK(note.at->x <= 30.0);
    CHECK(note.at->y == 0.0);
    imported.joining = io::Joining::kAtAnyPoint; // point by point
    const auto joined = read(imported, in("cm"));
    CHECK(joined.branches.size() == 3);
    const Note& counted = *std::ranges::find(joined.notes, "repeated-trunks", &Note::topic);
    CHECK(says(counted.text, "3 segments"));
    REQUIRE(counted.at);
    CHECK(counted.at->x == 150.0); // in mm: the middle of the second of three segments of 100 mm
    imported.joining = io::Joining::kAtCoincidingEnds;
    io::ReadOptions as_it_is;
    as_it_is.repair = tree::Repair::kRepeatedPoints;
    CHECK(std::ranges::count(io::tree_of(imported, as_it_is)->notes, "repeated-trunks", &Note::topic) == 0);
}

TEST_CASE("a point whose parent is missing is refused, or becomes a root when that is asked for") {
    const std::string swc = "1 0 0 0 0 5 -1\n2 0 0 0 20 5 1\n3 0 40 0 20 5 77\n4 0 60 0 20 5 3\n";
    const auto refused = io::parse_tree(swc, "t.swc");
    REQUIRE_FALSE(refused);
    CHECK(says(refused.error().message(), "t.swc:3"));
    io::ReadOptions options;
    options.repair = tree::Repair::kAll;
    const auto tree = io::parse_tree(swc, "t.swc", options);
    REQUIRE(tree);
    CHECK(tree->roots.size() == 2);
    const Note& note = *std::ranges::find(tree->notes, "orphans", &Note::topic);
    CHECK(says(note.text, "t.swc:3: parent 77 does not exist"));
    CHECK(note.at == glm::dvec3(40.0, 0.0, 20.0));
}
