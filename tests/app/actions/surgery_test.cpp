#include "core/io/meshes/mesh_file.h"
#include "core/io/trees/swc.h"
#include "core/io/trees/tree_json.h"
#include "tests/support/command_stage.h"
#include "tests/support/icosphere.h"
#include "tests/support/temporary_folder.h"

#include <doctest/doctest.h>
#include <fstream>

using namespace ramus;
using namespace ramus::app;
using test::Ids;
using tree::BranchState;

namespace {

// Branch 0: a stem of 10 mm, r 3, along z. At its end 1: 8 mm along x, r 2, and 2: 6 mm along y, r 1. At the end of 1,
// 3 and 4: 5 mm, r 0.5 along z and y.
constexpr const char* kTree =
    "# id type x y z radius parent (mm, RAS)\n1 0 0 0 0 3 -1\n2 0 0 0 10 3 1\n3 0 1 0 10 2 2\n4 0 8 0 10 2 3\n5 0 0 1 "
    "10 1 2\n"
    "6 0 0 6 10 1 5\n7 0 8 0 11 0.5 4\n8 0 8 0 15 0.5 7\n9 0 8 1 10 0.5 4\n10 0 8 5 10 0.5 9\n";

tree::VesselTree surgery_tree() {
    auto tree = io::parse_tree(kTree, "tree.swc");
    REQUIRE(tree);
    REQUIRE(tree->branches.size() == 5);
    return std::move(*tree);
}

struct Stage : test::CommandStage {
    Stage() : CommandStage(surgery_tree()) {}
    [[nodiscard]] const Ids& selection() const { return marks().selection; }
};

} // namespace

TEST_CASE("branches are selected by their relation to the selected ones") {
    Stage stage;
    stage.good("select 3\nselect-parent");
    CHECK(stage.selection() == Ids{1});
    stage.good("select-children");
    CHECK(stage.selection() == Ids{3, 4});
    stage.good("select-parent\nselect-siblings");
    CHECK(stage.selection() == Ids{2});
    stage.good("select-same-generation");
    CHECK(stage.selection() == Ids{1, 2});
    stage.good("select 0");
    CHECK(stage.bad("select-parent").find("root") != std::string::npos);
    stage.bad("select-siblings");
    stage.good("select 2");
    stage.bad("select-children");
    stage.good("select-none");
    for (const char* line : {"select-parent", "select-children", "select-siblings", "select-same-generation"})
        CHECK(stage.bad(line).find("selected") != std::string::npos);
}

TEST_CASE("branches are selected by generation, diameter and distance") {
    Stage stage;
    CHECK(stage.good("select-generation 1") == "Selected 2 branches of generation 1");
    CHECK(stage.selection() == Ids{1, 2});
    stage.good("select-generation 1 2");
    CHECK(stage.selection() == Ids{1, 2, 3, 4});
    stage.good("select-generation 7");
    CHECK(stage.selection().empty());
    for (const char* line : {"select-generation", "select-generation 2 1", "select-generation -1",
                             "select-generation 1.5", "select-generation 1 2 3", "select-generation x"})
        stage.bad(line);

    stage.good("select-diameter 0 2");
    CHECK(stage.selection() == Ids{3, 4}); // branch 2 begins in the stem, so its mean is above 2
    stage.good("select-diameter 6 6");
    CHECK(stage.selection() == Ids{0});
    for (const char* line : {"select-diameter", "select-diameter 2", "select-diameter 3 2", "select-diameter -1 2",
                             "select-diameter 0 nan"})
        stage.bad(line);

    stage.bad("select-within 5"); // no lesion yet
    stage.good("select-within 1 8,0,19");
    CHECK(stage.selection().empty());
    stage.good("select-within 3.5 8,0,19"); // 4 mm above the end of 3, whose radius is 0.5
    CHECK(stage.selection() == Ids{3});
    stage.good("lesion 8,12,10,2\nselect-within 5"); // 7 - 2 - 0.5 mm from 4
    CHECK(stage.selection() == Ids{4});
    for (const char* line : {"select-within", "select-within -1", "select-within 1 2,3", "select-within 1 2,3,4,5",
                             "select-within 1 2,3,x"})
        stage.bad(line);
}

