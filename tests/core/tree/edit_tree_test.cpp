// What edits make of small trees, whose topology is counted by hand.
#include "core/tree/dependency.h"
#include "core/tree/edit_tree.h"
#include "tests/support/built_tree.h"
#include "tests/support/grown_tree.h"

#include <algorithm>
#include <doctest/doctest.h>
#include <glm/geometric.hpp>
#include <random>
#include <set>

using namespace ramus;
using namespace ramus::tree;
using Kind = Edit::Kind;

namespace {

// Branch 0 along z from 0 to 40, r 3; at its end 1 to +x, r 2, in two steps of 20 mm, and 2 to -x, r 1, of 20 mm. At
// the end of 1, 3 (along z, 10 mm) and 4 (along y, 10 mm), r 0.5.
VesselTree branching() {
    return test::built_tree({{{0, 0, 0}, 3},
                             {{0, 0, 20}, 3},
                             {{0, 0, 40}, 3},
                             {{20, 0, 40}, 2},
                             {{40, 0, 40}, 2},
                             {{-20, 0, 40}, 1},
                             {{40, 0, 50}, 0.5},
                             {{40, 10, 40}, 0.5}},
                            {{0, 1}, {1, 2}, {2, 3}, {3, 4}, {2, 5}, {4, 6}, {4, 7}});
}

// Two rods, 10 mm apart, of 20 mm each.
VesselTree two_rods() {
    return test::built_tree({{{0, 0, 0}, 2}, {{0, 0, 20}, 2}, {{0, 0, 30}, 1}, {{0, 0, 50}, 1}}, {{0, 1}, {2, 3}},
                            {0, 2});
}

EditedTree made(const VesselTree& tree, const Edit& edit) {
    auto edited = apply(tree, edit);
    REQUIRE_MESSAGE(edited, (edited ? "" : edited.error().message()));
    return std::move(*edited);
}

std::string refused(const VesselTree& tree, const Edit& edit) {
    const auto edited = apply(tree, edit);
    REQUIRE_FALSE(edited);
    CHECK_FALSE(edited.error().hint.empty());
    return edited.error().what;
}

double total_length(const VesselTree& tree) {
    double sum = 0.0;
    for (const Branch& branch : tree.branches) sum += length_mm(tree, branch);
    return sum;
}

// All that VesselTree promises, checked without the code that makes it.
void check_sound(const VesselTree& tree) {
    std::set<std::uint32_t> used;
    std::size_t segments = 0;
    for (const Branch& branch : tree.branches) {
        REQUIRE(branch.points.size() >= 2);
        segments += branch.points.size() - 1;
        for (std::size_t i = 0; i < branch.points.size(); ++i) {
            used.insert(branch.points[i]);
            CHECK(tree.points[branch.points[i]].radius > 0.0);
            if (i > 0)
                CHECK(glm::distance(tree.points[branch.points[i - 1]].position,
                                    tree.points[branch.points[i]].position) > 0.0);
        }
        if (branch.parent == kNoBranch) continue;
        const Branch& parent = tree.branches[static_cast<std::size_t>(branch.parent)];
        CHECK(parent.points.back() == branch.points.front());
        CHECK(branch.system == parent.system);
    }
    CHECK(used.size() == tree.points.size()); // no point without a branch
    CHECK(tree.loop_count ==
          static_cast<int>(segments) - static_cast<int>(tree.points.size()) + static_cast<int>(tree.roots.size()));
}

} // namespace

