#include "core/tree/part_of_tree.h"
#include "tests/support/built_tree.h"

#include <algorithm>
#include <doctest/doctest.h>

using namespace ramus;

namespace {

// A stem from (0,0,0) that forks; its right child forks again. Ids: 0 the stem, 1 left, 2 right, 3 and 4 beyond right.
tree::VesselTree forks() {
    return test::built_tree({{{0, 0, 0}, 3.0},
                             {{0, 0, 10}, 2.5},
                             {{-5, 0, 20}, 1.0},
                             {{5, 0, 20}, 2.0},
                             {{4, 0, 30}, 1.0},
                             {{8, 0, 30}, 0.5}},
                            {{0, 1}, {1, 2}, {1, 3}, {3, 4}, {3, 5}});
}

double length_of(const tree::VesselTree& tree) {
    double sum = 0.0;
    for (const tree::Branch& branch : tree.branches) sum += tree::length_mm(tree, branch);
    return sum;
}

} // namespace

TEST_CASE("all of a tree is that tree") {
    const tree::VesselTree tree = forks();
    REQUIRE(tree.branches.size() == 5);
    CHECK(tree::part_of(tree, std::vector<std::uint8_t>(5, 1)) == tree);
}

TEST_CASE("a part has the branches that are kept, and where a fork has lost a branch the others are one") {
    const tree::VesselTree tree = forks();
    const tree::VesselTree part = tree::part_of(tree, std::vector<std::uint8_t>{1, 0, 1, 1, 1});
    REQUIRE(part.branches.size() == 3); // the stem runs on to the right
    CHECK(part.points.size() == 5);
    CHECK(part.branches[0].points.size() == 3);
    CHECK(part.roots.size() == 1);
    CHECK(part.points[part.roots[0]] == tree.points[tree.roots[0]]);
    CHECK(length_of(part) == doctest::Approx(length_of(tree) - tree::length_mm(tree, tree.branches[1])));
}

TEST_CASE("pieces that have lost their root begin where they were nearest to it") {
    const tree::VesselTree tree = forks();
    const tree::VesselTree part = tree::part_of(tree, std::vector<std::uint8_t>{0, 1, 0, 1, 1});
    CHECK(part.branches.size() == 3);
    REQUIRE(part.roots.size() == 2);
    CHECK(part.points[part.roots[0]].position == glm::dvec3(0, 0, 10));
    CHECK(part.points[part.roots[1]].position == glm::dvec3(5, 0, 20));
    CHECK(part.loop_count == 0);
    for (const tree::Branch& branch : part.branches) CHECK(branch.parent == tree::kNoBranch);
    // Branches beyond the end of the list go.
    CHECK(tree::part_of(tree, std::vector<std::uint8_t>{1}).branches.size() == 1);
}

TEST_CASE("systems, labels and loops stay with their branches") {
    tree::VesselTree tree = test::built_tree({{{0, 0, 0}, 1.0},
                                              {{0, 0, 10}, 1.0},
                                              {{-5, 0, 15}, 1.0},
                                              {{5, 0, 15}, 1.0},
                                              {{0, 0, 20}, 1.0},
                                              {{0, 0, 30}, 1.0},
                                              {{50, 0, 0}, 1.0},
                                              {{50, 0, 9}, 1.0}},
                                             {{0, 1}, {1, 2}, {1, 3}, {2, 4}, {3, 4}, {4, 5}, {6, 7}});
    REQUIRE(tree.loop_count == 1);
    tree.systems = {{"portal vein", {1, 2, 3}}, {"artery", {4, 5, 6}}};
    for (tree::Branch& branch : tree.branches)
        branch.system = tree.points[branch.points.front()].position.x == 50.0 ? 1 : 0;
    for (int label = 0; label < 8; ++label) tree.labels.push_back(10 * label);
    const auto kept = [&](auto keeps) {
        std::vector<std::uint8_t> flags;
        for (const tree::Branch& branch : tree.branches) flags.push_back(keeps(branch) ? 1 : 0);
        return tree::part_of(tree, flags);
    };
    const tree::VesselTree artery = kept([](const tree::Branch& branch) { return branch.system == 1; });
    REQUIRE(artery.branches.size() == 1);
    CHECK(artery.branches[0].system == 1);
    CHECK(artery.systems == tree.systems);
    CHECK(artery.labels == std::vector<int>{60, 70});
    const tree::VesselTree vein = kept([](const tree::Branch& branch) { return branch.system == 0; });
    CHECK(vein.loop_count == 1);
    CHECK(std::ranges::all_of(vein.branches, [](const tree::Branch& branch) { return branch.system == 0; }));
}
