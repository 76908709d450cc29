#include "core/io/trees/swc.h"
#include "core/io/trees/tree_file.h"
#include "core/io/trees/tree_json.h"
#include "tests/support/shared_data.h"
#include "tests/support/temporary_folder.h"

#include <doctest/doctest.h>

using namespace ramus;

namespace {

// Two components; the first forks after an inner point, its ids are not in the order of the hierarchy.
constexpr const char* kSwc = "1 2 0.1 0.2 0.3 1.5 -1\n"
                             "2 2 1e-7 0 0 1.25 1\n"
                             "5 3 3 1 0 0.3333333333333333 2\n"
                             "4 4 3 -1 0 0.5 2\n"
                             "6 4 4 -1 0 0.4 4\n"
                             "10 0 9 9 9 1 -1\n"
                             "11 0 9 9 12345.678901234567 1 10\n";

// A ring with two tails: loops are legal here.
constexpr const char* kRing = R"({"format": "ramus-tree", "version": 1, "units": "mm", "orientation": "RAS",
 "points": [[0,0,0,1], [1,0,0,1], [2,1,0,1], [2,-1,0,1], [3,0,0,1], [4,0,0,1]],
 "branches": [[0,1], [1,2,4], [1,3,4], [4,5]], "roots": [0]})";

constexpr const char* kTwoSystems = "\"systems\": [{\"name\": \"a\", \"colour\": [1,2,3]}, {\"name\": \"b\", "
                                    "\"colour\": [4,5,6]}], \"branch_systems\": ";

std::string replaced(std::string text, const std::string& what, const std::string& with) {
    const std::size_t at = text.find(what);
    REQUIRE(at != std::string::npos);
    return text.replace(at, what.size(), with);
}

// Written in ramus's own format and read again.
Result<tree::VesselTree> written_and_read(const tree::VesselTree& tree) {
    const TemporaryFolder folder;
    REQUIRE(io::write_tree_json(tree, folder.path() / "t.json"));
    return io::parse_tree(folder.text("t.json"), "t.json");
}

} // namespace

TEST_CASE("a tree survives ramus's own format to the last bit") {
    auto tree = io::parse_tree(kSwc, "t.swc");
    REQUIRE(tree);
    tree->source = "weird \"name\"\n.swc";
    tree->notes.insert(tree->notes.begin(), {tree::Note::Kind::kRepaired, "zero-radii", "t.swc:3: something was mended",
                                             glm::dvec3(1, 0.1, 1e-300)});
    const auto again = written_and_read(*tree);
    REQUIRE(again);
    CHECK(*again == *tree);
}

TEST_CASE("loops and their branches survive ramus's own format, and SWC refuses them") {
    const auto ring = io::parse_tree(kRing, "ring.json");
    REQUIRE(ring);
    CHECK(ring->loop_count == 1);
    CHECK(ring->branches.size() == 4);
    const auto again = written_and_read(*ring);
    REQUIRE(again);
    CHECK(*again == *ring);

    TemporaryFolder folder;
    const auto refused = io::write_swc(*ring, folder.path() / "ring.swc");
    REQUIRE_FALSE(refused);
    CHECK(refused.error().what.find("1 loop of") != std::string::npos);
    CHECK(folder.names().empty());
}

TEST_CASE("systems survive ramus's own format, with names and colours") {
    const auto tree = io::parse_tree(R"({"format": "ramus-tree", "version": 2, "units": "mm", "orientation": "RAS",
        "points": [[0,0,0,1], [1,0,0,1], [5,0,0,1], [6,0,0,1]], "branches": [[0,1], [2,3]],
        "systems": [{"name": "portal", "colour": [1,2,3]}, {"name": "hepatic", "colour": [4,5,255]}],
        "branch_systems": [1, 0], "roots": [0, 2]})",
                                     "t.json");
    REQUIRE(tree);
    REQUIRE(tree->systems.size() == 2);
    CHECK(tree->systems[1] == tree::System{"hepatic", {4, 5, 255}});
    CHECK(tree->branches[0].system == 1);
    CHECK(tree->branches[1].system == 0);
    CHECK(sentences(*tree, tree::Note::Kind::kSuspect).empty()); // two pieces of two systems are as they should be
    const auto again = written_and_read(*tree);
    REQUIRE(again);
    CHECK(*again == *tree);
}

