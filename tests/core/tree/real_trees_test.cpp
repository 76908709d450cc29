// The true counts of the real trees were made by an independent program.
#include "core/io/trees/tree_file.h"
#include "tests/support/shared_data.h"

#include <algorithm>
#include <doctest/doctest.h>
#include <map>

using namespace ramus;

namespace {

struct Counts {
    std::size_t nodes, segments, branches, branchings, components;
    double length_mm;
};

const std::map<std::string, Counts> kTrue{
    {"brain_BG001.swc", {2810, 2809, 197, 98, 1, 6058.6}},
    {"brain_BG0002.swc", {3514, 3513, 211, 105, 1, 7498.6}},
    {"brain_BG0003.swc", {3470, 3469, 219, 109, 1, 7909.4}},
    {"brain_BG04.swc", {3308, 3307, 191, 95, 1, 7394.3}},
    {"brain_BG05.swc", {3196, 3195, 195, 97, 1, 7363.7}},
    {"brain_unjoined_7001.swc", {2395, 2309, 86, 0, 86, 7099.4}},
    {"mouse_airways_m01.swc", {1850, 1849, 1849, 922, 1, 678.9}},
    {"mouse_airways_m04.swc", {995, 994, 994, 496, 1, 464.4}},
    {"mouse_airways_m10.swc", {1340, 1339, 1339, 664, 1, 539.1}},
    {"mouse_airways_m19.swc", {2286, 2285, 2285, 1139, 1, 730.5}},
    {"airways_from_mask.swc", {4475, 4474, 490, 243, 1, 4543.5}},
    {"kidney_77922_segments.swc", {77923, 77922, 5861, 2923, 1, 2363.7}},
};

} // namespace

TEST_CASE("real trees have their true counts") {
    for (const auto& path : test::shared_trees()) {
        const std::string name = path.filename().string();
        CAPTURE(name);
        io::ReadOptions as_it_is;
        as_it_is.repair = tree::without(tree::Repair::kUsual, tree::Repair::kOpenEnds);
        const auto tree = io::read_tree(path, as_it_is);
        REQUIRE(tree.has_value());
        const auto known = kTrue.find(name);
        REQUIRE(known != kTrue.end());
        const Counts& expected = known->second;
        CHECK(tree->points.size() == expected.nodes);
        CHECK(tree->segment_count() == expected.segments);
        CHECK(tree->branches.size() == expected.branches);
        CHECK(tree->roots.size() == expected.components);
        CHECK(tree->loop_count == 0);
        std::vector<int> degree(tree->points.size(), 0);
        double length = 0.0;
        for (const auto& branch : tree->branches) {
            ++degree[branch.points.front()], ++degree[branch.points.back()];
            length += tree::length_mm(*tree, branch);
        }
        CHECK(std::ranges::count_if(degree, [](int d) { return d > 2; }) == static_cast<long>(expected.branchings));
        CHECK(length == doctest::Approx(expected.length_mm).epsilon(1e-4));
        CHECK(sentences(*tree, tree::Note::Kind::kRepaired).size() ==
              (name == "brain_BG0002.swc" ? 1U : 0U)); // its one radius of zero
    }
}

TEST_CASE("of a real tree whose vessels are not connected the ends within others are joined") {
    for (const auto& path : test::shared_trees()) {
        if (path.filename() != "brain_unjoined_7001.swc") continue;
        const auto tree = io::read_tree(path);
        REQUIRE(tree.has_value());
        CHECK(tree->roots.size() == 4);
        CHECK(tree->loop_count == 0);
        CHECK(sentences(*tree, tree::Note::Kind::kRepaired).size() == 86 - tree->roots.size());
    }
}