TEST_CASE("an edit that changes no number changes nothing, whatever the network") {
    std::mt19937 random(7);
    for (int round = 0; round < 20; ++round) {
        Graph graph;
        std::uniform_real_distribution<double> place(0.0, 60.0), radius(0.3, 5.0);
        for (std::uint32_t i = 0; i < 60; ++i) {
            graph.points.push_back({{place(random), place(random), place(random)}, radius(random)});
            if (i > 0 && i != 30) graph.edges.emplace_back(random() % (i < 30 ? i : i - 30) + (i < 30 ? 0 : 30), i);
        }
        for (int i = 0; i < 4; ++i) graph.edges.emplace_back(random() % 29, 29);
        const auto tree = build_tree(graph, Repair::kAll, [](std::uint32_t) { return std::string(); });
        REQUIRE(tree);
        const EditedTree same = made(*tree, {Kind::kScale, {0}, {}, 1.0});
        CHECK(same.tree.points == tree->points);
        CHECK(same.tree.branches == tree->branches);
        CHECK(same.tree.roots == tree->roots);
        CHECK(same.tree.loop_count == tree->loop_count);
        for (std::size_t id = 0; id < tree->branches.size(); ++id)
            CHECK(same.sources[id] == std::vector<int>{static_cast<int>(id)});
    }
}

TEST_CASE("a cut makes an orphan with its own root at the cut end") {
    const VesselTree tree = branching();
    REQUIRE(tree.branches.size() == 5);
    const EditedTree cut = made(tree, {Kind::kCut, {1}, {0.5, 0.0}, 10.0});
    check_sound(cut.tree);
    CHECK(cut.tree.roots.size() == 2);
    CHECK(cut.tree.loop_count == 0);
    CHECK(cut.tree.branches.size() == 6); // 1 is two now, nothing else changes
    CHECK(total_length(cut.tree) == doctest::Approx(total_length(tree) - 10.0));
    CHECK(cut.tree.points[cut.tree.roots[0]] == tree.points[0]);
    const Point& root = cut.tree.points[cut.tree.roots[1]];
    CHECK(glm::distance(root.position, glm::dvec3(25, 0, 40)) < 1e-9);
    CHECK(root.radius == doctest::Approx(2.0));
    int from_one = 0;
    for (const auto& sources : cut.sources) from_one += sources == std::vector<int>{1} ? 1 : 0;
    CHECK(from_one == 2);
}

TEST_CASE("a cut takes the diameter there unless told, and stubs within a vessel go with it") {
    const VesselTree tree = branching();
    const CutRange usual = cut_range(tree, 0, 0.5, 0.0);
    CHECK(usual.from == doctest::Approx(17.0 / 40.0));
    CHECK(usual.to == doctest::Approx(23.0 / 40.0));
    // 4 mm from the fork, whose radius is 3 mm: what is left there, 2 mm, lies inside the stem.
    const CutRange near = cut_range(tree, 2, 0.2, 4.0);
    CHECK(near.from == 0.0);
    CHECK(near.to == doctest::Approx(0.3));
    const EditedTree cut = made(tree, {Kind::kCut, {2}, {0.2, 0.0}, 4.0});
    check_sound(cut.tree);
    CHECK(cut.tree.roots.size() == 2);
    CHECK(cut.tree.branches.size() == 4); // 0 and 1 are one, and the orphan is another
    CHECK(cut.tree.points[cut.tree.roots[1]].position.x == doctest::Approx(-6.0));
}

TEST_CASE("a cut that opens a loop leaves one piece, and one that takes a bridge leaves two") {
    // A ring of four with a handle on either side.
    const VesselTree ring = test::built_tree(
        {{{0, 0, 0}, 1}, {{10, 0, 0}, 1}, {{20, 10, 0}, 1}, {{20, -10, 0}, 1}, {{30, 0, 0}, 1}, {{40, 0, 0}, 1}},
        {{0, 1}, {1, 2}, {1, 3}, {2, 4}, {3, 4}, {4, 5}});
    REQUIRE(ring.loop_count == 1);
    const EditedTree opened = made(ring, {Kind::kCut, {1}, {0.5, 0.0}, 0.0});
    check_sound(opened.tree);
    CHECK(opened.tree.loop_count == 0);
    CHECK(opened.tree.roots.size() == 1);
    CHECK(std::ranges::none_of(opened.tree.notes, [](const Note& note) { return note.topic == "loops"; }));

    // Two vessels side by side with a bridge of 5 mm between them: it goes whole.
    const VesselTree bridged = test::built_tree(
        {{{0, 0, 0}, 2}, {{0, 0, 20}, 2}, {{0, 0, 40}, 2}, {{5, 0, 0}, 1}, {{5, 0, 20}, 1}, {{5, 0, 40}, 1}},
        {{0, 1}, {1, 2}, {3, 4}, {4, 5}, {1, 4}});
    REQUIRE(bridged.branches.size() == 5);
    const auto bridge = std::ranges::find_if(
        bridged.branches, [&](const Branch& branch) { return length_mm(bridged, branch) == doctest::Approx(5.0); });
    const EditedTree apart =
        made(bridged, {Kind::kCut, {static_cast<int>(bridge - bridged.branches.begin())}, {0.5, 0.0}, 0.0});
    check_sound(apart.tree);
    CHECK(apart.tree.branches.size() == 2);
    CHECK(apart.tree.roots.size() == 2);
    CHECK(total_length(apart.tree) == doctest::Approx(80.0));
    CHECK(std::ranges::any_of(apart.tree.notes, [](const Note& note) { return note.topic == "pieces"; }));
}