TEST_CASE("a tree survives SWC, with the order of its lines") {
    TemporaryFolder folder;
    const auto tree = io::parse_tree(kSwc, "t.swc");
    REQUIRE(tree);
    REQUIRE(io::write_swc(*tree, folder.path() / "t.swc", {"two\nlines"}));
    auto again = io::parse_tree(folder.text("t.swc"), "t.swc");
    REQUIRE(again);
    CHECK(sentences(*tree, tree::Note::Kind::kAssumed).size() == 2);
    // What this program writes states unit and axes, and that they are not known where nobody has said them.
    CHECK(sentences(*again, tree::Note::Kind::kAssumed).size() == 2);
    again->notes = tree->notes;
    CHECK(*again == *tree);
    CHECK(folder.text("t.swc").starts_with("# two lines\n"));
}

TEST_CASE("SWC puts parents first where the points do not, and keeps the branches") {
    TemporaryFolder folder;
    const auto tree = io::parse_tree(R"({"format": "ramus-tree", "version": 1, "units": "mm", "orientation": "RAS",
        "points": [[3,1,0,1], [1,0,0,2], [3,-1,0,1], [0,0,0,2], [7,7,7,1], [8,8,8,1]],
        "branches": [[3,1], [1,2], [1,0], [5,4]], "roots": [3, 5]})",
                                     "t.json");
    REQUIRE(tree);
    REQUIRE(io::write_swc(*tree, folder.path() / "t.swc"));
    const auto again = io::parse_tree(folder.text("t.swc"), "t.swc");
    REQUIRE(again);
    REQUIRE(again->branches.size() == tree->branches.size());
    for (std::size_t b = 0; b < tree->branches.size(); ++b) {
        const auto& before = tree->branches[b];
        const auto& after = again->branches[b];
        CHECK(after.parent == before.parent);
        REQUIRE(after.points.size() == before.points.size());
        for (std::size_t i = 0; i < before.points.size(); ++i)
            CHECK(again->points[after.points[i]] == tree->points[before.points[i]]);
    }
}

TEST_CASE("real trees survive both formats" * doctest::test_suite("slow")) {
    for (const auto& file : test::shared_trees()) {
        CAPTURE(file.string());
        io::ReadOptions as_it_is; // with its points in their order
        as_it_is.repair = tree::without(tree::Repair::kUsual, tree::Repair::kOpenEnds);
        const auto tree = io::read_tree(file, as_it_is);
        REQUIRE(tree);
        TemporaryFolder folder;
        REQUIRE(io::write_tree_json(*tree, folder.path() / "t.json"));
        auto again = io::read_tree(folder.path() / "t.json");
        REQUIRE(again);
        CHECK(*again == *tree);
        REQUIRE(io::write_swc(*again, folder.path() / "t.swc"));
        auto third = io::read_tree(folder.path() / "t.swc");
        REQUIRE(third);
        third->source = tree->source; // SWC has no place for these two
        third->notes = tree->notes;
        CHECK(*third == *tree);
    }
}

