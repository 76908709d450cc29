#include "app/session/document.h"
#include "core/base/memory.h"
#include "tests/support/command_stage.h"

#include <doctest/doctest.h>
#include <random>

using namespace ramus;
using namespace ramus::app;
using test::Ids;
using tree::BranchState;

namespace {

// A star: all others depend on the first.
std::shared_ptr<const tree::VesselTree> tree_of(std::size_t branches) {
    auto tree = std::make_shared<tree::VesselTree>();
    tree->branches.resize(branches);
    tree->roots = {0};
    tree->points.push_back({{0.0, 0.0, 0.0}, 1.0});
    for (std::size_t i = 0; i < branches; ++i) {
        const auto point = static_cast<std::uint32_t>(tree->points.size());
        tree->points.push_back({{static_cast<double>(i), 1.0, 0.0}, 1.0});
        tree::Branch& branch = tree->branches[i];
        branch.points = {i == 0 ? 0U : 1U, point};
        if (i == 0) continue;
        branch.parent = 0;
        branch.generation = 1;
        tree->branches[0].children.push_back(static_cast<int>(i));
    }
    return tree;
}

int below(std::mt19937& random, int end) { return static_cast<int>(random() % static_cast<unsigned>(end)); }

template <class List> void add_of_at_most(List& list, typename List::value_type one, std::size_t most, int erased) {
    list.push_back(std::move(one));
    if (list.size() > most) list.erase(list.begin() + erased);
}

void change_states(Marks& marks, int branches, std::mt19937& random) {
    switch (below(random, 6)) {
    case 0:
        marks.selection = {below(random, branches)};
        break;
    case 1: // half of them
        marks.selection.clear();
        for (int i = 0; i < branches; ++i)
            if (below(random, 2) == 0) marks.selection.push_back(i);
        break;
    case 2:
        marks.selection.clear();
        break;
    case 3:
        set_state(marks, marks.selection, static_cast<BranchState>(below(random, 4)));
        break;
    case 4:
        for (int i = 0; i < branches; ++i) set_state(marks, Ids{i}, static_cast<BranchState>(below(random, 4)));
        break;
    default:
        marks.states.clear();
    }
}

void change_plans(Marks& marks, int branches, std::mt19937& random) {
    const int branch = below(random, branches);
    const double length = below(random, 1000) / 8.0;
    switch (below(random, 7)) {
    case 0:
        add_of_at_most(marks.lesions, {.sphere = {length, 2.0, 3.0, 4.0}}, 3, below(random, 3));
        break;
    case 1:
        add_of_at_most(marks.cuts, {branch, 0.5}, 4, 1);
        break;
    case 2:
        marks.names[branch] = "vessel " + std::to_string(below(random, 100));
        if (marks.names.size() > 5) marks.names.erase(marks.names.begin());
        break;
    case 3:
        add_of_at_most(marks.measurements,
                       {.kind = Measurement::Kind::kPath, .places = {{{branch, 0.25}, {below(random, branches), 0.5}}}},
                       2, 0);
        break;
    case 4:
        add_lesion(marks, {.file = "/data/" + std::to_string(below(random, 5)) + ".stl"});
        marks.planning.bands_mm = {1.0, 2.0 + length};
        break;
    case 5: {
        ContextItem item;
        item.file = std::to_string(below(random, 5));
        item.label = below(random, 3);
        add_of_at_most(marks.context, item, 3, below(random, 3));
        break;
    }
    default:
        marks.glass.opacity = length / 125.0;
        marks.colour_by = colourings()[static_cast<std::size_t>(below(random, 5))].by;
        marks.options.detail = 8 + below(random, 20);
    }
}

// One random edit of any kind that Marks knows.
Marks edited(Marks marks, int branches, std::mt19937& random) {
    below(random, 13) < 6 ? change_states(marks, branches, random) : change_plans(marks, branches, random);
    return marks;
}

struct HistoryStage : test::CommandStage {
    explicit HistoryStage(std::size_t branches) : test::CommandStage(tree_of(branches)) {}
};

} // namespace