TEST_CASE("joining two ends makes one vessel with a straight segment between them") {
    const VesselTree tree = two_rods();
    const EditedTree joined = made(tree, {Kind::kJoin, {0, 1}, {1.0, 0.0}, 0.0});
    check_sound(joined.tree);
    CHECK(joined.tree.branches.size() == 1);
    CHECK(joined.tree.roots.size() == 1);
    CHECK(joined.tree.points[joined.tree.roots[0]] == tree.points[0]); // not where they were joined
    CHECK(total_length(joined.tree) == doctest::Approx(50.0));
    CHECK(joined.sources[0] == std::vector<int>{0, 1});
    // The same, begun from the other side.
    const EditedTree back = made(tree, {Kind::kJoin, {1, 0}, {0.0, 1.0}, 0.0});
    CHECK(back.tree.points[back.tree.roots[0]] == tree.points[0]);
    CHECK(total_length(back.tree) == doctest::Approx(50.0));
    // To the side of a vessel: a branching.
    const EditedTree beside = made(tree, {Kind::kJoin, {1, 0}, {0.0, 0.5}, 0.0});
    check_sound(beside.tree);
    CHECK(beside.tree.branches.size() == 3);
    CHECK(beside.tree.roots.size() == 1);
    CHECK(total_length(beside.tree) == doctest::Approx(60.0));
    // With itself: a ring.
    const EditedTree ring = made(branching(), {Kind::kJoin, {3, 4}, {1.0, 1.0}, 0.0});
    check_sound(ring.tree);
    CHECK(ring.tree.loop_count == 1);
    CHECK(ring.tree.roots.size() == 1);
}

TEST_CASE("ends at one place become one point, of the wider radius") {
    const VesselTree tree =
        test::built_tree({{{0, 0, 0}, 2}, {{0, 0, 20}, 2}, {{0, 0, 20}, 1}, {{0, 0, 50}, 1}}, {{0, 1}, {2, 3}}, {0, 2});
    REQUIRE(tree.roots.size() == 2);
    const EditedTree joined = made(tree, {Kind::kJoin, {0, 1}, {1.0, 0.0}, 0.0});
    check_sound(joined.tree);
    CHECK(joined.tree.points.size() == 3);
    CHECK(joined.tree.points[1].radius == 2.0);
    CHECK(joined.tree.branches.size() == 1);
}

