#include "app/actions/keys.h"
#include "app/picture/compose.h"
#include "tests/support/command_stage.h"

#include <doctest/doctest.h>
#include <map>
#include <set>

using namespace ramus;
using namespace ramus::app;
using test::Ids;
using tree::BranchState;

namespace {

// 0 -> 1, 2;  2 -> 3, 4;  4 -> 5
std::shared_ptr<const tree::VesselTree> small_tree() {
    auto tree = std::make_shared<tree::VesselTree>();
    const std::vector<std::pair<int, std::vector<int>>> links{{-1, {1, 2}}, {0, {}},  {0, {3, 4}},
                                                              {2, {}},      {2, {5}}, {4, {}}};
    for (std::size_t i = 0; i < links.size(); ++i) {
        tree::Branch branch;
        branch.parent = links[i].first;
        branch.children = links[i].second;
        branch.generation =
            branch.parent < 0 ? 0 : tree->branches[static_cast<std::size_t>(branch.parent)].generation + 1;
        branch.points = {static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(i + 1)};
        tree->branches.push_back(branch);
    }
    for (int i = 0; i < 7; ++i) tree->points.push_back({{i, 0.0, 0.0}, 1.0 + i});
    return tree;
}

struct CommandStage : test::CommandStage {
    CommandStage() : test::CommandStage(small_tree()) {}
};

} // namespace

TEST_CASE("no two commands share a key, and every key has one spelling") {
    std::map<std::string, std::string> owners;
    for (const Command& command : command_table())
        for (const std::string& key : command.keys) {
            CHECK_MESSAGE(owners.emplace(key, command.label).second, key << " is taken by " << owners[key]);
            CHECK(bool(command_for_key(key) == &command));
        }
    CHECK(spelling({"Z", true, true, false}) == "Ctrl+Shift+Z");
    CHECK(spelling({"+", true, false, false}) == "Ctrl++");
}

TEST_CASE("the table is complete: every entry has a name, a sentence of help, an action and a way to reach it") {
    std::set<std::string> scripted;
    for (const Command& command : command_table()) {
        CAPTURE(command.name);
        CHECK(bool(command.action));
        CHECK(command.help.ends_with("."));
        CHECK(command.menu.empty() == command.label.empty());
        REQUIRE(bool(find_command(command.name)));
        if (command.scripted()) CHECK(scripted.insert(command.name).second);
    }
    for (const char* name : {"select", "select-add", "select-none", "select-dependents", "select-upstream",
                             "select-invert", "highlight", "defocus", "defocus-others", "hide", "show", "show-all",
                             "view", "undo", "redo", "save", "shot", "colour-by", "name"})
        CHECK_MESSAGE(scripted.contains(name), name);
}

TEST_CASE("selection commands do what they say") {
    CommandStage stage;
    stage.good("select 4 2 4");
    CHECK(stage.selection() == Ids{2, 4});
    stage.good("select-add 0");
    CHECK(stage.selection() == Ids{0, 2, 4});
    stage.good("select 2\nselect-dependents");
    CHECK(stage.selection() == Ids{2, 3, 4, 5});
    stage.good("select 5 3\nselect-upstream");
    CHECK(stage.selection() == Ids{0, 2, 3, 4, 5});
    stage.good("select-invert");
    CHECK(stage.selection() == Ids{1});
    stage.good("select-none");
    CHECK(stage.selection().empty());
}

TEST_CASE("states apply to the selection and can be undone") {
    CommandStage stage;
    stage.good("select 2\nselect-dependents\nhighlight\nselect 3\nhide\nselect 1\ndefocus");
    CHECK(stage.in(BranchState::kHighlighted) == Ids{2, 4, 5});
    CHECK(stage.in(BranchState::kHidden) == Ids{3});
    CHECK(stage.in(BranchState::kDefocused) == Ids{1});
    stage.good("select 3\nshow");
    CHECK(stage.in(BranchState::kHidden).empty());
    stage.good("undo");
    CHECK(stage.in(BranchState::kHidden) == Ids{3});
    stage.good("redo\nshow-all");
    CHECK(stage.document.marks().states.empty());
    stage.good("select 0\ndefocus-others");
    CHECK(stage.in(BranchState::kDefocused) == Ids{1, 2, 3, 4, 5});
}

TEST_CASE("views, projection and pictures go through the host") {
    CommandStage stage;
    stage.good("view left\northographic on\nshot \"my picture.png\"");
    CHECK(stage.host.leaps == 2);
    CHECK(stage.document.session().camera.orthographic);
    CHECK(render::axes_of(stage.document.session().camera).forward.x ==
          doctest::Approx(1.0)); // RAS: left is -x, the viewer looks to the right
    CHECK(stage.host.pictures == std::vector<std::filesystem::path>{"my picture.png"});
}