TEST_CASE("all ids are unchanged after packing and unpacking") {
    std::mt19937 random(7);
    for (const int sparse : {1, 2, 7, 50, 1000}) {
        std::vector<int> ids;
        for (int id = static_cast<int>(random() % 500); id < 40'000;
             id += 1 + static_cast<int>(random() % static_cast<unsigned>(sparse)))
            ids.push_back(id);
        CHECK(PackedIds(ids).ids() == ids);
        CHECK(PackedIds(ids).count() == ids.size());
    }
    CHECK(PackedIds(std::vector<int>{}).ids().empty());
    CHECK(PackedIds(std::vector<int>{0}).ids() == std::vector<int>{0});
    CHECK(PackedIds(std::vector<int>{99'999'999}).ids() == std::vector<int>{99'999'999});
    CHECK(PackedIds(std::vector<int>{0, 99'999'999}).ids() == std::vector<int>{0, 99'999'999});
}

TEST_CASE("any sequence of changes undone to the start equals the start, and every value on the way") {
    std::mt19937 random(11);
    for (const int branches : {1, 9, 300}) {
        Document document;
        document.open(tree_of(static_cast<std::size_t>(branches)), {});
        std::vector<Marks> values{document.marks()};
        for (int i = 0; i < 400; ++i) {
            if (random() % 5 == 0 && document.undo()) values.pop_back(); // and another way from there
            document.change(edited(document.marks(), branches, random));
            if (document.marks() != values.back()) values.push_back(document.marks());
        }
        REQUIRE(document.position() == values.size() - 1);
        for (std::size_t i = values.size() - 1; i-- > 0;) {
            REQUIRE(document.undo());
            REQUIRE(document.marks() == values[i]);
        }
        CHECK_FALSE(document.undo());
        CHECK(document.marks() == Marks{});
        for (std::size_t i = 1; i < values.size(); ++i) {
            REQUIRE(document.redo());
            REQUIRE(document.marks() == values[i]);
        }
        CHECK_FALSE(document.redo());
    }
}

TEST_CASE("ten thousand steps on a tree of thirty thousand branches take less than 200 MB, and all can be undone" *
          doctest::test_suite("slow")) {
    constexpr int kBranches = 30'000;
    std::mt19937 random(3);
    // The worst there is: every step turns half of the selection and half of the states over, at random.
    std::vector<Marks> scenes(16);
    for (Marks& scene : scenes) {
        scene.states.resize(kBranches);
        for (int i = 0; i < kBranches; ++i) {
            if (random() % 2 == 0) scene.selection.push_back(i);
            scene.states[static_cast<std::size_t>(i)] = static_cast<BranchState>(random() % 4);
        }
        set_state(scene, {}, BranchState::kNormal);
    }
    Document document;
    document.open(tree_of(kBranches), {});
    const double before = process_memory();
    constexpr std::size_t kRedone = 1000;
    Marks early; // after so many steps
    for (std::size_t i = 0; i < 10'000; ++i) {
        if (i == kRedone) early = document.marks();
        Marks next = scenes[i % scenes.size()];
        next.names = document.marks().names;
        if (i % 16 == 0) next.names[static_cast<int>(i)] = "vessel"; // and a map that grows and grows
        document.change(std::move(next));
    }
    const double taken = process_memory() - before;
    MESSAGE("taken: " << taken / 1e6 << " MB");
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__) // those keep what was freed
    if (before > 0.0) CHECK(taken < 200e6);
#endif
    CHECK(document.position() == 10'000);
    while (document.undo()) {
    }
    CHECK(document.position() == 0);
    CHECK(document.marks() == Marks{});
    for (std::size_t i = 0; i < kRedone; ++i) REQUIRE(document.redo());
    CHECK(document.marks() == early);
}

