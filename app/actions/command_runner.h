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
// while a file is read. What belongs to one tree is dropped when another is opened. For one thread, its owner's.
class CommandRunner {
public:
    // `wake` is called on another thread when update() has something to do.
    explicit CommandRunner(std::function<void()> wake) : worker_(std::move(wake)) {}

    // Fails with what can be told before the work; what fails later comes from update().
    [[nodiscard]] Result<void> run(ActionContext& context, std::span<const std::string> words);
    [[nodiscard]] Result<void> run(ActionContext& context, const Command& entry);

    // Finishes the commands whose work is done, begins the next work, and returns what failed.
    [[nodiscard]] std::vector<Error> update(ActionContext& context);
    void cancel(); // all that is pending

    [[nodiscard]] bool busy() const { return !pending_.empty(); }
    [[nodiscard]] std::string activity() const;                         // of what is worked on; empty: nothing
    [[nodiscard]] float progress() const { return worker_.progress(); } // of that, 0 to 1

private:
    struct Waiting {
        const Command* command;
        std::vector<std::string> arguments;
        Pending pending;
        std::shared_ptr<const tree::VesselTree> tree; // that it is about
    };
    [[nodiscard]] Result<void> start(ActionContext& context, const Command& command, Arguments arguments);
    void begin_work();

    std::deque<Waiting> pending_;                // the first is worked on
    std::optional<Result<Continuation>> worked_; // what came of its work
    Worker worker_;                              // last: its thread ends first
};

} // namespace ramus::app