TEST_CASE("in a network, only branches that have no other path to the root are dependents") {
    // A stem, two ways round, a tail.
    auto network = io::parse_tree(
        R"({"format": "ramus-tree", "version": 1, "units": "mm", "orientation": "RAS",
            "points": [[0,0,0,1],[5,0,0,1],[8,4,0,1],[8,-4,0,1],[11,0,0,1],[15,0,0,1]],
            "branches": [[0,1],[1,2,4],[1,3,4],[4,5]], "roots": [0]})",
        "ring.json");
    REQUIRE(network);
    test::CommandStage stage(std::move(*network));
    stage.good("select 1\nselect-dependents");
    CHECK(stage.marks().selection == Ids{1});
    stage.good("select-subtree 0");
    CHECK(stage.marks().selection == Ids{0, 1, 2, 3});
    CHECK(stage.document.facts()->branches[1].dependents.branches == 0);
    CHECK(stage.document.facts()->branches[0].dependents.branches == 3);
    CHECK(stage.good("cut 1").find("lost: 0 branches") != std::string::npos);
    stage.good("cut 2");
    CHECK(stage.plan()->cuts.together.branches == 3);
}

TEST_CASE("cuts are placed, reported, listed and undone") {
    Stage stage;
    CHECK(stage.plan()->cuts.cuts.empty());
    const std::string said = stage.good("cut 1 0.25");
    CHECK(said.find("Cut 1: 4.00 mm wide; lost: 3 branches, 16.0 mm") == 0);
    CHECK(said.find("2 leaves") != std::string::npos);
    CHECK(stage.good("cut 0").find("6.00 mm wide, over 5.00 mm") != std::string::npos);
    CHECK(stage.marks().cuts == std::vector<std::pair<int, double>>{{1, 0.25}, {0, 0.5}});
    CHECK(stage.bad("cut 0 0.5").find("already") != std::string::npos);
    const auto plan = stage.plan();
    CHECK(plan->cuts.cuts[1].reconstruct);
    CHECK(plan->cuts.together.length_mm == doctest::Approx(5.0 + 8.0 + 6.0 + 5.0 + 5.0));
    CHECK(stage.plan() == plan); // kept
    stage.good("reconstruct 6");
    CHECK_FALSE(stage.plan()->cuts.cuts[1].reconstruct);
    stage.good("cut-remove 1");
    CHECK(stage.marks().cuts == std::vector<std::pair<int, double>>{{0, 0.5}});
    stage.bad("cut-remove 2");
    stage.good("undo");
    CHECK(stage.marks().cuts.size() == 2);
    CHECK(stage.plan()->cuts.cuts.size() == 2);
    stage.good("cut-clear");
    CHECK(stage.marks().cuts.empty());
    for (const char* line : {"cut", "cut 9", "cut 1 1.5", "cut 1 -0.1", "cut 1 x", "cut 1 0.5 2", "cut-remove 1",
                             "cut-remove", "reconstruct", "reconstruct -1", "reconstruct 1 2"})
        stage.bad(line);
}

TEST_CASE("cut cuts those selected branches on which the others depend") {
    Stage stage;
    stage.good("select-subtree 1\nselect-add 2\ncut");
    CHECK(stage.marks().cuts == std::vector<std::pair<int, double>>{{1, 0.5}, {2, 0.5}});
    CHECK(stage.said == "2 cuts");
    stage.bad("cut"); // there they are
}

TEST_CASE("lesions are placed, changed and removed; margins follow") {
    Stage stage;
    CHECK(stage.plan()->bands.empty());
    stage.good("lesion 8,12,10,2\nlesion 0,0,-20,1");
    REQUIRE(stage.marks().lesions.size() == 2);
    auto plan = stage.plan();
    REQUIRE(plan->bands.size() == 3); // 5, 10, 20
    REQUIRE(plan->bands[0].rows.size() == 1);
    CHECK(plan->bands[0].rows[0].branch == 4);
    CHECK(plan->bands[0].rows[0].distance_mm == doctest::Approx(4.5));
    stage.good("bands 4 30");
    plan = stage.plan();
    REQUIRE(plan->bands.size() == 2);
    CHECK(plan->bands[0].rows.empty());
    CHECK(plan->bands[1].rows.size() == 5);
    CHECK(plan->bands[1].rows[0].branch == 0); // the thickest
    CHECK(plan->bands[1].rows[0].dependents.branches == 4);
    stage.good("lesion-change 1 8,12,10,6");
    CHECK(stage.plan()->lesion_distances_mm[4] == doctest::Approx(0.5));
    stage.good("lesion-remove 1");
    CHECK(spheres_of(stage.marks()) == std::vector<std::array<double, 4>>{{0, 0, -20, 1}});
    stage.good("lesion-clear");
    CHECK(stage.plan()->lesion_distances_mm.empty());
    for (const char* line : {"lesion", "lesion 1,2,3", "lesion 1,2,3,0", "lesion 1,2,3,-4", "lesion 1,2,3,4,5",
                             "lesion 1,2,3,nan", "lesion 1,2,,4", "lesion-remove 1", "lesion-change 1 1,2,3,4", "bands",
                             "bands 5 5", "bands 10 5", "bands 0", "bands -1", "bands x"})
        stage.bad(line);
}

