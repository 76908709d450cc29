// Numbers and words of text files, read alike whatever the locale is, and what messages show of them.
#pragma once

#include "core/base/error.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace ramus::io {

// With a decimal point, a plus or not, an exponent or not; "nan" and "inf" too. Numbers too large are infinite, too
// small 0. None: anything is left over.
[[nodiscard]] std::optional<double> to_real(std::string_view text);

// Whole numbers, though some programs write them with a decimal point. None: it is none, or beyond 9e15.
[[nodiscard]] std::optional<std::int64_t> to_whole(std::string_view text);

// Whether a spreadsheet would work it out: it begins with a sign of a formula, and is neither a number nor a sign
// alone.
[[nodiscard]] bool begins_formula(std::string_view text);

// In quotes, without what a terminal would take for orders, and not too much of it.
[[nodiscard]] std::string shown(std::string_view text);

// Without blanks at both ends.
[[nodiscard]] std::string_view trimmed(std::string_view text);

// The shortest that reads back exactly.
[[nodiscard]] std::string exact_number(double value);

// In small letters, as far as ASCII has them.
[[nodiscard]] std::string lower_case(std::string_view text);

// Of four digits at most, for people.
[[nodiscard]] std::string short_number(double value);

[[nodiscard]] std::size_t line_at(std::string_view text, std::size_t offset); // from 1

// "3 points", "1 point".
[[nodiscard]] std::string counted(std::size_t count, std::string_view noun);

// Goes through the words of a text that stand between blanks, and knows the line where it is. Keeps no copy of the
// text.
class WordScanner {
public:
    WordScanner(std::string_view text, const std::string& name) : text_(text), name_(name) {}

    [[nodiscard]] std::string_view next();       // empty: there is none
    [[nodiscard]] std::string_view peek() const; // the next one, not taken
    [[nodiscard]] std::string_view line();       // what is left of this line, and goes on to the next
    // So many bytes from here on; fails if there are less.
    [[nodiscard]] Result<std::string_view> bytes(std::uint64_t count);

    // The next word, there or as a number; `what` says in messages what it should be: "the radius".
    [[nodiscard]] Result<std::string_view> needed(std::string_view what);
    [[nodiscard]] Result<double> real(std::string_view what);
    [[nodiscard]] Result<std::int64_t> whole(std::string_view what);
    // One that is not negative, and for which each thing that it counts can still have a byte.
    [[nodiscard]] Result<std::size_t> count(std::string_view what);

    [[nodiscard]] std::size_t line_number() const { return line_; } // of the word last taken
    [[nodiscard]] std::string place() const { return name_ + ":" + std::to_string(line_); }
    [[nodiscard]] std::size_t left() const { return text_.size() - at_; }

private:
    std::string_view text_;
    const std::string& name_;
    std::size_t at_ = 0, line_ = 1;
};

} // namespace ramus::io
