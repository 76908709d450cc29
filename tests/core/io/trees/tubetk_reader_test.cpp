#include "tests/support/peak_memory.h"
#include "tests/support/tree_bytes.h"

#include <doctest/doctest.h>

using namespace ramus;

namespace {

// Two tubes: the second leaves from the second point of the first. Spacing 0.5 x 0.5 x 2.
const std::string kScene =
    "ObjectType = Scene\nNDims = 3\nNObjects = 3\nObjectType = Group\nNDims = 3\nID = 7\nColor = 1 "
    "0 0 1\nEndGroup = \n";

std::string one_tube(const std::string& fields, const std::string& columns, int count, const std::string& points,
                     const std::string& spacing = "0.5 0.5 2") {
    return "ObjectType = Tube\nObjectSubType = Vessel\nNDims = 3\n" + fields + "ElementSpacing = " + spacing +
           "\nPointDim = " + columns + "\nNPoints = " + std::to_string(count) + "\nPoints = \n" + points + "\n";
}

const std::string kTrunkTube = "0 0 0 nan 4\n0 0 5 nan 3\n0 0 10 nan 2\n", kTubeColumns = "x y z rn r";
const std::string kSideTube = "id = 2\nParentID = 1\nParentPoint = 1\n";

std::string two_tubes(const std::string& side = kSideTube) {
    return kScene + one_tube("ID = 1\nParentID = 7\nRoot = True\n", kTubeColumns, 3, kTrunkTube) +
           one_tube(side, "radius mark x y z", 2, "1 1 4 0 5\n0.5 1 12 0 5", "0.5 0.5 2");
}

std::string refused(const std::string& text) { return test::refusal(text, "t.tre"); }

} // namespace

TEST_CASE("tubes are scaled as ITK scales them, turned to RAS, and connected to their parents") {
    const auto tree = io::parse_tree(two_tubes(), "t.tre");
    REQUIRE_MESSAGE(tree.has_value(), (tree ? std::string() : tree.error().message()));
    REQUIRE(tree->points.size() == 5);
    CHECK(tree->branches.size() == 3);
    CHECK(tree->roots == std::vector<std::uint32_t>{0});
    CHECK(tree->points[0].radius == 2.0); // 4 x 0.5
    CHECK(tree->points[1].position == glm::dvec3(0, 0, 10));
    CHECK(tree->points[4].position == glm::dvec3(-6, 0, 10)); // x leads to the left in the file
    CHECK(tree->points[4].radius == 0.25);
    CHECK(tree->loop_count == 0);
    bool says_axes = false;
    for (const std::string& text : sentences(*tree, tree::Note::Kind::kAssumed))
        says_axes = says_axes || text.find("LPS") != std::string::npos;
    CHECK(says_axes);
    io::ReadOptions ras;
    ras.orientation = io::Orientation::ras();
    CHECK(io::parse_tree(two_tubes(), "t.tre", ras)->points[4].position.x == 6.0);
}

TEST_CASE("points of tubes read in binary, of either precision and byte order") {
    for (const std::endian order : {std::endian::little, std::endian::big})
        for (const bool twice : {false, true}) {
            const std::vector<double> values = {0, 0, 0, 9, 4, 0, 0, 5, 9, 3, 0, 0, 10, 9, 2};
            const std::string fields = std::string("ID = 1\nBinaryData = True\nBinaryDataByteOrderMSB = ") +
                                       (order == std::endian::big ? "True" : "False") +
                                       "\nElementType = " + (twice ? "MET_DOUBLE\n" : "MET_FLOAT\n");
            const std::string text =
                kScene +
                one_tube(fields, kTubeColumns, 3,
                         twice ? test::packed<double>(values, order) : test::packed<float>(values, order)) +
                one_tube(kSideTube, "x y z r", 2, "4 0 5 1\n12 0 5 0.5\n");
            const auto tree = io::parse_tree(text, "t.tre");
            REQUIRE_MESSAGE(tree.has_value(), (tree ? std::string() : tree.error().message()));
            CHECK(tree->points.size() == 5);
            CHECK(tree->points[1].radius == 1.5);
            CHECK(refused(text.substr(0, text.find("Points = \n") + 20)).find("ends before") != std::string::npos);
        }
}

TEST_CASE("tubes with a parent and no point of it begin at its nearest, and that is told") {
    const auto tree = io::parse_tree(two_tubes("ID = 2\nParentID = 1\n"), "t.tre");
    REQUIRE(tree.has_value());
    CHECK(tree->roots.size() == 1);
    CHECK(tree->branches.size() == 3);
    bool said = false;
    for (const std::string& text : sentences(*tree, tree::Note::Kind::kAssumed))
        said = said || text.find("nearest") != std::string::npos;
    CHECK(said);
}

TEST_CASE("arteries and veins become systems, as long as they are apart") {
    const auto apart = io::parse_tree(two_tubes("ID = 2\nArtery = False\n"), "t.tre");
    REQUIRE_MESSAGE(apart.has_value(), (apart ? std::string() : apart.error().message()));
    REQUIRE(apart->systems.size() == 2);
    CHECK(apart->systems[1].name == "veins");
    CHECK(apart->branches[0].system == 0);
    CHECK(apart->branches[1].system == 1);
    const auto together = io::parse_tree(two_tubes(kSideTube + "Artery = False\n"), "t.tre");
    REQUIRE(together.has_value());
    CHECK(together->systems.empty());
    // At one place, and yet not joined.
    const auto touching = io::parse_tree(kScene + one_tube("ID = 1\n", kTubeColumns, 3, kTrunkTube) +
                                             one_tube("ID = 2\nArtery = False\n", "x y z r", 2, "0 0 10 1\n9 0 10 1"),
                                         "t.tre");
    REQUIRE_MESSAGE(touching.has_value(), (touching ? std::string() : touching.error().message()));
    CHECK(touching->roots.size() == 2);
}

TEST_CASE("what is wrong with a file of tubes is told with its line") {
    const test::PeakMemory memory;
    // Without an object; without a point.
    CHECK(refused("PointDim = x y z r\nNPoints = 1\nPoints = \n0 0 0 1 5\n").find("more columns") != std::string::npos);
    CHECK(refused(one_tube("", "x y z r", 0, "")).find("positive radius") != std::string::npos);
    CHECK(refused(test::replaced(two_tubes(), "NPoints = 3", "NPoints = 1000000000")).find("is not a number") !=
          std::string::npos);
    CHECK(refused(test::replaced(two_tubes(), "NPoints = 2", "NPoints = 1000000000"))
              .find("ends before the 1000000000 points") != std::string::npos);
    CHECK(refused(test::replaced(two_tubes(), "NPoints = 3", "NPoints = 2")).find("t.tre:21") != std::string::npos);
    CHECK(refused(test::replaced(two_tubes(), "ParentPoint = 1", "ParentPoint = 3")).find("has 3 points") !=
          std::string::npos);
    CHECK(refused(test::replaced(two_tubes(), "PointDim = x y z rn r", "PointDim = x y z rn q"))
              .find("no column of radii") != std::string::npos);
    CHECK(refused(test::replaced(two_tubes(), "0 0 5 nan 3", "0 0 five nan 3")).find("'five' is not a number") !=
          std::string::npos);
    CHECK(refused("ObjectType = Scene\nNDims = 3\nNObjects = 0\n").find("no tube") != std::string::npos);
    CHECK(memory.grown_mib() < 30.0);
}
