// The commands that mend a tree, their undo, and where they are kept.
#include "app/session/session_file.h"
#include "app/session/tree_edits.h"
#include "app/tools/edit_tools.h"
#include "app/workspace/workspace.h"
#include "core/io/trees/tree_file.h"
#include "core/tree/build_tree.h"
#include "tests/support/command_stage.h"
#include "tests/support/settle.h"
#include "tests/support/temporary_folder.h"

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

using namespace ramus;
using namespace ramus::app;
using test::Ids;
using tree::BranchState;

namespace {

// Branch 0: a stem of 40 mm along z, r 3. At its end 1: 40 mm along x, r 2, and 2: 20 mm along -x, r 1. At the end of
// 1, 3 and 4: 10 mm, r 0.5, along z and y. Beside them a piece of its own, branch 5: 20 mm, r 1.
constexpr const char* kEdited =
    "1 0 0 0 0 3 -1\n2 0 0 0 20 3 1\n3 0 0 0 40 3 2\n4 0 20 0 40 2 3\n5 0 40 0 40 2 4\n6 0 -20 0 40 1 3\n"
    "7 0 40 0 50 0.5 5\n8 0 40 10 40 0.5 5\n9 0 -30 0 40 1 -1\n10 0 -50 0 40 1 9\n";

tree::VesselTree edited_tree() {
    auto tree = io::parse_tree(kEdited, "edited.swc");
    REQUIRE(tree);
    REQUIRE(tree->branches.size() == 6);
    return std::move(*tree);
}

struct EditStage : test::CommandStage {
    EditStage() : CommandStage(edited_tree()) {}
    [[nodiscard]] const tree::VesselTree& tree() const { return *document.tree(); }
    // The branch whose centerline passes through a place.
    [[nodiscard]] int at(const glm::dvec3& place) const {
        for (std::size_t id = 0; id < tree().branches.size(); ++id) {
            const auto& points = tree().branches[id].points;
            for (std::size_t i = 1; i < points.size(); ++i) {
                const glm::dvec3 a = tree().points[points[i - 1]].position;
                const glm::dvec3 b = tree().points[points[i]].position;
                if (glm::distance(a, place) + glm::distance(place, b) < glm::distance(a, b) + 1e-9)
                    return static_cast<int>(id);
            }
        }
        return tree::kNoBranch;
    }
};

struct EditHand {
    EditStage stage;
    ToolSettings settings;
    render::Pick under;
    EditHand() {
        Session session;
        session.camera.position = {0, 200, 30};
        session.camera.focal_point = {0, 0, 30};
        session.camera.orthographic = true;
        session.camera.scale = 60.0;
        stage.document.open(stage.document.tree(), session);
    }
    const render::Pick& point_at(int branch, const glm::dvec3& place) {
        under.branch = branch;
        under.position = place;
        return under;
    }
    [[nodiscard]] Pointing over(int branch, const glm::dvec3& place) {
        point_at(branch, place);
        return {.at = {400, 300},
                .modifiers = {},
                .size = {800, 600},
                .document = stage.document,
                .settings = settings,
                .under = under};
    }
};

} // namespace

TEST_CASE("every edit of the tree is one step of undo, and undo restores exactly the same tree") {
    for (const char* line :
         {"disconnect 1", "disconnect 1 0.25 4", "join 5 start 2 end", "delete-spur 2", "delete-spur 1 3 4",
          "move-root 3", "flip 5", "set-radius 1.5 1 2", "scale-radius 0.5 0"}) {
        CAPTURE(line);
        EditStage stage;
        stage.good("select 1 3\nhide\nname 3 \"segment 6\"\nselect 4");
        const Marks marks = stage.marks();
        const auto before = stage.document.tree();
        CHECK_FALSE(stage.good(line).empty());
        const auto after = stage.document.tree();
        const Marks edited = stage.marks();
        CHECK(*after != *before);
        CHECK(stage.marks().edits.size() == 1);
        CHECK(stage.document.facts()->branches.size() == after->branches.size());
        CHECK(stage.document.base_tree() == before);
        stage.good("undo");
        CHECK(stage.marks() == marks);
        CHECK(stage.document.tree() == before);
        CHECK(stage.document.facts()->branches.size() == before->branches.size());
        stage.good("redo");
        CHECK(stage.marks() == edited);
        CHECK(*stage.document.tree() == *after);
    }
}

