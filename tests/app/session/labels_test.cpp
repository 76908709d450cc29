// Names that follow their dependents, and what a branch's facts sum up.
#include "app/session/branch_facts.h"
#include "app/session/labels.h"
#include "tests/support/grown_tree.h"

#include <algorithm>
#include <doctest/doctest.h>
#include <numbers>

using namespace ramus;
using namespace ramus::app;

TEST_CASE("a label is the name of the nearest named branch towards the root") {
    const tree::VesselTree tree = test::grown(200);
    const TreeFacts facts = facts_of(tree);
    int inner = tree::kNoBranch; // with children that have children
    for (std::size_t id = 0; id < tree.branches.size() && inner < 0; ++id)
        if (tree.branches[id].generation == 2 && facts.branches[id].dependents.branches > 4)
            inner = static_cast<int>(id);
    REQUIRE(inner >= 0);
    const int child = tree.branches[static_cast<std::size_t>(inner)].children.front();
    Marks marks;
    set_name(marks, inner, "right hepatic", true);
    set_name(marks, child, "segment VI", true);

    for (int id = 0; id < static_cast<int>(tree.branches.size()); ++id) {
        const auto below = [&](int root) {
            const auto ids = tree::subtree(tree, root);
            return std::binary_search(ids.begin(), ids.end(), id);
        };
        CHECK(label_of(facts.dependency, marks, id) == (below(child)   ? "segment VI"
                                                        : below(inner) ? "right hepatic"
                                                                       : ""));
    }
}

TEST_CASE("labels of all branches at once agree with labels one by one") {
    const tree::VesselTree tree = test::grown(500);
    const tree::Dependency dependency(tree);
    Marks marks;
    for (const auto& [named, of_subtree] : {std::pair{-1, false}, {0, true}, {7, false}, {40, true}, {123, false}}) {
        if (named >= 0) set_name(marks, named, "name " + std::to_string(named), of_subtree);
        const std::vector<int> sources = label_sources(dependency, marks);
        REQUIRE(sources.size() == tree.branches.size());
        for (int id = 0; id < static_cast<int>(sources.size()); ++id)
            CHECK(sources[static_cast<std::size_t>(id)] == label_source(dependency, marks, id));
    }
}

TEST_CASE("a name belongs to one branch, unless it was given to its subtree") {
    const tree::VesselTree tree = test::grown(200);
    const tree::Dependency dependency(tree);
    Marks marks;
    set_name(marks, 0, "trunk", false);
    for (int id = 0; id < static_cast<int>(tree.branches.size()); ++id)
        CHECK(label_of(dependency, marks, id) == (id == 0 ? "trunk" : ""));
    set_name(marks, 0, "trunk", true);
    const int child = tree.branches[0].children.front();
    set_name(marks, child, "stem", false); // names itself; what lies beyond it is the trunk's
    CHECK(label_of(dependency, marks, child) == "stem");
    for (const int beyond : tree.branches[static_cast<std::size_t>(child)].children)
        CHECK(label_of(dependency, marks, beyond) == "trunk");
    set_name(marks, 0, "", true);
    CHECK(marks.subtree_names.empty());
    CHECK(marks.names.size() == 1);
}

TEST_CASE("facts include the sums over the dependents of a branch, and its distance from the root") {
    const tree::VesselTree tree = test::grown(300);
    const TreeFacts facts = facts_of(tree);
    double volume = 0.0;
    for (int id = 0; id < static_cast<int>(tree.branches.size()); ++id) {
        const BranchFacts& own = facts.branches[static_cast<std::size_t>(id)];
        volume += own.volume_mm3;
        double length = 0.0, below = 0.0;
        const auto ids = tree::subtree(tree, id);
        for (const int other : ids) {
            if (other == id) continue;
            length += facts.branches[static_cast<std::size_t>(other)].length_mm;
            below += facts.branches[static_cast<std::size_t>(other)].volume_mm3;
        }
        CHECK(own.dependents.branches + 1 == static_cast<int>(ids.size()));
        CHECK(own.dependents.length_mm == doctest::Approx(length));
        CHECK(own.dependents.volume_mm3 == doctest::Approx(below));
        double way = 0.0;
        for (const int step : path_to(tree, id))
            if (step != id) way += facts.branches[static_cast<std::size_t>(step)].length_mm;
        CHECK(own.root_distance_mm == doctest::Approx(way));
    }
    CHECK(volume == doctest::Approx(facts.statistics.volume_mm3));
}

TEST_CASE("the volume of a straight vessel is that of a cylinder") {
    tree::VesselTree tree;
    for (int i = 0; i < 3; ++i) tree.points.push_back({{5.0 * i, 0.0, 0.0}, 2.0});
    tree.branches.emplace_back().points = {0, 1, 2};
    tree.roots = {0};
    const TreeFacts facts = facts_of(tree);
    CHECK(facts.branches[0].volume_mm3 == doctest::Approx(std::numbers::pi * 4.0 * 10.0));
    CHECK(facts.branches[0].dependents.volume_mm3 == 0.0);
    CHECK(facts.branches[0].root_distance_mm == 0.0);
}