TEST_CASE("what is wrong with a file is named with its place") {
    const struct {
        std::string text;
        const char* message;
    } cases[] = {
        {"", "bad.json: the file is empty"},
        {" \n ", "bad.json: the file is empty"},
        {"{\n\"format\": \"ramus-tree\",\n oops}", "bad.json:3: this is not valid JSON"},
        {"{\n\"a\": NaN}", "bad.json:2: this is not valid JSON"},
        {std::string("\x7f\x45LF\0\1\2", 7), "bad.json:1: this is not valid JSON"},
        {"[1, 2]", "bad.json: is not a ramus tree"},
        {"{\"version\": 1}", "bad.json: is not a ramus tree"},
        {replaced(kRing, "\"version\": 1", "\"version\": 3"), "bad.json: version: is 3, and this ramus reads up to 2"},
        {replaced(kRing, "\"version\": 1", "\"version\": \"one\""), "bad.json: version: is not a whole number"},
        {replaced(kRing, "\"mm\"", "\"um\""), "bad.json: units: are 'um', not 'mm'"},
        {replaced(kRing, "\"RAS\"", "\"LPS\""), "bad.json: orientation: is 'LPS', not 'RAS'"},
        {replaced(kRing, "\"points\"", "\"dots\""), "bad.json: points: is missing"},
        {replaced(kRing, "\"roots\": [0]", "\"roots\": 0"), "bad.json: roots: is not a list"},
        {replaced(kRing, "[2,1,0,1]", "[2,1,0]"), "bad.json: points[2]: is not [x, y, z, radius]"},
        {replaced(kRing, "[2,1,0,1]", "[2,null,0,1]"), "bad.json: points[2][1]: is not a number"},
        {replaced(kRing, "[2,1,0,1]", "[2,1,0,\n1e999]"), "bad.json:3: the number 1e999 is too large"},
        {replaced(kRing, "[2,1,0,1]", "[2,1,0,-2]"), "bad.json: points[2]: radius -2 is negative"},
        {replaced(kRing, "[2,1,0,1]", "[2e9,1,0,1]"), "bad.json: points[2]: coordinate 2e+09 mm is farther out"},
        {replaced(kRing, "[1,2,4]", "[1]"), "bad.json: branches[1]: is not a list of at least two point indices"},
        {replaced(kRing, "[1,2,4]", "[1,2,6]"), "bad.json: branches[1][2]: is not the index of one of the 6 points"},
        {replaced(kRing, "[1,2,4]", "[1,-2,4]"), "bad.json: branches[1][1]: is not the index"},
        {replaced(kRing, "[1,2,4]", "[1,2.0,4]"), "bad.json: branches[1][1]: is not the index"},
        {replaced(kRing, "\"roots\": [0]", "\"roots\": [4294967296]"), "bad.json: roots[0]: is not the index"},
        {replaced(kRing, "\"roots\"", "\"labels\": [1], \"roots\""), "bad.json: labels: are 1 for 6 points"},
        {replaced(kRing, "\"roots\"", "\"labels\": [1,2,3,4,9999999999,6], \"roots\""),
         "bad.json: labels[4]: is not a"},
        {replaced(kRing, "\"roots\"", "\"repairs\": [1], \"roots\""), "bad.json: repairs[0]: is not text"},
        {replaced(kRing, "\"roots\"", "\"notes\": [{\"kind\": \"x\"}], \"roots\""),
         "bad.json: notes[0].kind: is not assumed, repaired or suspect"},
        {replaced(kRing, "\"roots\"", "\"systems\": [{\"name\": \"a\", \"colour\": [1,2,256]}], \"roots\""),
         "bad.json: systems[0].colour: is not from 0 to 255"},
        {replaced(kRing, "\"roots\"", std::string(kTwoSystems) + "[0,0,1,0], \"roots\""),
         "bad.json: points[1]: two vessel systems are connected"},
        {replaced(kRing, "\"roots\"", std::string(kTwoSystems) + "[0,0,2,0], \"roots\""),
         "bad.json: branch_systems[2]: is not the index of a system"},
        {replaced(kRing, "[[0,1], [1,2,4], [1,3,4], [4,5]]", "[]"), "bad.json: points[0]: the tree has no segment"},
        {std::string(200'000, '[') + std::string(200'000, ']'), "bad.json:1: lists are nested deeper than 64 levels"},
    };
    for (const auto& one : cases) {
        const std::string& text = one.text;
        const std::string message = one.message;
        CAPTURE(text.substr(0, 300));
        const auto tree = io::parse_tree(text, "bad.json");
        REQUIRE_FALSE(tree);
        CHECK(tree.error().message().substr(0, message.size()) == message);
        CHECK_FALSE(tree.error().hint.empty());
    }
}

TEST_CASE("every truncation and every damaged byte of a tree file is survived") {
    const std::string good = kRing;
    for (std::size_t cut = 0; cut < good.size(); ++cut) CHECK_FALSE(io::parse_tree(good.substr(0, cut), "cut.json"));
    for (std::size_t at = 0; at < good.size(); ++at) {
        for (const char byte : {'\0', '9', '-', '"', ']', '}', '\xff'}) {
            std::string bad = good;
            bad[at] = byte;
            const auto tree = io::parse_tree(bad, "bad.json"); // any answer, but an answer
            if (!tree) CHECK_FALSE(tree.error().message().empty());
        }
    }
}
