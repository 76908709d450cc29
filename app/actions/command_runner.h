// Runs commands. All that a command changes is one step of undo, with a phrase for a name: "hide 12 branches"; one
// that fails or is cancelled changes nothing.
#pragma once

#include "app/actions/command_table.h"
#include "core/base/worker.h"

#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace ramus::app {

// At once: the work of a pending command is done on this thread before the call returns, as scripts want it. `words`
// are those of a line of a commands file, the command's name first.
[[nodiscard]] Result<void> run_command(ActionContext& context, std::span<const std::string> words);
// The same with the arguments that the menu and the keys give. Nothing happens when it is not enabled.
[[nodiscard]] Result<void> run_entry(ActionContext& context, const Command& command);

// For a window, which must not wait: the work of pending commands is done on a thread of its own, in the order in which
// they came, each finished before the next begins. Commands that need no work do not wait for those: a person goes on
// while a file is read. They do wait for what is awaited of the picture, for a click that selects, say, and for brief
// work. What belongs to one tree is dropped when another is opened; a command that has waited while the tree was
// edited, and may name branches by their ids, is refused. For one thread, its owner's.
class CommandRunner {
public:
    // `wake` is called on another thread when update() has something to do.
    explicit CommandRunner(const std::function<void()>& wake) : worker_(wake), brief_worker_(wake) {}

    // Fails with what can be told before the work; what fails later comes from update().
    [[nodiscard]] Result<void> run(ActionContext& context, std::span<const std::string> words);
    [[nodiscard]] Result<void> run(ActionContext& context, const Command& entry);

    // Something else than a command that has to know what the picture shows, such as a click: in its turn with the
    // commands that are run before and after it. At once where it can be.
    [[nodiscard]] Result<void> await(ActionContext& context, Awaited awaited);
    // What a person does after that, a key or a button, whatever comes of it: in its turn, of any tree.
    void after_what_is_awaited(ActionContext& context, std::function<void()> event);
    [[nodiscard]] bool awaits() const { return !turns_.empty(); } // what is run now waits, too

    // Finishes what was awaited and the commands whose work is done, begins the next work, and returns what failed.
    [[nodiscard]] std::vector<Error> update(ActionContext& context);
    void cancel(); // all that is pending

    [[nodiscard]] bool busy() const { return !pending_.empty(); }
    [[nodiscard]] std::string activity() const; // of what is worked on; empty: nothing
    [[nodiscard]] std::string writing() const;  // the activity of what writes a file, worked on or next; empty: nothing
    [[nodiscard]] float progress() const { return worker_.progress(); } // of that, 0 to 1

private:
    struct Waiting {
        const Command* command;
        std::vector<std::string> arguments;
        Pending pending;
        std::shared_ptr<const tree::VesselTree> tree; // that it is about
    };
    // What takes effect in the order in which it came, once something is awaited.
    struct Turn {
        Awaited awaited;                              // without `ready`: nothing is
        std::shared_ptr<const tree::VesselTree> tree; // that it is about, as it was read
        bool of_any_tree = false;
        // Of a command with arguments, which may be ids of branches: the tree that it is about, as it was then.
        std::shared_ptr<const tree::VesselTree> edited{};
    };
    [[nodiscard]] static Turn turn_of(const ActionContext& context, Awaited awaited);
    [[nodiscard]] Result<void> start(ActionContext& context, const Command& command, Arguments arguments);
    [[nodiscard]] Result<void> in_turn(ActionContext& context, Turn turn);
    [[nodiscard]] Result<void> take_turn(ActionContext& context, const Turn& turn);
    using BriefResult = std::shared_ptr<std::optional<Result<Continuation>>>;
    [[nodiscard]] Awaited begin_brief(const Brief& brief);
    void take_turns(ActionContext& context, std::vector<Error>& failed);
    void begin_work();

    std::deque<Turn> turns_;
    std::optional<std::size_t> put_in_;          // while a turn is taken: so many of those that wait came of it
    std::deque<Waiting> pending_;                // the first is worked on
    std::optional<Result<Continuation>> worked_; // what came of its work
    BriefResult brief_;                          // of the work on brief_worker_; null: there was none
    Worker worker_, brief_worker_;               // last: their threads end first
};

} // namespace ramus::app