TEST_CASE("a lesion mesh that does not state its axes can be given them later") {
    const TemporaryFolder folder;
    auto ball = test::icosphere(4, {-8, -12, 10}, 2.0);
    ball.radii.resize(ball.positions.size(), 1.0F);
    ball.branches.resize(ball.positions.size(), 0);
    io::MeshNames nothing; // is said of it
    nothing.claims = {tree::SaidBy::kNobody, tree::SaidBy::kNobody};
    const std::string file = (folder.path() / "turned.stl").string();
    REQUIRE(io::write_mesh(ball, file, nothing));
    Stage stage;
    stage.good("lesion-mesh \"" + file + "\"");
    const double before = stage.plan()->lesion_distances_mm[4];
    CHECK(before > 10.0);
    stage.good("lesion-axes 1 LPS");
    CHECK(stage.plan()->lesion_distances_mm[4] == doctest::Approx(4.5).epsilon(0.01));
    stage.good("undo");
    CHECK(stage.plan()->lesion_distances_mm[4] == doctest::Approx(before));
    stage.good("redo\nlesion 0,0,0,1");
    CHECK(stage.bad("lesion-axes 1 LPS").find("sphere") != std::string::npos);
    stage.good("lesion-axes 2 RAS");
    CHECK(stage.bad("lesion-axes 2 ASL").find("LPS or RAS") != std::string::npos);
}

TEST_CASE("a lesion may be a closed mesh") {
    const TemporaryFolder folder;
    auto ball = test::icosphere(4, {8, 12, 10}, 2.0);
    ball.radii.resize(ball.positions.size(), 1.0F);
    ball.branches.resize(ball.positions.size(), 0);
    const std::string file = (folder.path() / "my tumour.stl").string();
    REQUIRE(io::write_mesh(ball, file));
    Stage stage;
    CHECK(stage.good("lesion-mesh \"" + file + "\"").find("5,120 triangles") != std::string::npos);
    CHECK(lesion_files(stage.marks()) == std::vector<std::string>{file});
    CHECK(stage.plan()->lesion_distances_mm[4] == doctest::Approx(4.5).epsilon(0.01));
    stage.good("select-within 5");
    CHECK(stage.selection() == Ids{4});
    CHECK(stage.bad("lesion-mesh \"" + file + "\"").find("already") != std::string::npos);
    CHECK(stage.bad("lesion-mesh missing.stl").find("missing.stl") != std::string::npos);
    std::ofstream(folder.path() / "tree.swc") << kTree;
    CHECK(stage.bad("lesion-mesh \"" + (folder.path() / "tree.swc").string() + "\"").find(".stl") != std::string::npos);
    stage.good("lesion 0,0,0,1\nlesion-remove 2"); // spheres come first
    CHECK(lesion_files(stage.marks()).empty());
    CHECK(stage.marks().lesions.size() == 1);

    // A session whose mesh is gone says so and still has its other lesions.
    stage.good("lesion-mesh \"" + file + "\"");
    Session session = stage.document.session();
    std::filesystem::remove(file);
    test::CommandStage again(surgery_tree(), session);
    const auto plan = again.plan();
    REQUIRE(plan->troubles.size() == 1);
    CHECK(plan->troubles[0].find("my tumour.stl") != std::string::npos);
    CHECK(plan->lesion_distances_mm.size() == 5);
}

