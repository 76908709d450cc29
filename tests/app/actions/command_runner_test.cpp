// Commands that have to work before they can finish: at once in scripts, on a thread of their own in a window. Order,
// undo, failure, cancelling. No GL, no window.
#include "app/actions/command_runner.h"
#include "app/assets/assets.h"
#include "core/io/meshes/mesh_file.h"
#include "tests/support/command_stage.h"
#include "tests/support/grown_tree.h"
#include "tests/support/icosphere.h"
#include "tests/support/temporary_folder.h"

#include <atomic>
#include <chrono>
#include <doctest/doctest.h>
#include <stdexcept>
#include <thread>

using namespace ramus;
using namespace ramus::app;

namespace {

tree::VesselTree twigs() {
    auto tree = test::grown_tree(20);
    REQUIRE(tree);
    return std::move(*tree);
}

// Selects the branch of its preset once its work is done, which waits until the gate is open.
struct Gate {
    std::atomic<bool> open{false};
    std::atomic<int> begun{0};
    void wait(Job& job) {
        ++begun;
        while (!open && !job.cancelled()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    [[nodiscard]] Command select_slowly(int branch) {
        const auto add = [branch](ActionContext& then) -> Result<void> {
            Marks next = then.document.marks();
            next.selection.push_back(branch);
            then.document.change(std::move(next));
            return {};
        };
        const auto work = [this, add](Job& job) -> Result<Continuation> {
            wait(job);
            return add;
        };
        const std::string id = std::to_string(branch);
        const auto action = [=](ActionContext&, Arguments) -> Result<Outcome> {
            return Pending{"Thinking of " + id, work};
        };
        return Command("select-slowly", "", "", action).giving({id});
    }
};

std::vector<std::string> settle(CommandRunner& runner, ActionContext& context) { // what failed
    std::vector<std::string> failed;
    for (int i = 0; i < 5000 && (runner.busy() || runner.awaits()); ++i) {
        for (const Error& error : runner.update(context)) failed.push_back(error.message());
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    CHECK_FALSE(runner.busy());
    return failed;
}

std::string sphere_file(const TemporaryFolder& folder, const std::string& name) {
    auto mesh = test::icosphere(2, {0, 0, 0}, 3.0);
    mesh.radii.resize(mesh.positions.size(), 1.0F);
    mesh.branches.resize(mesh.positions.size(), 0);
    const auto file = folder.path() / name;
    REQUIRE(io::write_mesh(mesh, file));
    return file.string();
}

} // namespace

TEST_CASE("a pending command changes nothing until its work is done, and then is one step of undo") {
    test::CommandStage stage(twigs());
    Gate gate;
    CommandRunner runner({});
    const Command slow = gate.select_slowly(3);
    REQUIRE(runner.run(stage.context, slow));
    CHECK(runner.busy());
    CHECK(runner.activity() == "Thinking of 3");
    CHECK(runner.update(stage.context).empty());
    CHECK(stage.marks().selection.empty());
    CHECK(stage.document.step_count() == 0);
    // What needs no work does not wait for it.
    REQUIRE(runner.run(stage.context, std::vector<std::string>{"lesion", "0,0,0,3"}));
    CHECK(stage.document.step_count() == 1);
    gate.open = true;
    CHECK(settle(runner, stage.context).empty());
    CHECK(stage.marks().selection == std::vector<int>{3});
    REQUIRE(stage.document.step_count() == 2);
    CHECK(stage.document.step_name(1) == "select slowly: branch 3");
    REQUIRE(stage.document.undo());
    CHECK(stage.marks().selection.empty());
    CHECK(stage.marks().lesions.size() == 1);
}

TEST_CASE("pending commands finish in the order in which they came, one at a time") {
    test::CommandStage stage(twigs());
    Gate gate;
    CommandRunner runner({});
    const std::vector<Command> commands{gate.select_slowly(2), gate.select_slowly(4), gate.select_slowly(7)};
    for (const Command& command : commands) REQUIRE(runner.run(stage.context, command));
    while (gate.begun == 0) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    CHECK(gate.begun == 1);
    gate.open = true;
    CHECK(settle(runner, stage.context).empty());
    CHECK(gate.begun == 3);
    CHECK(stage.marks().selection == std::vector<int>{2, 4, 7});
    CHECK(stage.document.step_count() == 3);
}

TEST_CASE("a command that fails in its work, in its continuation or by an exception does not change the document") {
    test::CommandStage stage(twigs());
    Gate gate;
    gate.open = true;
    CommandRunner runner({});
    const auto failing = [](const std::function<Result<Continuation>(Job&)>& work) {
        const auto action = [work](ActionContext&, Arguments) -> Result<Outcome> { return Pending{"Trying", work}; };
        return Command("try", "", "", action);
    };
    const Command in_work = failing([](Job&) -> Result<Continuation> { return fail("the file is empty"); });
    const Command after = failing([](Job&) -> Result<Continuation> {
        return [](ActionContext&) -> Result<void> { return fail("it is there already"); };
    });
    const Command thrown = failing([](Job&) -> Result<Continuation> { throw std::runtime_error("it broke"); });
    const Command good = gate.select_slowly(1);
    for (const Command* command : {&in_work, &after, &thrown, &good}) REQUIRE(runner.run(stage.context, *command));
    const auto failed = settle(runner, stage.context);
    REQUIRE(failed.size() == 3);
    CHECK(failed[0] == "the file is empty");
    CHECK(failed[1] == "it is there already");
    CHECK(failed[2].find("it broke") != std::string::npos);
    CHECK(stage.marks().selection == std::vector<int>{1}); // those behind it go on
    CHECK(stage.document.step_count() == 1);
    CHECK_FALSE(run_entry(stage.context, in_work));
    CHECK_FALSE(run_entry(stage.context, after));
    CHECK(stage.document.step_count() == 1);
}

TEST_CASE("cancelled commands have no effect, and later commands run") {
    test::CommandStage stage(twigs());
    Gate gate;
    CommandRunner runner({});
    const Command first = gate.select_slowly(2), second = gate.select_slowly(4), third = gate.select_slowly(6);
    REQUIRE(runner.run(stage.context, first));
    REQUIRE(runner.run(stage.context, second));
    runner.cancel();
    CHECK_FALSE(runner.busy());
    CHECK(runner.activity().empty());
    gate.open = true;
    REQUIRE(runner.run(stage.context, third));
    CHECK(settle(runner, stage.context).empty());
    CHECK(stage.marks().selection == std::vector<int>{6});
    CHECK(stage.document.step_count() == 1);
}

TEST_CASE("commands on a tree have no effect on the next tree that is opened; commands on that tree have") {
    test::CommandStage stage(twigs());
    Gate gate;
    CommandRunner runner({});
    const Command of_first = gate.select_slowly(2), of_next = gate.select_slowly(4);
    REQUIRE(runner.run(stage.context, of_first));
    stage.document.open(std::make_shared<const tree::VesselTree>(twigs()), {});
    REQUIRE(runner.run(stage.context, of_next));
    CHECK(runner.update(stage.context).empty());
    gate.open = true;
    CHECK(settle(runner, stage.context).empty());
    CHECK(stage.marks().selection == std::vector<int>{4});
}

namespace {

// What is asked of a picture, and known once it is said to be.
struct Asked {
    bool known = false;
    int taken = 0;
    [[nodiscard]] Awaited select(int branch) {
        const auto then = [this, branch](ActionContext& with) -> Result<void> {
            ++taken;
            Marks next = with.document.marks();
            next.selection = {branch};
            with.document.change(std::move(next));
            return {};
        };
        return {[this] { return known; }, then};
    }
};

} // namespace

TEST_CASE("commands that follow a click take effect after it, even if the picked branch is known late") {
    test::CommandStage stage(twigs());
    CommandRunner runner({});
    Asked first, second;
    const auto run = [&](const std::string& name) {
        REQUIRE(runner.run(stage.context, std::vector<std::string>{name}));
    };
    REQUIRE(runner.await(stage.context, first.select(3)));
    run("hide");
    REQUIRE(runner.await(stage.context, second.select(5)));
    run("highlight");
    second.known = true; // no sooner than the first
    CHECK(runner.update(stage.context).empty());
    CHECK(runner.awaits());
    CHECK(stage.document.step_count() == 0);
    first.known = true;
    CHECK(runner.update(stage.context).empty());
    CHECK_FALSE(runner.awaits());
    CHECK(stage.marks().selection == std::vector<int>{5});
    CHECK(branches_in_state(stage.marks(), tree::BranchState::kHidden) == std::vector<int>{3});
    CHECK(branches_in_state(stage.marks(), tree::BranchState::kHighlighted) == std::vector<int>{5});
    // What is known is not put off, nor what is run then.
    REQUIRE(runner.await(stage.context, first.select(7)));
    CHECK(first.taken == 2);
    run("hide");
    CHECK(branches_in_state(stage.marks(), tree::BranchState::kHidden) == std::vector<int>{3, 7});
}

TEST_CASE("commands that a click causes run before commands that wait for the click, and refusals are reported") {
    test::CommandStage stage(twigs());
    CommandRunner runner({});
    Asked click, found;
    const Command look("look", "", "", [&](ActionContext&, Arguments) -> Result<Outcome> { return found.select(4); });
    Awaited then = click.select(2);
    then.then = [&](ActionContext& with) { return runner.run(with, look); };
    REQUIRE(runner.await(stage.context, then));
    REQUIRE(runner.run(stage.context, std::vector<std::string>{"hide"}));
    REQUIRE(runner.run(stage.context, std::vector<std::string>{"set-radius", "no number"}));
    click.known = true;
    CHECK(runner.update(stage.context).empty());
    CHECK(runner.awaits()); // for what the look finds
    CHECK(stage.document.step_count() == 0);
    found.known = true;
    CHECK(runner.update(stage.context).size() == 1);
    CHECK(branches_in_state(stage.marks(), tree::BranchState::kHidden) == std::vector<int>{4});
    CHECK(stage.document.step_name(0) == "look branch 4");
}

TEST_CASE("input after a click is handled in order, together with the commands that it causes, for any tree") {
    test::CommandStage stage(twigs());
    CommandRunner runner({});
    Asked first, second;
    std::vector<std::string> done;
    const auto note = [&](const std::string& what) {
        runner.run_after_awaited(stage.context, [&done, what] { done.push_back(what); });
    };
    note("at once");
    CHECK(done == std::vector<std::string>{"at once"});
    done.clear();
    REQUIRE(runner.await(stage.context, first.select(2)));
    note("key");
    runner.run_after_awaited(stage.context, [&] {
        done.emplace_back("click");
        REQUIRE(runner.await(stage.context, second.select(4)));
    });
    note("wheel");
    CHECK(done.empty());
    first.known = true;
    CHECK(runner.update(stage.context).empty());
    CHECK(done == std::vector<std::string>{"key", "click"}); // the wheel waits for what the second click is on
    CHECK(stage.marks().selection == std::vector<int>{2});
    stage.document.open(std::make_shared<const tree::VesselTree>(twigs()), {});
    second.known = true;
    CHECK(runner.update(stage.context).empty());
    CHECK(second.taken == 0);
    CHECK(done.back() == "wheel");
    CHECK_FALSE(runner.awaits());
}

TEST_CASE("commands that follow brief work wait for it, and a refusal of that work changes nothing") {
    test::CommandStage stage(twigs());
    Gate gate;
    CommandRunner runner({});
    enum class Ends { kWell, kRefused, kByException };
    const auto edit = [&](Ends ends) {
        const auto work = [&gate, ends]() -> Result<Continuation> {
            Job job;
            gate.wait(job);
            if (ends == Ends::kByException) throw std::runtime_error("it is too dark");
            if (ends == Ends::kRefused) return fail("it is too late");
            return [](ActionContext& then) -> Result<void> {
                return then.document.edit_tree({tree::Edit::Kind::kScale, {2}, {}, 0.5});
            };
        };
        return Command("edit-slowly", "", "",
                       [work](ActionContext&, Arguments) -> Result<Outcome> { return Brief{work}; });
    };
    const Command well = edit(Ends::kWell), refused = edit(Ends::kRefused), thrown = edit(Ends::kByException);
    const auto before = stage.document.tree();
    for (const Command* command : {&well, &refused, &thrown}) REQUIRE(runner.run(stage.context, *command));
    REQUIRE(runner.run(stage.context, std::vector<std::string>{"undo"})); // of the first
    REQUIRE(runner.run(stage.context, std::vector<std::string>{"select-invert"}));
    while (gate.begun == 0) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    CHECK(runner.update(stage.context).empty());
    CHECK(runner.awaits());
    CHECK(gate.begun == 1);
    CHECK(stage.document.step_count() == 0);
    gate.open = true;
    const std::vector<std::string> failed = settle(runner, stage.context);
    CHECK_FALSE(runner.awaits());
    REQUIRE(failed.size() == 2);
    CHECK(failed[0].find("it is too late") != std::string::npos);
    CHECK(failed[1].find("it is too dark") != std::string::npos);
    CHECK(gate.begun == 3);
    CHECK(stage.document.tree() == before);
    CHECK(stage.document.can_redo()); // selecting came after it, and forgets nothing
    CHECK(stage.marks().selection.size() == before->branches.size());
    // At once in scripts.
    REQUIRE(run_entry(stage.context, well));
    CHECK(stage.document.tree() != before);
    CHECK(run_entry(stage.context, refused).error().message().find("too late") != std::string::npos);
}

TEST_CASE("brief work on one tree does nothing to the next") {
    test::CommandStage stage(twigs());
    CommandRunner runner({});
    REQUIRE(runner.run(stage.context, std::vector<std::string>{"disconnect", "2"}));
    REQUIRE(runner.awaits());
    const auto next = std::make_shared<const tree::VesselTree>(twigs());
    stage.document.open(next, {});
    CHECK(settle(runner, stage.context).empty());
    CHECK(stage.document.tree() == next);
    CHECK(stage.document.step_count() == 0);
}

TEST_CASE("a command that names branches and has waited while the tree was edited is refused") {
    test::CommandStage stage(twigs());
    CommandRunner runner({});
    Asked click;
    Awaited edits = click.select(2);
    edits.then = [&](ActionContext& with) { return runner.run(with, std::vector<std::string>{"disconnect", "2"}); };
    REQUIRE(runner.await(stage.context, edits));
    REQUIRE(runner.run(stage.context, std::vector<std::string>{"select", "4"}));
    REQUIRE(runner.run(stage.context, std::vector<std::string>{"select-invert"}));
    const auto before = stage.document.tree();
    click.known = true;
    const std::vector<std::string> failed = settle(runner, stage.context);
    REQUIRE(stage.document.tree() != before);
    REQUIRE(failed.size() == 1);
    CHECK(failed.front().find("edited meanwhile") != std::string::npos);
    CHECK(stage.marks().selection.size() == static_cast<std::size_t>(stage.document.branch_count())); // names none
}

TEST_CASE("a click on one tree selects nothing of the next") {
    test::CommandStage stage(twigs());
    CommandRunner runner({});
    Asked click;
    REQUIRE(runner.await(stage.context, click.select(2)));
    stage.document.open(std::make_shared<const tree::VesselTree>(twigs()), {});
    click.known = true;
    CHECK(runner.update(stage.context).empty());
    CHECK_FALSE(runner.awaits());
    CHECK(click.taken == 0);
}

TEST_CASE("a script waits until a pending command is done") {
    test::CommandStage stage(twigs());
    Asked found;
    const Command look("look", "", "", [&](ActionContext&, Arguments) -> Result<Outcome> { return found.select(4); });
    REQUIRE(run_entry(stage.context, look));
    CHECK(stage.marks().selection == std::vector<int>{4});
}

TEST_CASE("the next line of a script sees the files that the previous line read") {
    const TemporaryFolder folder;
    const std::string ball = sphere_file(folder, "ball.stl"), other = sphere_file(folder, "other.ply");
    test::CommandStage stage(twigs());
    stage.good("lesion-mesh " + ball + "\nlesion-mesh " + other + "\nlesion-remove 1\ncontext " + ball);
    CHECK(lesion_files(stage.marks()) == std::vector<std::string>{other});
    REQUIRE(stage.marks().context.size() == 1);
    REQUIRE(stage.document.step_count() == 4);
    CHECK(stage.document.step_name(0).starts_with("lesion mesh"));
    CHECK(stage.said.starts_with("ball.stl: "));
    CHECK(stage.assets.context_shape({ball, 0, false}) != nullptr); // what was read is there for the picture
    CHECK(stage.assets.lesion_mesh({.file = other}) != nullptr);
    CHECK(stage.bad("context " + ball).find("shown already") != std::string::npos);
    CHECK(stage.bad("lesion-mesh " + other).find("there already") != std::string::npos);
}

TEST_CASE("a file that is added twice is stored once") {
    const TemporaryFolder folder;
    const std::string ball = sphere_file(folder, "ball.stl");
    test::CommandStage stage(twigs());
    CommandRunner runner({});
    for (const char* command : {"lesion-mesh", "lesion-mesh", "context", "context"})
        REQUIRE(runner.run(stage.context, std::vector<std::string>{command, ball}));
    CHECK(settle(runner, stage.context).size() == 2);
    CHECK(lesion_files(stage.marks()).size() == 1);
    CHECK(stage.marks().context.size() == 1);
    CHECK(stage.document.step_count() == 2);
    // What can be told before the work is.
    CHECK_FALSE(runner.run(stage.context, std::vector<std::string>{"context", ball}));
    CHECK_FALSE(runner.run(stage.context, std::vector<std::string>{"context", "notes.txt"}));
    CHECK_FALSE(runner.run(stage.context, std::vector<std::string>{"no-such-command"}));
    CHECK_FALSE(runner.busy());
}

TEST_CASE("files that are being written, or wait to be written, are known") {
    const TemporaryFolder folder;
    test::CommandStage stage(twigs());
    Gate gate;
    const Command slow = gate.select_slowly(3); // the runner refers to it
    CommandRunner runner({});
    REQUIRE(runner.run(stage.context, slow));
    CHECK(runner.writing().empty());
    const std::string file = (folder.path() / "twigs.stl").string();
    REQUIRE(runner.run(stage.context, std::vector<std::string>{"export", "surface", file}));
    CHECK(runner.writing() == "Exporting twigs.stl");
    gate.open = true;
    CHECK(settle(runner, stage.context).empty());
    CHECK(runner.writing().empty());
    CHECK(std::filesystem::exists(file));
}
