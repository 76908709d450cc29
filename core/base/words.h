// Text helpers for commands, options and sessions: parsing and writing numbers, splitting, joining, shortening.
#pragma once

#include <algorithm>
#include <array>
#include <charconv>
#include <functional>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ramus {

// Parses the whole word as a number, independent of the locale. `base` as for std::from_chars. None: it is no number of
// this type.
template <class Number, class... Base> [[nodiscard]] std::optional<Number> parsed(std::string_view word, Base... base) {
    Number number{};
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number, base...);
    return error == std::errc{} && end == word.data() + word.size() ? std::optional(number) : std::nullopt;
}

// Writes a number with at most `digits` significant digits, as printf("%g") does, independent of the locale.
[[nodiscard]] inline std::string in_digits(double value, int digits = 6) {
    std::array<char, 32> text{};
    return {text.data(), std::to_chars(text.begin(), text.end(), value, std::chars_format::general, digits).ptr};
}

// Cuts UTF-8 text to at most `most` bytes, between characters. Text that was cut gets an ellipsis, 3 bytes more.
[[nodiscard]] inline std::string shortened(std::string text, std::size_t most = 32) {
    if (text.size() <= most) return text;
    std::size_t end = most;
    while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80) --end; // not inside a character
    return text.substr(0, end) + "\xE2\x80\xA6";
}

// The second member of the pair in `table` whose first member is `first`. None: there is no such pair.
template <class Table, class First> [[nodiscard]] auto paired(const Table& table, const First& first) {
    const auto found = std::ranges::find_if(table, [&](const auto& pair) { return pair.first == first; });
    return found == std::end(table) ? std::nullopt : std::optional(found->second);
}

// The first member of the pair in `table` whose second member is `second`. None: there is no such pair.
template <class Table, class Second> [[nodiscard]] auto paired_with(const Table& table, const Second& second) {
    const auto found = std::ranges::find_if(table, [&](const auto& pair) { return pair.second == second; });
    return found == std::end(table) ? std::nullopt : std::optional(found->first);
}

// Splits at commas. At least one part; parts may be empty.
[[nodiscard]] inline std::vector<std::string_view> parts_of(std::string_view text) {
    std::vector<std::string_view> parts;
    for (std::size_t from = 0, end = 0; from <= text.size(); from = end + 1) {
        end = std::min(text.find(',', from), text.size());
        parts.push_back(text.substr(from, end - from));
    }
    return parts;
}

// Concatenates word_of(thing) for all things, separated by `between`.
template <class Things, class Word = std::identity>
[[nodiscard]] std::string joined(Things&& things, std::string_view between = ", ", const Word& word_of = {}) {
    std::string text;
    for (auto&& thing : things) text.append(text.empty() ? "" : between).append(std::invoke(word_of, thing));
    return text;
}

} // namespace ramus
