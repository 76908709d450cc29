// Runs commands. All changes of a command form one step of undo with a descriptive name: "hide 12 branches". A command
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

// Runs a command synchronously, including the work of a pending command; for scripts. `words`: a line of a commands
// file, the command's name first.
[[nodiscard]] Result<void> run_command(ActionContext& context, std::span<const std::string> words);
// The same for an entry of the menu or a key, with its preset arguments. Does nothing if the entry is not enabled.
[[nodiscard]] Result<void> run_entry(ActionContext& context, const Command& command);

// CommandRunner: runs commands asynchronously, for a window. The work of pending commands runs on a worker thread, one
// after the other in order of arrival. Commands without work do not wait for it: a person can continue while a file is
// read. Commands wait for awaited answers of the picture (for example a click that selects) and for brief work. Opening
// another tree drops the work for the old one. A command that waited while the tree was edited, and that may name
// branches by id, is refused. All calls must come from one thread, the owner's.
class CommandRunner {
public:
    // `wake`: called on another thread when update() has something to do. It must be thread-safe.
    explicit CommandRunner(const std::function<void()>& wake) : worker_(wake), brief_worker_(wake) {}

    // Returns errors that occur before the work; update() returns later ones.
    [[nodiscard]] Result<void> run(ActionContext& context, std::span<const std::string> words);
    [[nodiscard]] Result<void> run(ActionContext& context, const Command& entry);

    // Runs something other than a command that depends on what the picture shows, such as a click, in order with the
    // commands before and after it; at once if possible.
    [[nodiscard]] Result<void> await(ActionContext& context, Awaited awaited);
    // Runs the event after everything awaited, whatever the result, and even if another tree was opened meanwhile.
    void run_after_awaited(ActionContext& context, std::function<void()> event);
    [[nodiscard]] bool awaits() const { return !turns_.empty(); } // new commands will wait

    // Finishes awaited commands and commands whose work is done, starts the next work, and returns the errors.
    [[nodiscard]] std::vector<Error> update(ActionContext& context);
    void cancel(); // all pending commands

    [[nodiscard]] bool busy() const { return !pending_.empty(); }
    [[nodiscard]] std::string activity() const; // of the running work; empty: none
    [[nodiscard]] std::string writing() const;  // activity of a running or waiting export; empty: none
    [[nodiscard]] float progress() const { return worker_.progress(); } // of the running work, 0 to 1

private:
    struct Waiting {
        const Command* command;
        std::vector<std::string> arguments;
        Pending pending;
        std::shared_ptr<const tree::VesselTree> tree; // that it refers to
    };
    // An entry of the queue of things that take effect in order, once something is awaited.
    struct Turn {
        Awaited awaited;                              // without `ready`: awaits nothing
        std::shared_ptr<const tree::VesselTree> tree; // that it refers to, as read from its file
        bool of_any_tree = false;
        // For a command with arguments, which may be branch ids: the edited tree at the time of the command.
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
    std::optional<std::size_t> put_in_;          // while a turn is taken: number of turns it has queued
    std::deque<Waiting> pending_;                // the first is running
    std::optional<Result<Continuation>> worked_; // the result of its work
    BriefResult brief_;                          // of the work on brief_worker_; null: none
    Worker worker_, brief_worker_;               // last: their threads end first
};

} // namespace ramus::app
