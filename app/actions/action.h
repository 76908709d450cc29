// What a command does. An action works on the document, its assets and the hosts of its context. It checks its
// arguments before it changes anything: one that fails leaves the document as it was.
//
// An action that has to read or compute something slow first changes nothing and returns a Pending: `work` runs on any
// thread and touches neither document nor hosts; the continuation that it returns does the rest on the document's
// thread, for the document as it is by then, and may fail like an action.
//
// One that first has to know what the picture shows, which is drawn elsewhere, returns an Awaited: that is soon known,
// and what is run after it waits, so that all takes effect in the order in which it came. One whose work takes longer
// than a frame, and is so soon done that a person sees what comes of it next, returns a Brief: its work is that of a
// Pending, and what is run after it waits, too.
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

// Roles that nobody fills are null.
struct ActionContext {
    Document& document;
    PictureHost& picture;
    Assets& assets; // of the document; refreshed before they are read
    FileHost* files = nullptr;
    WindowHost* window = nullptr;
    Clipboard* clipboard = nullptr;
    ToolHost* tools = nullptr;
    std::function<void(const std::string&)> tell{}; // empty: nobody listens

    // What a command did, in a sentence, where it cannot be seen in the picture.
    void say(const std::string& sentence) const {
        if (tell) tell(document.lengths().worded(sentence));
    }
};

using Arguments = std::span<const std::string>;

using Continuation = std::function<Result<void>(ActionContext&)>;
struct Pending {
    std::string activity; // for people, while it goes on: "Reading liver.nii"
    std::function<Result<Continuation>(Job&)> work;
    bool writes = false; // a file that a person waits for: whoever quits meanwhile is asked
};
struct Awaited {
    std::function<bool()> ready; // does not wait; when it is true `then` does not, either
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

// A function that takes (ActionContext&, Arguments) and returns Result<void> or Result<Outcome>.
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
