// Looking never costs work: what undo took back can be redone after the selection, colours and depth cues have changed.
#include "app/session/document.h"
#include "tests/support/built_tree.h"

#include <algorithm>
#include <doctest/doctest.h>
#include <functional>
#include <random>

using namespace ramus;
using namespace ramus::app;
using tree::BranchState;

namespace {

// A trunk that forks, and forks again on both sides: 7 branches.
std::shared_ptr<const tree::VesselTree> forks() {
    std::vector<tree::Point> points{{{0, 0, 0}, 4.0}, {{0, 0, 40}, 4.0}};
    std::vector<tree::Edge> edges{{0, 1}};
    for (const std::uint32_t from : {1U, 1U, 2U, 2U, 3U, 3U}) {
        const auto to = static_cast<std::uint32_t>(points.size());
        const double side = to % 2 == 0 ? -1.0 : 1.0;
        points.push_back({points[from].position + glm::dvec3(side * 60.0 / (1.0 + from), 0.0, 30.0), 2.0});
        edges.emplace_back(from, to);
    }
    return std::make_shared<const tree::VesselTree>(test::built_tree(std::move(points), std::move(edges)));
}

struct Session7 {
    Document document;
    Session7() { document.open(forks(), {}); }
    void change(const std::function<void(Marks&)>& how, const char* name = "step") {
        document.begin_step();
        Marks next = document.marks();
        how(next);
        document.change(std::move(next));
        document.end_step(name);
    }
    void select(std::vector<int> ids) {
        change([&](Marks& marks) { marks.selection = std::move(ids); }, "select");
    }
    void state(int id, BranchState state) {
        change([&](Marks& marks) { set_state(marks, std::vector<int>{id}, state); }, "state");
    }
};

} // namespace

TEST_CASE("selecting and deselecting do not discard undone steps") {
    Session7 at;
    at.select({2});
    at.state(2, BranchState::kHidden);
    at.state(3, BranchState::kHighlighted);
    const Marks done = at.document.marks();
    REQUIRE(at.document.undo());
    REQUIRE(at.document.undo());
    REQUIRE(state_of(at.document.marks(), 2) == BranchState::kNormal);
    at.select({}); // Escape
    at.select({5});
    at.select({});
    REQUIRE(at.document.can_redo());
    REQUIRE(at.document.redo());
    REQUIRE(at.document.redo());
    CHECK_FALSE(at.document.can_redo());
    CHECK(at.document.marks().states == done.states);
    CHECK(at.document.marks().selection.empty()); // as it was looked at by then
    // And back the same way, to the beginning.
    while (at.document.undo()) {
    }
    CHECK(at.document.marks() == Marks{});
}

TEST_CASE("Escape without a selection adds no step of undo") {
    Session7 at;
    at.state(1, BranchState::kHidden);
    REQUIRE(at.document.undo());
    const std::size_t steps = at.document.step_count();
    at.select({});
    CHECK(at.document.step_count() == steps);
    CHECK(at.document.can_redo());
}

TEST_CASE("redo of a selection selects again, and keeps other looks as they are") {
    Session7 at;
    at.select({1});
    at.select({4});
    REQUIRE(at.document.undo());
    at.change([](Marks& marks) { marks.colour_by = Quantity::kGeneration, marks.skeleton = true; });
    REQUIRE(at.document.redo());
    CHECK(at.document.marks().selection == std::vector<int>{4});
    CHECK(at.document.marks().colour_by == Quantity::kGeneration);
    CHECK(at.document.marks().skeleton);
}

TEST_CASE("changes other than looks discard undone steps, also in one step with looks") {
    for (const bool with_looks : {false, true}) {
        Session7 at;
        at.state(1, BranchState::kHidden);
        at.state(2, BranchState::kHidden);
        REQUIRE(at.document.undo());
        at.document.begin_step();
        if (with_looks) {
            Marks next = at.document.marks();
            next.selection = {3};
            at.document.change(std::move(next));
            CHECK(at.document.can_redo());
        }
        Marks next = at.document.marks();
        set_state(next, std::vector<int>{3}, BranchState::kDefocused);
        at.document.change(std::move(next));
        at.document.end_step("defocus");
        CHECK_FALSE(at.document.can_redo());
        CHECK(at.document.step_count() == 2);
        REQUIRE(at.document.undo());
        CHECK(at.document.marks().selection.empty());
        CHECK(state_of(at.document.marks(), 3) == BranchState::kNormal);
        CHECK(state_of(at.document.marks(), 1) == BranchState::kHidden);
    }
}