TEST_CASE("options and colours are steps of undo") {
    CommandStage stage;
    stage.good(
        "surface detail 24\nsurface width 1\nsurface method cones\ncolour-by generation\nname 3 \"to segment VII\"");
    CHECK(stage.document.marks().options.detail == 24);
    CHECK(stage.document.marks().options.method == mesh::Method::kTruncatedCones);
    CHECK(stage.document.marks().names.at(3) == "to segment VII");
    stage.good("undo\nundo\nundo\nundo\nundo");
    CHECK(stage.document.marks() == Marks{});
}

TEST_CASE("an error names the file and the line of the command, which changes nothing") {
    CommandStage stage;
    stage.good("select 1");
    const Session before = stage.document.session();
    CHECK(stage.bad("# comment\n\nselect 2 6\n").starts_with("c.txt:3: there is no branch 6; ids go from 0 to 5"));
    CHECK(stage.bad("select two").starts_with("c.txt:1: \"two\" is not a branch id"));
    CHECK(stage.bad("select").starts_with("c.txt:1: which branches?"));
    CHECK(stage.bad("view top").starts_with("c.txt:1: view takes the name of a view"));
    CHECK(stage.bad("explode").starts_with("c.txt:1: there is no command \"explode\""));
    CHECK(stage.bad("slect 2") == "c.txt:1: there is no command \"slect\"; did you mean select?");
    CHECK(stage.bad("select-none 3").starts_with("c.txt:1: select-none takes no arguments"));
    CHECK(stage.bad("redo").starts_with("c.txt:1: there is nothing to redo"));
    CHECK(stage.bad("shot \"a.png").starts_with("c.txt:1: a double quote is not closed"));
    CHECK(stage.bad("surface detail 2").starts_with("c.txt:1: surface takes a name and a value"));
    CHECK(stage.bad("surface detail 16.5").starts_with("c.txt:1: surface takes a name and a value"));
    CHECK(stage.bad("colour-by mood").starts_with("c.txt:1: there is no colouring \"mood\""));
    CHECK(stage.bad("help").starts_with("c.txt:1: there is no help without a window"));
    CHECK(stage.bad("save /nowhere/s.json").starts_with("c.txt:1: /nowhere/s.json: "));
    CHECK(stage.document.session() == before);
    CHECK(stage.bad("select-none\nhighlight").starts_with("c.txt:2: nothing is selected"));
}

TEST_CASE("a file of commands may have comments, quotes and empty lines") {
    const auto lines =
        parse_script("\xEF\xBB\xBFselect 1\t2 # both\r\n\r\n  name 1 \"a \\\"b\\\" c\"\nshot x#1.png", "c.txt");
    REQUIRE(lines);
    CHECK(*lines == std::vector<ScriptLine>{
                        {1, {"select", "1", "2"}}, {3, {"name", "1", "a \"b\" c"}}, {4, {"shot", "x#1.png"}}});
    CHECK(read_script("/nowhere/c.txt").error().where == "/nowhere/c.txt");
}

TEST_CASE("only surfaces of the Gaussian kernel are drawn from centerlines; those of other kernels need the mesh") {
    CommandStage stage;
    refresh(stage.assets, stage.document);
    const auto frame = [&] { return compose(stage.document.session(), stage.assets, nullptr, {}); };
    CHECK_FALSE(frame().only_mesh);
    CHECK(frame().width == 5.0F);
    stage.good("surface kernel cauchy");
    CHECK(frame().only_mesh);
    CHECK(frame().width == 0.0F);
    stage.good("surface method cones"); // have no kernel
    CHECK_FALSE(frame().only_mesh);
    CHECK(frame().width == 0.0F);
    stage.good("surface method cs\nsurface kernel gaussian");
    CHECK(frame().width == 5.0F);
}

TEST_CASE("compose carries the session into the frame") {
    CommandStage stage;
    stage.good("select 3\nhide\nselect 1\ncolour-by generation");
    const auto mesh = std::make_shared<const render::PagedMesh>();
    refresh(stage.assets, stage.document);
    const render::Frame frame = compose(stage.document.session(), stage.assets, mesh, {.size = {40, 30}, .hovered = 2});
    CHECK(frame.mesh == mesh);
    CHECK(frame.selected == Ids{1});
    CHECK(frame.hovered == 2);
    CHECK(frame.size == glm::ivec2(40, 30));
    CHECK(frame.states.at(3) == BranchState::kHidden);
    REQUIRE(frame.colours.size() == 6);
    CHECK(frame.colours[1] == frame.colours[2]);
    CHECK(frame.colours[0] != frame.colours[1]);
}
