// Whatever is done can be undone: commands at random, in the hands of one who also makes mistakes.
#include "core/tree/build_tree.h"
#include "tests/support/command_stage.h"

#include <doctest/doctest.h>
#include <random>

using namespace ramus;
using namespace ramus::app;

namespace {

// 60 branches or so, with loops.
tree::VesselTree network(std::mt19937& random) {
    tree::Graph graph;
    std::uniform_real_distribution<double> place(0.0, 60.0), radius(0.3, 5.0);
    for (std::uint32_t i = 0; i < 60; ++i) {
        graph.points.push_back({{place(random), place(random), place(random)}, radius(random)});
        if (i > 0) graph.edges.emplace_back(random() % i, i);
    }
    for (int i = 0; i < 4; ++i) {
        const std::uint32_t a = random() % 60, b = random() % 60;
        if (a != b) graph.edges.emplace_back(a, b);
    }
    graph.roots = {0};
    auto tree = tree::build_tree(std::move(graph), tree::Repair::kAll, [](std::uint32_t) { return std::string(); });
    REQUIRE(tree);
    return std::move(*tree);
}

std::string random_command(std::mt19937& random, int branches) {
    const auto number = [&](int most) { return std::to_string(random() % static_cast<unsigned>(most + 1)); };
    const auto id = [&] { return number(branches - 1); };
    const auto share = [&] { return "0." + number(9); };
    const auto triple = [&] { return number(60) + "," + number(60) + "," + number(60); };
    const std::vector<std::string> commands{"select " + id() + " " + id(),
                                            "select-add " + id(),
                                            "select-toggle " + id(),
                                            "select-subtree " + id(),
                                            "select-dependents",
                                            "select-upstream",
                                            "select-invert",
                                            "select-none",
                                            "select-parent",
                                            "select-children",
                                            "select-siblings",
                                            "select-same-generation",
                                            "select-generation " + number(5) + " " + number(9),
                                            "select-diameter " + number(4) + " " + number(9),
                                            "select-within " + number(20),
                                            "select-within " + number(20) + " " + triple(),
                                            "highlight",
                                            "defocus",
                                            "defocus-others",
                                            "hide",
                                            "show",
                                            "show-all",
                                            "name " + id() + " \"vessel " + number(99) + "\"",
                                            "name " + id() + " \"\"",
                                            "lesion " + triple() + "," + number(9),
                                            "lesion-change " + number(3) + " " + triple() + ",2",
                                            "lesion-remove " + number(3),
                                            "lesion-clear",
                                            "pin " + triple() + " text",
                                            "view-save view" + number(3),
                                            "view-go view" + number(3),
                                            "view-rename view" + number(3) + " view" + number(3),
                                            "view-delete view" + number(3),
                                            "pin-move " + number(3) + " " + triple(),
                                            "object-hide pin " + number(3),
                                            "crosshair " + triple(),
                                            "crosshair " + id() + "@" + share(),
                                            "layout slices",
                                            "layout picture",
                                            "slice axial " + number(60),
                                            "slice-step coronal " + number(9),
                                            "slice-across " + id() + "@" + share(),
                                            "along " + id(),
                                            "along root.." + id(),
                                            "along " + id() + "@" + share() + ".." + id() + "@" + share(),
                                            "along-at " + number(60),
                                            "along-step " + number(9),
                                            "along-show stretched --degrees " + number(90),
                                            "stenosis " + number(9) + " " + number(9),
                                            "along off",
                                            "slice-plane oblique",
                                            "cut-away axial",
                                            "cut-away off",
                                            "slab " + number(20) + " mean",
                                            "slice-zoom sagittal 2 " + number(9) + "," + number(9),
                                            "slice-show axes",
                                            "object-show lesion " + number(3),
                                            "object-name measurement " + number(3) + " name",
                                            "object-remove pin " + number(3),
                                            "lesion-contact 0." + number(9),
                                            "shortest-distances",
                                            "lesion-vessel " + number(3),
                                            "measure distance lesion:" + number(3) + " branch:" + id(),
                                            "measure distance lesion:" + number(3) + "@" + triple() + " " + triple(),
                                            "cut " + id(),
                                            "cut " + id() + " " + share(),
                                            "cut",
                                            "cut-remove " + number(4),
                                            "cut-clear",
                                            "bands " + number(5) + " " + number(20),
                                            "reconstruct " + number(9),
                                            "filter-diameter " + number(6) + " hide",
                                            "filter-diameter " + number(6) + " defocus",
                                            "filter-diameter " + number(6) + " show",
                                            "measure path " + id() + " " + id(),
                                            "measure diameter " + id() + " " + share(),
                                            "measure angle " + id(),
                                            "measure distance " + triple() + " " + triple(),
                                            "measure-remove " + number(3),
                                            "measure-clear",
                                            "disconnect " + id() + " " + share(),
                                            "join " + id() + " start " + id() + " end",
                                            "join " + id() + " end " + id() + " " + share(),
                                            "delete-spur " + id(),
                                            "move-root " + id() + " start",
                                            "flip " + id(),
                                            "set-radius " + number(4) + " " + id(),
                                            "scale-radius 0." + number(9),
                                            "compare blend cs,iso",
                                            "compare side-by-side",
                                            "compare off",
                                            "compare-blend " + share(),
                                            "compare wipe tree,paper",
                                            "compare-wipe " + share(),
                                            "skeleton",
                                            "contact " + number(3),
                                            "contact-marks",
                                            "surface detail " + number(40),
                                            "surface width " + number(9),
                                            "surface blend tree",
                                            "blend",
                                            "blend paper",
                                            "colour-by generation",
                                            "colour-by deviation",
                                            "deviation-from cones",
                                            "deviation-from iso",
                                            "deviation-scale 0." + number(9),
                                            "deviation-scale auto voxels",
                                            "colour-by nothing"};
    return commands[random() % commands.size()];
}

} // namespace