TEST_CASE("the diameter filter hides, defocuses or shows thin branches, and reports how many") {
    Stage stage;
    const std::string said = stage.good("filter-diameter 2 hide");
    CHECK(said.find("Hidden: 2 of 5 branches below 2 mm, 40 % of them") == 0);
    CHECK(said.find("29 % of the length") != std::string::npos); // 10 of 34 mm
    CHECK(branches_in_state(stage.marks(), BranchState::kHidden) == Ids{3, 4});
    stage.good("filter-diameter 2 defocus");
    CHECK(branches_in_state(stage.marks(), BranchState::kDefocused) == Ids{3, 4});
    stage.good("filter-diameter 100 show");
    CHECK(stage.marks().states.empty());
    CHECK(stage.good("filter-diameter 0.1 hide").find("Hidden: 0 of 5") == 0);
    for (const char* line : {"filter-diameter", "filter-diameter 2", "filter-diameter 2 away",
                             "filter-diameter -1 hide", "filter-diameter x hide"})
        stage.bad(line);
}

TEST_CASE("measurements are reported, stored once, and removed") {
    Stage stage;
    CHECK(stage.good("measure distance 0,0,0 3,4,0").find("5.00 mm") != std::string::npos);
    // From the middle of 3 to the middle of 2: 2.5 + 8 + 3 mm.
    CHECK(stage.good("measure path 3 2").find("Path, branch 3 at 50.0 % to branch 2 at 50.0 %: 13.5 mm") == 0);
    CHECK(stage.good("measure diameter 0").find("6.00 mm, cross-section 28.3 mm\xC2\xB2") != std::string::npos);
    CHECK(stage.good("measure diameter 1 1").find("4.00 mm") != std::string::npos);
    CHECK(stage.good("measure angle 1").find("Angle, branch 0 to branch 1: 90.0\xC2\xB0, to branch 2 90.0\xC2\xB0") ==
          0);
    REQUIRE(stage.marks().measurements.size() == 5);
    stage.good("measure path 3 2");
    CHECK(stage.marks().measurements.size() == 5);
    CHECK(stage.bad("measure angle 0").find("branches") != std::string::npos);
    stage.good("select 2 3\nmeasure-selected");
    CHECK(stage.marks().measurements.back().places[0].branch == 2);
    CHECK(stage.marks().measurements.back().places[1].branch == 3);
    stage.good("measure-remove 1");
    CHECK(stage.marks().measurements.front().kind == Measurement::Kind::kPath);
    stage.good("measure-clear");
    CHECK(stage.marks().measurements.empty());
    for (const char* line :
         {"measure", "measure path", "measure path 1", "measure path 1 2 3", "measure path 1 99",
          "measure distance 1,2,3", "measure distance 1,2 3,4", "measure diameter 1 2", "measure angle",
          "measure angle 1 2", "measure length 1", "measure-remove 1", "measure path 1 0.5 2",
          "measure path 1 0.5 2 1.5", "measure angle 1 0 1 0 1 0", "measure-change 1 path 1 2", "measure-change"})
        stage.bad(line);
    stage.good("select 2");
    stage.bad("measure-selected");
}

TEST_CASE("a path, an angle and a diameter belong to the exact places, and moving a measurement is one step of undo") {
    Stage stage;
    // Branch 1 runs 8 mm from the trunk's end, branch 2 6 mm at a right angle to it.
    CHECK(stage.good("measure path 1 0.75 2 0.5").find("13.5 mm") == std::string::npos);
    CHECK(stage.good("measure path 1 0.75 2 0.5").find("9.00 mm, straight 6.71 mm") != std::string::npos);
    CHECK(stage.good("measure angle 1 1 1 0 2 1").find(": 90.0\xC2\xB0") != std::string::npos);
    REQUIRE(stage.marks().measurements.size() == 2);
    const auto before = stage.document.step_count();
    CHECK(stage.good("measure-change 1 path 1 0.25 2 0.5").find("5.00 mm") != std::string::npos);
    CHECK(stage.document.step_count() == before + 1);
    CHECK(stage.marks().measurements.size() == 2);
    CHECK(stage.marks().measurements[0].places[0] == measure::BranchPlace{1, 0.25});
    stage.good("undo");
    CHECK(stage.marks().measurements[0].places[0] == measure::BranchPlace{1, 0.75});
}