TEST_CASE("redo of an edit of the tree restores the selection that the edit made") {
    Session7 at;
    at.select({6});
    at.document.begin_step();
    REQUIRE(at.document.edit_tree({.kind = tree::Edit::Kind::kDelete, .branches = {6}, .fractions = {}, .value = 0.0}));
    at.document.end_step("delete");
    const Marks done = at.document.marks();
    const int branches = at.document.branch_count();
    REQUIRE(branches < 7);
    REQUIRE(at.document.undo());
    at.select({5, 6});
    at.select({6});
    REQUIRE(at.document.redo());
    CHECK(at.document.branch_count() == branches);
    CHECK(at.document.marks().edits == done.edits);
    CHECK(at.document.marks().selection == done.selection);
    REQUIRE(at.document.undo());
    CHECK(at.document.marks().selection == std::vector<int>{6});
    CHECK(at.document.branch_count() == 7);
}

TEST_CASE("changes of looks do not count as unsaved work") {
    Session7 at;
    at.select({1});
    at.change([](Marks& marks) { marks.colour_by = Quantity::kGeneration, marks.contact_marks = true; });
    CHECK_FALSE(at.document.has_unsaved_work());
    CHECK(at.document.unsaved_changes() == 0);
    at.state(1, BranchState::kHidden);
    at.select({2});
    CHECK(at.document.has_unsaved_work());
    CHECK(at.document.unsaved_changes() == 1); // of the four steps
    at.document.mark_saved("/data/plan.ramus.json");
    REQUIRE(at.document.undo()); // the selection
    CHECK(at.document.unsaved_changes() == 0);
    REQUIRE(at.document.undo());
    CHECK(at.document.unsaved_changes() == 1);
    at.select({3});
    CHECK(at.document.unsaved_changes() == 1); // the way to what was saved is still there
    REQUIRE(at.document.redo());
    CHECK(at.document.unsaved_changes() == 0);
    CHECK_FALSE(at.document.has_unsaved_work());
}

TEST_CASE("with any looks in between, redo repeats the same work, and undo returns to the start") {
    std::mt19937 random(7);
    const auto below = [&](unsigned end) { return static_cast<int>(random() % end); };
    const auto work_of = [](const Marks& marks) { return with_looks(marks, Marks{}); };
    for (int run = 0; run < 40; ++run) {
        Session7 at;
        std::vector<Marks> work{work_of(at.document.marks())}; // after each step of work
        for (int step = 0; step < 12; ++step) {
            if (below(2) == 0) {
                at.select({below(7)});
                continue;
            }
            at.change([&](Marks& marks) {
                if (below(2) == 0) marks.cuts.emplace_back(below(7), 0.25);
                set_state(marks, std::vector<int>{below(7)}, static_cast<BranchState>(below(4)));
                marks.planning.reconstruct_mm += 1.0;
                if (below(3) == 0) marks.skeleton = !marks.skeleton;
            });
            work.push_back(work_of(at.document.marks()));
        }
        for (int walk = 0; walk < 30; ++walk) {
            const int what = below(3);
            if (what == 0) (void)at.document.undo();
            if (what == 1) (void)at.document.redo();
            if (what == 2)
                at.change([&](Marks& marks) {
                    marks.selection = below(2) == 0 ? std::vector<int>{} : std::vector<int>{below(7)};
                    if (below(3) == 0)
                        marks.colour_by = below(2) == 0 ? ColourBy(Quantity::kGeneration) : ColourBy(ColourBy::kState);
                });
            CHECK(std::ranges::find(work, work_of(at.document.marks())) != work.end());
        }
        while (at.document.redo()) {
        }
        CHECK(work_of(at.document.marks()) == work.back());
        while (at.document.undo()) {
        }
        CHECK(at.document.marks() == Marks{});
    }
}
