#include "core/tree/vessel_tree.h"

#include <doctest/doctest.h>

using namespace ramus::tree;

TEST_CASE("a subtree is the branch and all its descendants") {
    VesselTree tree;
    tree.points.resize(5);
    tree.branches = {{{0, 1}, kNoBranch, {1, 2}}, {{1, 2}, 0, {}}, {{1, 3}, 0, {3}}, {{3, 4}, 2, {}}};
    CHECK(subtree(tree, 2) == std::vector<int>{2, 3});
    CHECK(subtree(tree, 0) == std::vector<int>{0, 1, 2, 3});
}
