// Vessel systems in a session: commands, colours, filter, tables and files speak of them by name.
#include "app/assets/centerlines.h"
#include "app/picture/colouring.h"
#include "app/reports/report_tables.h"
#include "app/session/branch_filter.h"
#include "app/session/session_file.h"
#include "app/session/systems.h"
#include "app/workspace/surface_maker.h"
#include "core/mesh/connectivity.h"
#include "core/mesh/surface.h"
#include "tests/support/command_stage.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/two_systems.h"

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

using namespace ramus;
using namespace ramus::app;
using test::Ids;
using tree::BranchState;

namespace {

struct SystemsStage : test::CommandStage {
    SystemsStage() : test::CommandStage(test::two_systems()) {}
    [[nodiscard]] Colouring colouring() const {
        return colouring_of(*document.tree(), *document.facts(), document.marks(), nullptr);
    }
    [[nodiscard]] Ids passing(std::string_view filter) const {
        const auto parsed = parse_branch_filter(filter);
        REQUIRE_MESSAGE(parsed, (parsed ? "" : parsed.error().message()));
        return branches_passing(*parsed, *document.tree(), *document.facts(), document.marks());
    }
};

} // namespace

TEST_CASE("a system is selected, hidden and shown by its name or number") {
    SystemsStage stage;
    stage.good("select-system \"Hepatic Vein\"");
    CHECK(stage.selection() == Ids{3});
    stage.good("select-system 1 2");
    CHECK(stage.selection() == Ids{0, 1, 2, 3});
    stage.good("select 1\nhighlight\nhide-system \"portal vein\"");
    CHECK(stage.in(BranchState::kHidden) == Ids{0, 1, 2});
    stage.good("show-system 1");
    CHECK(stage.in(BranchState::kHidden).empty());
    CHECK(stage.bad("select-system artery").find("portal vein") != std::string::npos);
    CHECK_FALSE(stage.bad("hide-system").empty());
    CHECK_FALSE(stage.bad("select-system 3").empty());
}

TEST_CASE("showing a system does not change branches that were not hidden") {
    SystemsStage stage;
    stage.good("select 1\nhighlight\nselect 2\nhide\nshow-system 1");
    CHECK(stage.in(BranchState::kHighlighted) == Ids{1});
    CHECK(stage.in(BranchState::kHidden).empty());
}

TEST_CASE("names and colours of systems are steps of undo, unless they equal those of the tree") {
    SystemsStage stage;
    stage.good("name-system 2 \"vena cava\"\ncolour-system \"vena cava\" 102030");
    const Systems& now = systems_of(*stage.document.tree(), stage.marks());
    CHECK(now[1] == tree::System{"vena cava", {16, 32, 48}});
    CHECK(now[0] == stage.document.tree()->systems[0]);
    CHECK(with_systems(*stage.document.tree(), stage.marks()).systems == now);
    REQUIRE(stage.document.undo());
    CHECK(systems_of(*stage.document.tree(), stage.marks())[1].colour == stage.document.tree()->systems[1].colour);
    REQUIRE(stage.document.undo());
    CHECK(stage.marks() == Marks{});
    REQUIRE(stage.document.redo());
    stage.good("name-system 2 \"hepatic vein\"");
    CHECK(stage.marks().systems.empty());
    CHECK_FALSE(stage.bad("name-system 2 \"portal vein\"").empty()); // taken
    CHECK_FALSE(stage.bad("name-system 2 \"\"").empty());
    CHECK_FALSE(stage.bad("colour-system 2 blue").empty());
}

TEST_CASE("a tree without systems says so") {
    tree::VesselTree plain = test::two_systems();
    plain.systems.clear();
    test::CommandStage stage(plain);
    CHECK(stage.bad("select-system 1").find("no systems") != std::string::npos);
    CHECK(first_colouring(ColourBy::kNothing, plain) == ColourBy::kNothing);
    CHECK(first_colouring(ColourBy::kNothing, test::two_systems()) == ColourBy::kSystem);
}

TEST_CASE("every branch has the colour of its system, and the legend has their names") {
    SystemsStage stage;
    stage.good("colour-by system\nname-system 1 Pfortader");
    const Colouring colouring = stage.colouring();
    REQUIRE(colouring.branches.size() == 4);
    CHECK(colouring.branches[2] == glm::vec3(60, 110, 180) / 255.0F);
    CHECK(colouring.branches[3] == glm::vec3(200, 80, 60) / 255.0F);
    REQUIRE(colouring.legend.swatches.size() == 2);
    CHECK(colouring.legend.swatches[0].text == "Pfortader");
    CHECK(colouring.legend.swatches[1].text == "hepatic vein");
}

