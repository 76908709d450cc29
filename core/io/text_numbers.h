// Parses numbers and words of text files, independent of the locale, and formats them for messages.
#pragma once

#include "core/base/error.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace ramus::io {

// Parses a number with a decimal point, with or without plus sign and exponent; also "nan" and "inf". A number beyond
// double precision becomes +infinity (also a negative one), or 0 if it is too small. None: the text is no number.
[[nodiscard]] std::optional<double> to_real(std::string_view text);

// Parses a whole number, also with a decimal point or exponent, as some programs write it. None: the text is no whole
// number, or beyond 9e15.
[[nodiscard]] std::optional<std::int64_t> to_whole(std::string_view text);

// Whether a spreadsheet would evaluate the text as a formula: it begins with = + - @, a tab or a line end, and is
// neither a number nor a single character.
[[nodiscard]] bool begins_formula(std::string_view text);

// For messages: the first 24 characters in quotes, with ? for all that are not printable ASCII.
[[nodiscard]] std::string shown(std::string_view text);

// Without blanks at both ends.
[[nodiscard]] std::string_view trimmed(std::string_view text);

// The shortest digits that read back exactly.
[[nodiscard]] std::string exact_number(double value);

// Converts ASCII letters to lower case; others stay.
[[nodiscard]] std::string lower_case(std::string_view text);

// At most four significant digits, for people.
[[nodiscard]] std::string short_number(double value);

[[nodiscard]] std::size_t line_at(std::string_view text, std::size_t offset); // counted from 1; linear in `offset`

// "3 points", "1 point".
[[nodiscard]] std::string counted(std::size_t count, std::string_view noun);

// Iterates over the blank-separated words of a text and keeps the current line for messages. Refers to the text and the
// name, which must outlive it.
class WordScanner {
public:
    WordScanner(std::string_view text, const std::string& name) : text_(text), name_(name) {}

    [[nodiscard]] std::string_view next();       // the next word; empty: end of the text
    [[nodiscard]] std::string_view peek() const; // the next word, without moving on
    [[nodiscard]] std::string_view line();       // the rest of the current line; moves on to the next line
    // The next `count` bytes. Fails if there are fewer.
    [[nodiscard]] Result<std::string_view> bytes(std::uint64_t count);

    // The next word, as text or as a number. Fails at the end of the text, or on another kind of word. `what` names the
    // value in messages: "the radius".
    [[nodiscard]] Result<std::string_view> needed(std::string_view what);
    [[nodiscard]] Result<double> real(std::string_view what);
    [[nodiscard]] Result<std::int64_t> whole(std::string_view what);
    // The next word as a count. Fails if it is negative, or greater than the number of bytes left: each counted thing
    // takes at least one byte.
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
