#include "tests/support/grown_tree.h"
#include "tests/support/peak_memory.h"
#include "tests/support/round_trip.h"
#include "tests/support/tree_bytes.h"

#include <doctest/doctest.h>

using namespace ramus;

namespace {

// A stem with two branches; the second strand leaves from inside the first.
const std::string kStrands = "$PARAM_BEGIN\nNUM_VERTS\t5\nNUM_STRANDS\t2\nNUM_ATTRIB_PER_VERT\t5\n$PARAM_END\n\n"
                             "$VERT_LIST_BEGIN\n1\t0\t0\t0\t2\t110\n2\t0\t0\t5\t1.5\t110\n3\t0\t0\t1e1\t1\t110\n"
                             "4\t3\t0\t9\t.5\t110\n5\t6\t0\t12\t0.25\t110\n$VERT_LIST_END\n\n"
                             "$STRANDS_LIST_BEGIN\n1\t1\t2\t3\t\n2\t2\t4\t5\t\n$STRANDS_LIST_END\n\n";

std::string vmv_refused(const std::string& text) { return test::refusal(text, "t.vmv"); }

} // namespace

TEST_CASE("strands hang together where they share a vertex") {
    const auto tree = io::parse_tree(kStrands, "by its content");
    REQUIRE_MESSAGE(tree.has_value(), (tree ? std::string() : tree.error().message()));
    REQUIRE(tree->points.size() == 5);
    CHECK(tree->branches.size() == 3);
    CHECK(tree->roots == std::vector<std::uint32_t>{0}); // the thickest end
    CHECK(tree->points[2] == tree::Point{{0, 0, 10}, 1.0});
    CHECK(tree->points[4] == tree::Point{{6, 0, 12}, 0.25});
    CHECK(test::says(*tree, "names no unit"));
    CHECK(test::says(*tree, "where its axes lead"));
}

TEST_CASE("other writers' strands: a sign before parameters, indices from 0 in any order, blocks of their own") {
    const auto tree = io::parse_tree("$PARAM_BEGIN\r\n$NUM_VERTS 3\r\n$NUM_STRANDS 1\r\nCOLOUR red\r\n$PARAM_END\r\n"
                                     "$VERT_LIST_BEGIN\r\n7 0 0 9 1\r\n0 0 0 0 1\r\n4 0 0 4 1\r\n$VERT_LIST_END\r\n"
                                     "$STRANDS_LIST_BEGIN\r\n0 0 4 7\r\n$STRANDS_LIST_END\r\n"
                                     "$CONNECTIVITY_LIST_BEGIN\r\n0 None / None\r\n$CONNECTIVITY_LIST_END\r\n",
                                     "t.vmv");
    REQUIRE_MESSAGE(tree.has_value(), (tree ? std::string() : tree.error().message()));
    CHECK(tree->points.size() == 3);
    CHECK(tree::length_mm(*tree, tree->branches.at(0)) == 9.0);
}

TEST_CASE("trees come back from .vmv files to the bit, whatever their shape") {
    for (const tree::VesselTree& tree : {test::grown(300), test::rings_and_crossings()}) {
        const tree::VesselTree read = test::through_a_file(tree, ".vmv", {"$PARAM_BEGIN\nNUM_VERTS 3", "# roots: 2"});
        test::check_same_network(read, tree);
        CHECK(sentences(read, tree::Note::Kind::kAssumed).empty());
        CHECK(sentences(read, tree::Note::Kind::kRepaired).empty());
    }
}

TEST_CASE("what is wrong with a file of strands is told with its line") {
    const test::PeakMemory memory;
    const auto with = [&](const char* from, const char* to) { return vmv_refused(test::replaced(kStrands, from, to)); };
    CHECK(with("NUM_VERTS\t5", "NUM_VERTS\t1000000000").find("t.vmv:13: NUM_VERTS is 1000000000, but there are 5") !=
          std::string::npos);
    CHECK(with("NUM_STRANDS\t2", "NUM_STRANDS\t3").find("NUM_STRANDS is 3") != std::string::npos);
    CHECK(with("NUM_VERTS\t5", "NUM_VERTS\t-5").find("no count") != std::string::npos);
    CHECK(with("VERT\t5", "VERT\t3").find("x, y, z and the radius") != std::string::npos);
    CHECK(with("3\t0\t0\t1e1", "3\t0\tzero\t1e1").find("t.vmv:10: the y 'zero' is not a number") != std::string::npos);
    CHECK(with("3\t0\t0\t1e1\t1\t110", "3\t0\t0\t1e1").find("the radius is missing") != std::string::npos);
    CHECK(with("3\t0\t0\t1e1", "2\t0\t0\t1e1").find("the index 2 is there twice") != std::string::npos);
    CHECK(with("3\t0\t0\t1e1", "third\t0\t0\t1e1").find("'third' is not a whole number") != std::string::npos);
    CHECK(with("2\t4\t5\t\n", "2\t4\t6\t\n").find("t.vmv:17: the strand names vertex '6'") != std::string::npos);
    CHECK(with("2\t2\t4\t5\t\n", "$\t2\t4\t5\t\n").find("no whole number as its name") != std::string::npos);
    CHECK(with("$STRANDS_LIST_END", "").find("ends before $STRANDS_LIST_END") != std::string::npos);
    CHECK(with("$VERT_LIST_END", "").find("where $VERT_LIST_END should") != std::string::npos);
    CHECK(with("$PARAM_END", "$PARAM_END\n$X_END").find("nothing begins that") != std::string::npos);
    CHECK(with("$PARAM_END", "$PARAM_END\nwhat").find("outside of all blocks") != std::string::npos);
    CHECK(vmv_refused(kStrands.substr(0, kStrands.find("$STRANDS_LIST_BEGIN"))).find("no block $STRANDS_LIST_BEGIN") !=
          std::string::npos);
    CHECK(memory.grown_mib() < 30.0);
}
