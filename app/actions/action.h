// Action: the function behind a command. It works on the document, its assets and the hosts of its context. It checks
// its arguments before it changes anything: a failed action leaves the document unchanged. An action returns one of:
// - Done.
// - Pending: it must first read or compute something slow. `work` runs on any thread and touches neither document nor
//   hosts. It returns a continuation that finishes the command on the document's thread, for the document's state by
//   then, and may fail like an action. Later commands that need no work do not wait.
// - Awaited: it must first know what the picture shows, which another thread draws. Later commands wait, so that all
//   take effect in order.
// - Brief: its work takes longer than a frame, but is so short that a person expects the result before the next
//   command. Work as for Pending; later commands wait.
//
// app/actions/command_runner.h runs all of them.
#pragma once

#include "app/actions/hosts.h"
#include "app/session/document.h"
#include "core/base/error.h"
#include "core/base/job.h"

#include <concepts>
#include <functional>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>

namespace ramus::app {

struct Assets; // app/assets/assets.h

// The surroundings of an action. Missing roles are null.
struct ActionContext {
    Document& document;
    PictureHost& picture;
    Assets& assets; // of the document; refresh them before reading
    FileHost* files = nullptr;
    WindowHost* window = nullptr;
    Clipboard* clipboard = nullptr;
    ToolHost* tools = nullptr;
    std::function<void(const std::string&)> tell{}; // empty: no output

    // Reports in a sentence what a command did, if that is not visible in the picture.
    void say(const std::string& sentence) const {
        if (tell) tell(document.lengths().worded(sentence));
    }
};

using Arguments = std::span<const std::string>;

using Continuation = std::function<Result<void>(ActionContext&)>;
struct Pending {
    std::string activity; // shown while it runs: "Reading liver.nii"
    std::function<Result<Continuation>(Job&)> work;
    bool writes = false; // writes a file: quitting meanwhile asks for confirmation
};
struct Awaited {
    std::function<bool()> ready; // does not block; once true, `then` does not block, either
    Continuation then;
};
struct Brief {
    std::function<Result<Continuation>()> work;
};
struct Done {};
using Outcome = std::variant<Done, Pending, Awaited, Brief>;
[[nodiscard]] inline Result<Outcome> outcome_of(Result<void> result) {
    if (!result) return tl::unexpected(std::move(result.error()));
    return Done{};
}

// Wraps a function that takes (ActionContext&, Arguments) and returns Result<void> or Result<Outcome>.
class CommandAction {
public:
    CommandAction() = default;
    template <std::invocable<ActionContext&, Arguments> Function> CommandAction(Function function) {
        if constexpr (std::is_same_v<std::invoke_result_t<Function, ActionContext&, Arguments>, Result<void>>)
            run_ = [function](ActionContext& context, Arguments arguments) {
                return outcome_of(function(context, arguments));
            };
        else
            run_ = std::move(function);
    }
    explicit operator bool() const { return run_ != nullptr; }
    Result<Outcome> operator()(ActionContext& context, Arguments arguments) const { return run_(context, arguments); }

private:
    std::function<Result<Outcome>(ActionContext&, Arguments)> run_;
};

} // namespace ramus::app
