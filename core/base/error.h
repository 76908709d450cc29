// Result<T>, the return type of a function that can fail on its input: a value, or an Error that says what is wrong,
// where, and what the user can do. Programmer mistakes assert. Exceptions are for dead ends: no memory, no disk.
#pragma once

#include <string>
#include <tl/expected.hpp>
#include <utility>

namespace ramus {

struct Error {
    std::string what;  // "radius -0.3 is not positive"
    std::string where; // "liver.swc:41"; may be empty
    std::string hint;  // "repair with --repair or edit the file"; may be empty

    // One line for a person: "where: what; hint".
    [[nodiscard]] std::string message() const {
        std::string text = where.empty() ? what : where + ": " + what;
        return hint.empty() ? text : text + "; " + hint;
    }
};

template <class T> using Result = tl::expected<T, Error>;

inline tl::unexpected<Error> fail(std::string what, std::string where = {}, std::string hint = {}) {
    return tl::unexpected<Error>(Error{std::move(what), std::move(where), std::move(hint)});
}

} // namespace ramus

// Evaluates a Result. Declares `name` as a reference to its value, or returns its error from the enclosing function.
#define RAMUS_TRY(name, ...)                                                                                           \
    auto name##_or_error = __VA_ARGS__;                                                                                \
    if (!name##_or_error) return tl::unexpected(std::move(name##_or_error).error());                                   \
    auto& name = *name##_or_error