TEST_CASE("every step of undo has the name of its command") {
    HistoryStage stage(1200);
    const auto called = [&](std::string_view line) {
        const auto done = stage.run(line);
        REQUIRE_MESSAGE(done, (done ? "" : done.error().message()));
        return stage.last_step();
    };
    CHECK(called("select 3 4 5") == "select 3 branches");
    CHECK(called("hide") == "hide 3 branches");
    CHECK(called("select 7") == "select branch 7");
    CHECK(called("name 7 \"right portal\"") == "name 7 right portal");
    CHECK(called("highlight") == "highlight right portal");
    CHECK(called("select-invert") == "select invert: 1,199 branches");
    CHECK(called("select-none") == "select none");
    CHECK(called("surface detail 24") == "surface detail 24");
    CHECK(called("colour-by generation") == "colour by generation");
    CHECK(called("show-all") == "show all: 4 branches");

    REQUIRE(stage.run("undo"));
    CHECK(label_of(*find_command("undo"), stage.document) == "Undo colour by generation");
    CHECK(label_of(*find_command("redo"), stage.document) == "Redo show all: 4 branches");
    REQUIRE(stage.run("undo 9"));
    CHECK(stage.document.marks() == Marks{});
    CHECK(label_of(*find_command("undo"), stage.document) == "Undo");
    REQUIRE(stage.run("redo 2"));
    CHECK(branches_in_state(stage.document.marks(), BranchState::kHidden) == std::vector<int>{3, 4, 5});
}

TEST_CASE("undo and redo refuse an invalid number of steps, and then change nothing") {
    HistoryStage stage(10);
    REQUIRE(stage.run("select 1\nselect 2\nundo"));
    const auto refusal = [&](std::string_view line) {
        const auto done = stage.run(line);
        REQUIRE_FALSE(done);
        CHECK(stage.document.marks().selection == std::vector<int>{1});
        return done.error().what;
    };
    CHECK(refusal("undo 0") == "undo takes a number of steps");
    CHECK(refusal("undo 1.5") == "undo takes a number of steps");
    CHECK(refusal("undo all") == "undo takes a number of steps");
    CHECK(refusal("undo 1 1") == "undo takes a number of steps");
    CHECK(refusal("undo 2") == "there is only 1 step to undo");
    CHECK(refusal("redo 99999999999") == "redo takes a number of steps");
    CHECK(refusal("redo 7") == "there is only 1 step to redo");
}

TEST_CASE("all changes of one command are one step of undo") {
    Document document;
    document.open(tree_of(10), {});
    const auto select = [&](int id) {
        Marks next = document.marks();
        next.selection = {id};
        document.change(std::move(next));
    };
    document.begin_step();
    select(1);
    document.begin_step(); // a command that uses another
    select(2);
    document.end_step("inner");
    select(3);
    document.end_step("outer");
    CHECK(document.step_count() == 1);
    CHECK(document.step_name(0) == "outer");
    REQUIRE(document.undo());
    CHECK(document.marks().selection.empty());
    REQUIRE(document.redo());
    CHECK(document.marks().selection == std::vector<int>{3});
    document.begin_step();
    document.end_step("nothing");
    CHECK(document.step_count() == 1);
}

TEST_CASE("a document counts the steps since it was saved") {
    Document document;
    document.open(tree_of(10), {});
    CHECK(document.unsaved_changes() == 0);
    const auto hide = [&](int id) {
        Marks next = document.marks();
        set_state(next, std::vector<int>{id}, BranchState::kHidden);
        document.change(std::move(next));
    };
    hide(1);
    hide(2);
    CHECK(document.unsaved_changes() == 2);
    document.mark_saved("/data/plan.ramus.json");
    CHECK(document.file() == "/data/plan.ramus.json");
    CHECK_FALSE(document.modified());
    REQUIRE(document.undo());
    REQUIRE(document.undo());
    CHECK(document.unsaved_changes() == 2);
    hide(3); // and the way back to what was saved is gone
    CHECK(document.unsaved_changes() == 3);
    document.mark_saved(document.file());

    Marks next = document.marks();
    next.selection = {4};
    document.change(std::move(next));
    CHECK(document.modified());
    CHECK_FALSE(document.has_unsaved_work()); // a click is not worth a question
    hide(4);
    CHECK(document.has_unsaved_work());

    document.open(tree_of(10), {});
    document.mark_unsaved(14);
    CHECK(document.unsaved_changes() == 14);
    hide(5);
    CHECK(document.unsaved_changes() == 15);
    document.mark_saved("/data/plan.ramus.json");
    CHECK(document.unsaved_changes() == 0);
}