TEST_CASE("edits report what they changed, and refuse invalid arguments") {
    EditStage stage;
    CHECK(stage.good("disconnect 1").find("3 pieces now") != std::string::npos);
    CHECK(stage.last_step() == "disconnect 1");
    stage.good("undo");
    CHECK(stage.good("join 3 end 4 end").find("1 loop now") != std::string::npos);
    stage.good("undo\nselect 2 5");
    CHECK(stage.good("join").find("1 piece now") != std::string::npos);
    CHECK(stage.at({-25, 0, 40}) == stage.at({-10, 0, 40})); // one vessel
    stage.good("undo");
    CHECK(stage.bad("delete-spur 1").find("carries others") != std::string::npos);
    CHECK(stage.bad("join 0 end 2 end").find("free end") != std::string::npos);
    CHECK(stage.bad("move-root 1").find("free end") != std::string::npos);
    stage.good("select-none");
    for (const char* line :
         {"disconnect", "disconnect 9", "disconnect 1 2", "disconnect 1 0.5 0", "join", "join 1 0.5 2 end",
          "join 1 end", "delete-spur", "delete-spur x", "move-root 2 middle", "flip", "flip 1 2", "set-radius",
          "set-radius 0 1", "set-radius 1", "scale-radius -1 1", "scale-radius 1e6 0"})
        stage.bad(line);
}

TEST_CASE("marks stay on their vessels when the tree is edited") {
    EditStage stage;
    stage.good("select 3\nhide\nselect 1\nhighlight\nname 1 trunk\ncut 4 0.5\ncut 1 0.5\nmeasure diameter 1 0.9\n"
               "measure path 0 3\nselect 4");
    stage.good("disconnect 1 0.5 10");
    const int near = stage.at({10, 0, 40});
    const int far = stage.at({30, 0, 40});
    CHECK(near != far);
    CHECK(stage.in(BranchState::kHidden) == Ids{stage.at({40, 0, 45})});
    CHECK(stage.in(BranchState::kHighlighted) == Ids{std::min(near, far), std::max(near, far)});
    CHECK(stage.selection() == Ids{stage.at({40, 5, 40})});
    CHECK(stage.marks().names.size() == 1);
    CHECK(stage.marks().names.begin()->first == near);
    // The cut in the middle of 1 went with what it was on.
    REQUIRE(stage.marks().cuts.size() == 1);
    CHECK(stage.marks().cuts[0].first == stage.at({40, 5, 40}));
    REQUIRE(stage.marks().measurements.size() == 2);
    CHECK(stage.marks().measurements[0].places[0].branch == far);
    CHECK(stage.marks().measurements[0].places[0].fraction == doctest::Approx(11.0 / 15.0));
    // A spur goes, and what is left is as its longer part was.
    stage.good("select " + std::to_string(stage.at({-10, 0, 40})) + "\ndelete-spur");
    CHECK(stage.selection().empty());
    CHECK(stage.at({0, 0, 10}) == stage.at({10, 0, 40}));
    CHECK(state_of(stage.marks(), stage.at({0, 0, 10})) == BranchState::kNormal);
    CHECK(stage.marks().names.begin()->first == stage.at({0, 0, 10}));
}

TEST_CASE("many edits can be taken back, one by one and all at once") {
    EditStage stage;
    std::vector<std::shared_ptr<const tree::VesselTree>> trees{stage.document.tree()};
    for (int i = 0; i < 45; ++i) {
        stage.good("scale-radius 1.01 " + std::to_string(i % 6));
        trees.push_back(stage.document.tree());
    }
    for (std::size_t i = trees.size() - 1; i-- > 0;) {
        stage.good("undo");
        REQUIRE(*stage.document.tree() == *trees[i]);
    }
    stage.good("redo 45");
    CHECK(*stage.document.tree() == *trees.back());
    stage.good("undo 20\nflip 5");
    CHECK(stage.marks().edits.size() == 26);
    stage.good("undo");
    CHECK(*stage.document.tree() == *trees[25]);
}

TEST_CASE("a session with edits opens as it was saved") {
    const TemporaryFolder folder;
    const auto file = folder.write("vessels.swc", kEdited);
    EditStage stage;
    stage.good("join 5 start 2 end\ndisconnect 1 0.25 4\nset-radius 1.5 0");
    Session session;
    session.tree.path = file;
    session.tree.checksum = checksum_of(file).value();
    session.marks = stage.marks();
    const auto saved = folder.path() / "vessels.ramus.json";
    REQUIRE(write_session(session, saved));
    const auto read = read_session(saved);
    REQUIRE(read);
    CHECK(read->session.marks.edits == session.marks.edits);

    Workspace workspace([] {});
    workspace.open(saved);
    REQUIRE(test::settle(workspace, [&] { return workspace.surface_ready() && !workspace.busy(); }));
    REQUIRE(workspace.document().tree());
    CHECK(*workspace.document().tree() == [&] {
        tree::VesselTree tree = stage.tree();
        tree.source = workspace.document().tree()->source;
        return tree;
    }());
    CHECK(workspace.document().base_tree()->branches.size() == 6);
    CHECK_FALSE(workspace.document().modified());
    CHECK_FALSE(workspace.document().undo());

    // Of another file the edits are not made.
    folder.write("vessels.swc", std::string(kEdited) + "11 0 -60 0 40 1 10\n");
    Job job;
    const auto other = load(saved, {}, {}, job);
    REQUIRE_FALSE(other);
    CHECK(other.error().what.find("has changed") != std::string::npos);
}

