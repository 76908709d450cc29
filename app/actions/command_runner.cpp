#include "app/actions/command_runner.h"

#include "app/actions/command_table.h"
#include "app/session/marks_change.h"
#include "app/session/numbers.h"
#include "core/base/closest_word.h"
#include "core/base/words.h"

#include <algorithm>
#include <string>
#include <utility>

namespace ramus::app {

namespace {

std::string branches_phrase(const std::vector<int>& branches, const Marks& marks) {
    if (branches.size() != 1) return grouped(branches.size()) + " branches";
    const auto name = marks.names.find(branches.front());
    return name == marks.names.end() ? "branch " + std::to_string(branches.front()) : shortened(name->second);
}

// The name of a step of the history, from the command that made it: "hide 12 branches", "lasso 3 branches", "surface
// detail 24". The menu puts "Undo" or "Redo" in front. `after`: the marks after `change`.
std::string phrase_of(const Command& command, Arguments arguments, const MarksChange& change, const Marks& after) {
    constexpr std::string_view kOfAnyKind = "object-"; // "hide lesion 2"
    std::string words = command.name;
    if (words.starts_with(kOfAnyKind)) words.erase(0, kOfAnyKind.size());
    std::ranges::replace(words, '-', ' ');
    const std::vector<int> restated = change.restated();
    if (!change.edits_tree() && (!restated.empty() || (change.selects() && !after.selection.empty()))) {
        // "hide 12 branches", but "select dependents: 12 branches".
        const std::string who = branches_phrase(restated.empty() ? after.selection : restated, after);
        return words + (words.find(' ') == std::string::npos ? " " : ": ") + who;
    }
    if (change.selects() && !change.edits_tree()) return "select none";
    std::string given;
    for (const std::string& argument : arguments) given += " " + argument;
    std::ranges::replace(given, '\n', ' ');
    return words + shortened(given);
}

// Makes the changes of `change` to the document one step of undo, named after the command.
template <class Change>
auto as_step(ActionContext& context, const Command& command, Arguments arguments, const Change& change) {
    Document& document = context.document;
    document.begin_step();
    auto result = change();
    const MarksChange* changed = document.last_change();
    document.end_step(changed == nullptr ? "" : phrase_of(command, arguments, *changed, document.marks()));
    return result;
}

Result<Outcome> act(ActionContext& context, const Command& command, Arguments arguments) {
    return as_step(context, command, arguments, [&] { return command.action(context, arguments); });
}

Result<void> finish(ActionContext& context, const Command& command, Arguments arguments,
                    const Result<Continuation>& worked) {
    if (!worked) return tl::unexpected(worked.error());
    return as_step(context, command, arguments, [&] { return (*worked)(context); });
}

Result<void> run_at_once(ActionContext& context, const Command& command, Arguments arguments) {
    RAMUS_TRY(outcome, act(context, command, arguments));
    if (const auto* awaited = std::get_if<Awaited>(&outcome)) return finish(context, command, arguments, awaited->then);
    if (const auto* brief = std::get_if<Brief>(&outcome)) return finish(context, command, arguments, brief->work());
    const auto* pending = std::get_if<Pending>(&outcome);
    if (pending == nullptr) return {};
    Job job;
    return finish(context, command, arguments, pending->work(job));
}

Result<const Command*> command_of(std::span<const std::string> words) {
    const Command* command = find_command(words[0]);
    if (command == nullptr) {
        std::vector<std::string> names;
        for (const Command& each : command_table()) names.push_back(each.name);
        const std::string closest = closest_word(words[0], names);
        return fail("there is no command \"" + words[0] + "\"", {},
                    closest.empty() ? "F1 in the window lists them" : "did you mean " + closest + "?");
    }
    if (command->arguments.empty() && words.size() > 1) return fail(command->name + " takes no arguments");
    return command;
}

// The error for work that ended by an exception.
tl::unexpected<Error> given_up(const std::string& why, const std::string& activity) {
    return fail("the work was given up: " + why, activity,
                why == "std::bad_alloc" ? "there is not enough memory for it" : "");
}

bool enabled(const ActionContext& context, const Command& command) {
    return command.enabled == nullptr || command.enabled(context.document);
}

} // namespace

Result<void> run_command(ActionContext& context, std::span<const std::string> words) {
    if (words.empty()) return {};
    const auto command = command_of(words);
    return command ? run_at_once(context, **command, words.subspan(1)) : tl::unexpected(command.error());
}

Result<void> run_entry(ActionContext& context, const Command& command) {
    return enabled(context, command) ? run_at_once(context, command, command.preset) : Result<void>{};
}

Result<void> CommandRunner::run(ActionContext& context, std::span<const std::string> words) {
    if (words.empty()) return {};
    RAMUS_TRY(command, command_of(words));
    const auto run_it = [this, command = command, given = std::vector(words.begin() + 1, words.end())](
                            ActionContext& with) { return start(with, *command, given); };
    Turn turn = turn_of(context, {.ready = nullptr, .then = run_it});
    if (words.size() > 1) turn.edited = context.document.tree();
    return in_turn(context, std::move(turn));
}

// Checks whether the command is enabled when its turn comes.
Result<void> CommandRunner::run(ActionContext& context, const Command& entry) {
    const auto run_it = [this, &entry](ActionContext& with) {
        return enabled(with, entry) ? start(with, entry, entry.preset) : Result<void>{};
    };
    return in_turn(context, turn_of(context, {.ready = nullptr, .then = run_it}));
}

Result<void> CommandRunner::await(ActionContext& context, Awaited awaited) {
    return in_turn(context, turn_of(context, std::move(awaited)));
}

void CommandRunner::run_after_awaited(ActionContext& context, std::function<void()> event) {
    if (!awaits()) return event();
    const auto act = [event = std::move(event)](ActionContext&) -> Result<void> {
        event();
        return {};
    };
    Turn turn = turn_of(context, {.ready = nullptr, .then = act});
    turn.of_any_tree = true;
    (void)in_turn(context, std::move(turn));
}

CommandRunner::Turn CommandRunner::turn_of(const ActionContext& context, Awaited awaited) {
    return {std::move(awaited), context.document.base_tree()};
}

// Turns queued while a turn is taken precede the waiting ones.
Result<void> CommandRunner::in_turn(ActionContext& context, Turn turn) {
    const bool first = put_in_ ? *put_in_ == 0 : turns_.empty();
    const bool ready = turn.awaited.ready == nullptr || turn.awaited.ready();
    if (first && ready) return take_turn(context, turn);
    const std::size_t at = put_in_ ? (*put_in_)++ : turns_.size();
    turns_.insert(turns_.begin() + static_cast<std::ptrdiff_t>(at), std::move(turn));
    return {};
}

Result<void> CommandRunner::take_turn(ActionContext& context, const Turn& turn) {
    const bool outermost = !put_in_;
    if (outermost) put_in_ = 0;
    auto done = turn.awaited.then(context);
    if (outermost) put_in_.reset();
    return done;
}

void CommandRunner::take_turns(ActionContext& context, std::vector<Error>& failed) {
    while (!turns_.empty() && (turns_.front().awaited.ready == nullptr || turns_.front().awaited.ready())) {
        const Turn turn = std::move(turns_.front());
        turns_.pop_front();
        if (!turn.of_any_tree && turn.tree != context.document.base_tree()) continue;
        if (turn.edited && turn.edited != context.document.tree()) {
            failed.push_back({"the tree was edited meanwhile, and its branches have other numbers", {}, "do it again"});
            continue;
        }
        if (const auto done = take_turn(context, turn); !done) failed.push_back(done.error());
    }
}

Result<void> CommandRunner::start(ActionContext& context, const Command& command, Arguments arguments) {
    RAMUS_TRY(outcome, act(context, command, arguments));
    if (const auto* brief = std::get_if<Brief>(&outcome)) outcome = begin_brief(*brief);
    if (auto* awaited = std::get_if<Awaited>(&outcome)) {
        const auto then = [&command, given = std::vector(arguments.begin(), arguments.end()),
                           then = std::move(awaited->then)](ActionContext& with) {
            return finish(with, command, given, then);
        };
        return in_turn(context, turn_of(context, {.ready = std::move(awaited->ready), .then = then}));
    }
    auto* pending = std::get_if<Pending>(&outcome);
    if (pending == nullptr) return {};
    pending_.push_back(
        {&command, {arguments.begin(), arguments.end()}, std::move(*pending), context.document.base_tree()});
    if (pending_.size() == 1) begin_work();
    return {};
}

// One at a time: later commands wait, and do not begin another.
Awaited CommandRunner::begin_brief(const Brief& brief) {
    const auto result = brief_ = std::make_shared<std::optional<Result<Continuation>>>();
    brief_worker_.start("Editing", [result, work = brief.work](Job&, const Worker::Post& post) {
        const auto worked = work();
        post([result, worked] { *result = worked; });
    });
    const auto then = [result](ActionContext& context) -> Result<void> {
        return **result ? (***result)(context) : tl::unexpected((*result)->error());
    };
    return {.ready = [result] { return result->has_value(); }, .then = then};
}

void CommandRunner::begin_work() {
    const Pending& pending = pending_.front().pending;
    worker_.start(pending.activity, [this, work = pending.work](Job& job, const Worker::Post& post) {
        const auto worked = work(job);
        post([this, worked] { worked_ = worked; });
    });
}

std::vector<Error> CommandRunner::update(ActionContext& context) {
    std::vector<Error> failed;
    brief_worker_.drain();
    if (const std::string why = brief_worker_.take_failure(); !why.empty()) *brief_ = given_up(why, {});
    take_turns(context, failed);
    worker_.drain();
    if (const std::string why = worker_.take_failure(); !why.empty() && !pending_.empty())
        worked_ = given_up(why, pending_.front().pending.activity);
    const auto outdated = [&](const Waiting& waiting) { return waiting.tree != context.document.base_tree(); };
    if (!pending_.empty() && outdated(pending_.front())) {
        worker_.cancel();
        worked_.reset();
        std::erase_if(pending_, outdated);
        if (!pending_.empty()) begin_work();
    }
    if (worked_) {
        const auto worked = *std::exchange(worked_, std::nullopt);
        const Waiting done = std::move(pending_.front());
        pending_.pop_front();
        if (const auto finished = finish(context, *done.command, done.arguments, worked); !finished)
            failed.push_back(finished.error());
        if (!pending_.empty()) begin_work();
    }
    return failed;
}

void CommandRunner::cancel() {
    worker_.cancel();
    worked_.reset();
    pending_.clear();
}

std::string CommandRunner::activity() const { return busy() ? pending_.front().pending.activity : std::string(); }

std::string CommandRunner::writing() const {
    const auto writer = std::ranges::find_if(pending_, [](const Waiting& one) { return one.pending.writes; });
    return writer == pending_.end() ? std::string() : writer->pending.activity;
}

} // namespace ramus::app
