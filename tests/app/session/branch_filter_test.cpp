// What people type to find branches.
#include "app/session/branch_filter.h"
#include "tests/support/grown_tree.h"

#include <doctest/doctest.h>
#include <functional>

using namespace ramus;
using namespace ramus::app;

namespace {

struct FilterStage {
    tree::VesselTree tree;
    TreeFacts facts;
    Marks marks;
    explicit FilterStage(int branches = 300) {
        auto grown = test::grown_tree(branches);
        REQUIRE(grown);
        tree = std::move(*grown);
        facts = facts_of(tree);
    }
    [[nodiscard]] std::vector<int> find(std::string_view text) const {
        const auto filter = parse_branch_filter(text);
        REQUIRE_MESSAGE(filter, (filter ? "" : filter.error().message()));
        return branches_passing(*filter, tree, facts, marks);
    }
    [[nodiscard]] std::vector<int> those(const std::function<bool(int)>& wanted) const {
        std::vector<int> ids;
        for (int id = 0; id < static_cast<int>(tree.branches.size()); ++id)
            if (wanted(id)) ids.push_back(id);
        return ids;
    }
};

std::string trouble(std::string_view text) {
    const auto filter = parse_branch_filter(text);
    REQUIRE_FALSE(filter);
    return filter.error().message();
}

} // namespace

TEST_CASE("conditions on numbers find the branches that fulfil all of them") {
    const FilterStage stage;
    const auto& facts = stage.facts.branches;
    const auto& branches = stage.tree.branches;
    const auto at = [](int id) { return static_cast<std::size_t>(id); };
    CHECK(stage.find("").size() == branches.size());
    CHECK(stage.find("  \t ").size() == branches.size());
    const auto thick = stage.those([&](int id) { return facts[at(id)].diameter_mm.mean > 3.0; });
    REQUIRE_FALSE(thick.empty());
    REQUIRE(thick.size() < branches.size());
    for (const char* text : {"d>3", "D > 3", "diameter >3mm", " d> 3.0 mm ", "d>3,"}) CHECK(stage.find(text) == thick);
    CHECK(stage.find("gen<5") == stage.those([&](int id) { return branches[at(id)].generation < 5; }));
    CHECK(stage.find("gen<=5 len>=20 deps>10") == stage.those([&](int id) {
        return branches[at(id)].generation <= 5 && facts[at(id)].length_mm >= 20.0 &&
               facts[at(id)].dependents.branches > 10;
    }));
    CHECK(stage.find("d > 2 mm len < 20 mm") ==
          stage.those([&](int id) { return facts[at(id)].diameter_mm.mean > 2.0 && facts[at(id)].length_mm < 20.0; }));
    CHECK(stage.find("strahler=1") == stage.those([&](int id) { return branches[at(id)].strahler == 1; }));
    CHECK(stage.find("strahler!=1") == stage.those([&](int id) { return branches[at(id)].strahler != 1; }));
    CHECK(stage.find("id<10").size() == 10);
    CHECK(stage.find("id==7") == std::vector<int>{7});
    CHECK(stage.find("vol>100mm\xC2\xB3") == stage.those([&](int id) { return facts[at(id)].volume_mm3 > 100.0; }));
    CHECK(stage.find("dist\xE2\x89\xA5"
                     "50") == stage.those([&](int id) { return facts[at(id)].root_distance_mm >= 50.0; }));
    CHECK(stage.find("d>1e9").empty());
}

TEST_CASE("words find labels, numbers find ids, and is: finds states") {
    FilterStage stage;
    CHECK(stage.find("17") == std::vector<int>{17});
    CHECK(stage.find("hepatic").empty());
    stage.marks.names = {{1, "Right Hepatic"}, {2, "left hepatic 17"}};
    stage.marks.subtree_names = {1, 2};
    const auto right = tree::subtree(stage.tree, 1);
    const auto left = tree::subtree(stage.tree, 2);
    CHECK(stage.find("right") == right);
    CHECK(stage.find("RIGHT hep") == right);
    CHECK(stage.find("\"right hepatic\"") == right);
    CHECK(stage.find("\"hepatic right\"").empty());
    CHECK(stage.find("hepatic").size() == right.size() + left.size());
    CHECK(stage.find("hepatic id=1") == std::vector<int>{1});
    auto with = left;
    with.push_back(17);
    CHECK(stage.find("17") == canonical(with)); // an id, or in the label
    CHECK(stage.find("is:named").size() == right.size() + left.size());

    set_state(stage.marks, std::vector<int>{3, 5}, tree::BranchState::kHidden);
    set_state(stage.marks, std::vector<int>{8}, tree::BranchState::kHighlighted);
    stage.marks.selection = {4, 6};
    CHECK(stage.find("is:hidden") == std::vector<int>{3, 5});
    CHECK(stage.find("is:highlighted") == std::vector<int>{8});
    CHECK(stage.find("is:defocused").empty());
    CHECK(stage.find("is:selected") == std::vector<int>{4, 6});
    CHECK(stage.find("IS:normal").size() == stage.tree.branches.size() - 3);
    for (const int id : stage.find("is:leaf"))
        CHECK(stage.facts.branches[static_cast<std::size_t>(id)].dependents.branches == 0);
    CHECK(stage.find("is:leaf").size() == static_cast<std::size_t>(stage.facts.statistics.leaves));
}

TEST_CASE("invalid filters are reported") {
    CHECK(trouble("d>").find("a number is missing") != std::string::npos);
    CHECK(trouble("d>thick").find("\"thick\" is not a number") != std::string::npos);
    CHECK(trouble("width>3").find("\"width\" is not known") != std::string::npos);
    CHECK(trouble(">3").find("what shall be compared") != std::string::npos);
    CHECK(trouble("is:blue").find("is: takes") != std::string::npos);
    CHECK(trouble("\"open").find("not closed") != std::string::npos);
    CHECK(trouble("d>nan").find("not a number") != std::string::npos);
    CHECK(trouble("d>3mmm").find("not a number") != std::string::npos);
    // Nothing makes it stumble.
    for (int a = 1; a < 256; ++a)
        for (const char* rest : {"", "=", "d<", "\"", " mm"}) {
            const std::string text = std::string(1, static_cast<char>(a)) + rest;
            (void)parse_branch_filter(text);
        }
}

TEST_CASE("whole numbers are compared exactly, however large") {
    const FilterStage stage(2300);
    CHECK(stage.find("id<=2000").size() == 2001);
    CHECK(stage.find("id>=2000").size() == stage.tree.branches.size() - 2000);
    CHECK(stage.find("id=2000") == std::vector<int>{2000});
}