TEST_CASE("what cannot be joined says why") {
    const VesselTree tree = branching();
    CHECK(refused(tree, {Kind::kJoin, {0, 3}, {1.0, 1.0}, 0.0}).find("no free end") != std::string::npos);
    CHECK(refused(two_rods(), {Kind::kJoin, {0, 0}, {1.0, 0.0}, 0.0}).find("connected already") != std::string::npos);
    CHECK(refused(two_rods(), {Kind::kJoin, {0, 0}, {1.0, 1.0}, 0.0}).find("connected already") != std::string::npos);

    Graph graph;
    graph.points = {{{0, 0, 0}, 2}, {{0, 0, 20}, 2}, {{0, 0, 30}, 1}, {{0, 0, 50}, 1}};
    graph.edges = {{0, 1}, {2, 3}};
    graph.systems = {{"portal vein", {}}, {"hepatic vein", {}}};
    graph.point_systems = {0, 0, 1, 1};
    const auto two = build_tree(graph, Repair::kNone, [](std::uint32_t) { return std::string(); });
    REQUIRE(two);
    const std::string why = refused(*two, {Kind::kJoin, {0, 1}, {1.0, 0.0}, 0.0});
    CHECK(why.find("portal vein") != std::string::npos);
    CHECK(why.find("hepatic vein") != std::string::npos);
    // Other edits keep the systems.
    const EditedTree cut = made(*two, {Kind::kCut, {1}, {0.5, 0.0}, 0.0});
    check_sound(cut.tree);
    CHECK(cut.tree.systems == two->systems);
    CHECK(cut.tree.roots.size() == 3);
    for (const Branch& branch : cut.tree.branches)
        CHECK(branch.system == (cut.tree.points[branch.points[0]].position.z < 25.0 ? 0 : 1));
}

TEST_CASE("a deleted spur leaves its neighbours one branch") {
    const VesselTree tree = branching();
    const EditedTree without = made(tree, {Kind::kDelete, {2}, {}, 0.0});
    check_sound(without.tree);
    CHECK(without.tree.branches.size() == 3);
    CHECK(without.sources[0] == std::vector<int>{0, 1}); // 40 mm each, the lower first
    CHECK(without.tree.branches[0].points.size() == 5);
    CHECK(without.tree.roots.size() == 1);
    CHECK(refused(tree, {Kind::kDelete, {1}, {}, 0.0}).find("carries others") != std::string::npos);
    const EditedTree subtree = made(tree, {Kind::kDelete, {1, 3, 4}, {}, 0.0});
    CHECK(subtree.tree.branches.size() == 1);
    CHECK(refused(tree, {Kind::kDelete, {0, 1, 2, 3, 4}, {}, 0.0}).find("nothing") != std::string::npos);
    // A whole piece may go.
    const EditedTree one = made(two_rods(), {Kind::kDelete, {0}, {}, 0.0});
    check_sound(one.tree);
    CHECK(one.tree.roots.size() == 1);
    // Without the branch of the root, the thickest end that is left is the root.
    const EditedTree rootless = made(tree, {Kind::kDelete, {0}, {}, 0.0});
    check_sound(rootless.tree);
    REQUIRE(rootless.tree.roots.size() == 1);
    CHECK(rootless.tree.points[rootless.tree.roots[0]].position.x == -20.0);
}

TEST_CASE("the root moves to an end, and branches turn with it") {
    const VesselTree tree = branching();
    const EditedTree moved = made(tree, {Kind::kMoveRoot, {2}, {0.9, 0.0}, 0.0});
    check_sound(moved.tree);
    REQUIRE(moved.tree.roots.size() == 1);
    CHECK(moved.tree.points[moved.tree.roots[0]].position.x == -20.0);
    CHECK(moved.tree.branches.size() == 5);
    CHECK(moved.tree.branches[0].points.front() == moved.tree.roots[0]);
    CHECK(moved.sources[0] == std::vector<int>{2});
    CHECK(refused(tree, {Kind::kMoveRoot, {1}, {0.5, 0.0}, 0.0}).find("free end") != std::string::npos);
    CHECK(refused(tree, {Kind::kMoveRoot, {0}, {0.1, 0.0}, 0.0}).find("already") != std::string::npos);
    // And back: the same tree, but for the order of its branches.
    const EditedTree back = made(moved.tree, {Kind::kMoveRoot, {1}, {1.0, 0.0}, 0.0});
    CHECK(back.tree.points == tree.points);
    CHECK(back.tree.roots == tree.roots);
}