TEST_CASE("the filter finds branches by the name of their system") {
    SystemsStage stage;
    CHECK(stage.passing("system:portal") == Ids{0, 1, 2});
    CHECK(stage.passing("system:\"hepatic vein\"") == Ids{3});
    CHECK(stage.passing("hepatic") == Ids{3});
    CHECK(stage.passing("vein gen=1") == Ids{1, 2});
    CHECK_FALSE(parse_branch_filter("system:").has_value());
}

TEST_CASE("tables have a column of systems, and one of their own") {
    SystemsStage stage;
    stage.good("select 1 3\nhide-system 2\nname-system 2 cava");
    const Table selection = selection_table(stage.document, stage.current_assets());
    CHECK(selection.columns[2].name == "system");
    REQUIRE(selection.rows.size() == 2);
    CHECK(selection.rows[0][2].text == "portal vein");
    CHECK(selection.rows[1][2].text == "cava");
    for (const auto& row : selection.rows) CHECK(row.size() == selection.columns.size());
    stage.good("cut 1");
    const Table cuts = cuts_table(stage.document, stage.current_assets());
    for (const auto& row : cuts.rows) CHECK(row.size() == cuts.columns.size());
    CHECK(cuts.rows[0][3].text == "portal vein");
    const std::string systems = csv_of(systems_table(stage.document, stage.assets));
    CHECK(systems.find("portal vein,#3c6eb4,3,3,") != std::string::npos);
    CHECK(systems.find("cava,#c8503c,1,0,30,") != std::string::npos); // 30 mm from x = -10 to 20
}

TEST_CASE("a session stores names, colours and hidden systems, and refuses those of another tree") {
    SystemsStage stage;
    stage.good("hide-system 2\nname-system 1 \"V. portae\"\ncolour-system 1 010203\ncolour-by system");
    const auto json = to_json(stage.document.session(), "/data");
    const auto back = session_from_json(json, "/data", "s");
    REQUIRE_MESSAGE(back, (back ? "" : back.error().message()));
    CHECK(back->session.marks == stage.marks());
    CHECK(check_against(back->session, *stage.document.tree(), "", "s"));
    tree::VesselTree other = *stage.document.tree();
    other.systems.pop_back();
    const auto refused = check_against(back->session, other, "", "s");
    REQUIRE_FALSE(refused);
    CHECK(refused.error().what == "the session names 2 systems of a tree of 1");
    auto bad = json;
    bad["systems"][0]["colour"] = "blue";
    CHECK_FALSE(session_from_json(bad, "/data", "s").has_value());
}

TEST_CASE("the dependents of a branch belong to its system") {
    const tree::VesselTree tree = test::two_systems();
    const TreeFacts facts = facts_of(tree);
    for (int id = 0; id < 4; ++id)
        for (const int dependent : facts.dependency.dependents(id))
            CHECK(tree.branches[static_cast<std::size_t>(dependent)].system ==
                  tree.branches[static_cast<std::size_t>(id)].system);
}

TEST_CASE("the window's surface keeps systems apart while they are hidden and shown") {
    const auto tree = std::make_shared<const tree::VesselTree>(test::two_systems());
    SurfaceMaker maker(tree);
    Job job;
    const auto triangles = [&](const Ids& hidden) {
        SurfaceRequest request{{}, hidden};
        auto ready = maker.next(request, job);
        while (ready && ready->provisional) ready = maker.next(request, job);
        REQUIRE_MESSAGE(ready, (ready ? "" : ready.error().message()));
        const auto made = mesh::make_surface(*tree, {}, job, hidden_flags(hidden, 4));
        const std::size_t expected = hidden.size() == 4 ? 0 : made->mesh.triangles.size();
        return std::pair(ready->mesh->triangle_count(), expected);
    };
    for (const Ids& hidden : {Ids{}, Ids{3}, Ids{}, Ids{0, 1, 2}, Ids{1}, Ids{0, 1, 2, 3}, Ids{}}) {
        const auto [shown, expected] = triangles(hidden);
        CHECK(shown >= expected); // with the gaps of what was exchanged
        if (hidden.empty() || hidden == Ids{3}) CHECK(shown < 2 * expected);
    }
}