TEST_CASE("reading a session reports what is wrong with its edits") {
    Session session;
    session.tree.path = "/tmp/x.swc";
    session.marks.edits = {{tree::Edit::Kind::kCut, {1}, {0.5, 0.0}, 3.0}};
    const auto good = to_json(session, "/tmp");
    REQUIRE(session_from_json(good, "/tmp", "x"));
    const auto refused = [&](const char* key, const nlohmann::json& value) {
        auto wrong = good;
        wrong["edits"][0][key] = value;
        const auto read = session_from_json(wrong, "/tmp", "x.ramus.json");
        REQUIRE_FALSE(read);
        CHECK(read.error().where == "x.ramus.json");
    };
    refused("edit", "explode");
    refused("edit", 3);
    refused("branches", {-1});
    refused("branches", "1");
    refused("at", {0.5, 0.5});
    refused("at", {1.5});
    refused("value", -1.0);
    refused("colour", "red");
    auto other = good;
    other["edits"] = 7;
    CHECK_FALSE(session_from_json(other, "/tmp", "x"));
}

TEST_CASE("the surface is computed again after an edit, and after its undo") {
    const TemporaryFolder folder;
    Workspace workspace([] {});
    workspace.open(folder.write("vessels.swc", kEdited));
    REQUIRE(test::settle(workspace, [&] { return workspace.surface_ready() && !workspace.busy(); }));
    const auto triangles = [&] { return workspace.shown().mesh->triangle_count(); };
    REQUIRE(workspace.surface_ready());
    const auto before = triangles();
    REQUIRE(workspace.document().edit_tree({tree::Edit::Kind::kDelete, {1, 3, 4}, {}, 0.0}));
    CHECK_FALSE(workspace.surface_ready());
    CHECK(workspace.follow_tree());
    workspace.await_tree(); // something of the new tree, before its surface
    REQUIRE(workspace.shown().mesh);
    CHECK(workspace.current_assets().tree == workspace.document().tree());
    REQUIRE(test::settle(workspace, [&] { return workspace.surface_ready() && !workspace.busy(); }));
    CHECK(workspace.surface_ready());
    CHECK(triangles() < before);
    REQUIRE(workspace.document().undo());
    REQUIRE(test::settle(workspace, [&] { return workspace.surface_ready() && !workspace.busy(); }));
    CHECK(workspace.surface_ready());
    CHECK(triangles() == before);
}

TEST_CASE("the tools for edits show what a click will do, or why it cannot be done there") {
    EditHand hand;
    DisconnectTool disconnect;
    Pointing pointing = hand.over(1, {20, 2, 40});
    disconnect.move(pointing);
    const ToolDrawing shown = disconnect.drawing(pointing);
    REQUIRE(shown.lines.size() == 2); // with its rim; 4 mm, its diameter: 20 pixels
    CHECK(glm::distance(shown.lines[0].points.front(), shown.lines[0].points.back()) == doctest::Approx(20.0));
    disconnect.press(pointing);
    CHECK(disconnect.take_commands() == std::vector<CommandLine>{{"disconnect", "1", "0.500"}});

    JoinTool join;
    pointing.under = hand.point_at(5, {-31, 1, 40});
    join.move(pointing);
    CHECK(join.drawing(pointing).circles.size() == 2);
    join.press(pointing);
    CHECK(join.take_commands().empty());
    CHECK(join.busy());
    pointing.under = hand.point_at(2, {-19, 1, 40});
    join.move(pointing);
    const ToolDrawing link = join.drawing(pointing);
    REQUIRE(link.lines.size() == 1); // 10 mm
    CHECK(glm::distance(link.lines[0].points.front(), link.lines[0].points.back()) == doctest::Approx(50.0));
    join.press(pointing);
    CHECK(join.take_commands() == std::vector<CommandLine>{{"join", "5", "start", "2", "end"}});
    CHECK_FALSE(join.busy());
    pointing.under = hand.point_at(1, {20, 2, 40});
    join.move(pointing);
    REQUIRE(join.drawing(pointing).texts.size() == 1);
    CHECK(join.drawing(pointing).texts[0].text == "no free end");
    join.press(pointing);
    const auto wrong = join.take_commands();
    REQUIRE(wrong.size() == 1);
    CHECK_FALSE(join.busy());
    CHECK(hand.stage.bad("join 1 end 1 end").find("no free end") != std::string::npos);

    SpurTool spur;
    pointing.under = hand.point_at(2, {-10, 1, 40});
    spur.move(pointing);
    CHECK(spur.drawing(pointing).lines.size() == 2);
    spur.press(pointing);
    CHECK(spur.take_commands() == std::vector<CommandLine>{{"delete-spur", "2"}});
    RootTool root;
    pointing.under = hand.point_at(2, {-10, 1, 40});
    root.move(pointing);
    CHECK(root.drawing(pointing).circles.size() == 2);
    root.press(pointing);
    CHECK(root.take_commands() == std::vector<CommandLine>{{"move-root", "2", "end"}});
    // What was under the pointer in another tree is not under it in this one.
    hand.stage.good("delete-spur 2");
    CHECK(root.drawing(pointing).circles.empty());
}