TEST_CASE("any sequence of commands undone to the start equals the start, redone to the end the end" *
          doctest::test_suite("slow")) {
    std::mt19937 random(31);
    int done = 0, refused = 0;
    for (int round = 0; round < 25; ++round) {
        test::CommandStage stage(network(random));
        const Marks start = stage.marks();
        std::vector<Marks> states{start};
        for (int i = 0; i < 150; ++i) {
            const std::string command = random_command(random, stage.document.branch_count());
            const Marks before = stage.marks();
            const auto result = stage.run(command);
            ++(result ? done : refused);
            if (!result) {
                CAPTURE(command);
                CHECK(stage.marks() == before); // a command that fails changes nothing
            }
            if (stage.marks() != before) states.push_back(stage.marks());
        }
        const Marks end = stage.marks();
        const auto end_plan = *stage.plan();
        for (std::size_t i = states.size(); i-- > 1;) {
            REQUIRE(stage.marks() == states[i]); // one step a command, none lost
            REQUIRE(stage.document.undo());
        }
        CHECK(stage.marks() == start);
        CHECK_FALSE(stage.document.undo());
        while (stage.document.redo()) {
        }
        CHECK(stage.marks() == end);
        CHECK(stage.plan()->cuts.together == end_plan.cuts.together);
        CHECK(stage.plan()->lesion_distances_mm == end_plan.lesion_distances_mm);
    }
    CHECK(done > 2000);
    CHECK(refused > 100);
}

TEST_CASE("hiding and showing brings the session back exactly") {
    std::mt19937 random(32);
    for (int round = 0; round < 50; ++round) {
        test::CommandStage stage(network(random));
        const std::string id = std::to_string(random() % static_cast<unsigned>(stage.document.branch_count()));
        stage.good("select-subtree " + id);
        const Marks before = stage.marks();
        stage.good("hide\nshow");
        CHECK(stage.marks() == before);
        stage.good("filter-diameter 3 hide\nshow-all");
        CHECK(stage.marks() == before);
        stage.good("hide\nselect-none\nshow-all\nselect-subtree " + id);
        CHECK(stage.marks() == before);
    }
}
