#include "core/tree/vessel_tree.h"

#include <doctest/doctest.h>

using namespace ramus::tree;

TEST_CASE("a subtree is the branch and all its descendants") {
    VesselTree tree;
    tree.branches.resize(4);
    tree.branches[0].children = {1, 2};
    tree.branches[2].children = {3};
    CHECK(subtree(tree, 2) == std::vector<int>{2, 3});
    CHECK(subtree(tree, 0) == std::vector<int>{0, 1, 2, 3});
}