TEST_CASE("flipping a branch lets blood in at the thickest end beyond it") {
    const VesselTree tree = branching();
    const EditedTree whole = made(tree, {Kind::kFlip, {0}, {}, 0.0});
    CHECK(whole.tree.points[whole.tree.roots[0]].position.x == -20.0); // r 1, the others 0.5
    const EditedTree rod = made(two_rods(), {Kind::kFlip, {1}, {}, 0.0});
    CHECK(rod.tree.roots.size() == 2);
    CHECK(rod.tree.points[rod.tree.roots[1]].position.z == 50.0);
    const EditedTree again = made(rod.tree, {Kind::kFlip, {1}, {}, 0.0});
    CHECK(again.tree == two_rods());
}

TEST_CASE("radii of branches change, those of shared nodes only with all that share them") {
    const VesselTree tree = branching();
    const EditedTree one = made(tree, {Kind::kRadius, {1}, {}, 4.0});
    check_sound(one.tree);
    CHECK(one.tree.points.size() == tree.points.size());
    for (std::size_t p = 0; p < tree.points.size(); ++p)
        CHECK(one.tree.points[p].radius == (p == 3 ? 4.0 : tree.points[p].radius));
    // Both of its nodes shared, and nothing between: a point in the middle.
    const VesselTree bare = test::built_tree(
        {{{0, 0, 0}, 2}, {{0, 0, 10}, 2}, {{0, 0, 20}, 1}, {{5, 0, 30}, 1}, {{-5, 0, 30}, 1}, {{9, 0, 10}, 1}},
        {{0, 1}, {1, 2}, {2, 3}, {2, 4}, {1, 5}});
    const EditedTree thick = made(bare, {Kind::kScale, {1}, {}, 2.0});
    check_sound(thick.tree);
    CHECK(thick.tree.points.size() == bare.points.size() + 1);
    CHECK(thick.tree.branches.size() == bare.branches.size());
    CHECK(thick.tree.points.back().radius == doctest::Approx(3.0));
    const EditedTree all = made(tree, {Kind::kScale, {0, 1, 2, 3, 4}, {}, 0.5});
    for (std::size_t p = 0; p < tree.points.size(); ++p)
        CHECK(all.tree.points[p].radius == 0.5 * tree.points[p].radius);
    CHECK(refused(tree, {Kind::kScale, {0}, {}, 0.0}).find("positive") != std::string::npos);
    CHECK(refused(tree, {Kind::kScale, {0}, {}, 1e9}).find("would be") != std::string::npos);
    CHECK(refused(tree, {Kind::kRadius, {5}, {}, 1.0}).find("no branch 5") != std::string::npos);
    CHECK(refused(tree, {Kind::kCut, {0}, {1.5, 0.0}, 1.0}).find("between 0 and 1") != std::string::npos);
    CHECK(refused(tree, {Kind::kJoin, {0}, {1.0, 0.0}, 1.0}).find("names 1") != std::string::npos);
}

TEST_CASE("edits at random keep every promise of a tree, and come out the same again") {
    std::mt19937 random(5);
    const VesselTree start = test::grown(80);
    for (int round = 0; round < 8; ++round) {
        VesselTree tree = start;
        std::vector<Edit> done;
        for (int i = 0; i < 40; ++i) {
            const auto branch = [&] { return static_cast<int>(random() % tree.branches.size()); };
            const auto share = [&] { return static_cast<double>(random() % 11) / 10.0; };
            const auto kind = kEditNames[random() % std::size(kEditNames)].first;
            Edit edit{kind, {branch()}, {share(), share()}, 0.1 * static_cast<double>(random() % 30)};
            if (kind == Kind::kJoin) edit.branches.push_back(branch());
            const auto edited = apply(tree, edit);
            if (!edited) continue;
            check_sound(edited->tree);
            for (const auto& sources : edited->sources)
                for (const int source : sources) CHECK(static_cast<std::size_t>(source) < tree.branches.size());
            tree = edited->tree;
            done.push_back(edit);
        }
        CHECK(done.size() > 10);
        CHECK(apply_all(start, done).value() == tree);
    }
}
