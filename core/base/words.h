// Words of commands, options and sessions: taken apart, read as numbers, and put together.
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

// All of the word as a number, whatever the locale is; `base` as of std::from_chars.
template <class Number, class... Base> [[nodiscard]] std::optional<Number> parsed(std::string_view word, Base... base) {
    Number number{};
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number, base...);
    return error == std::errc{} && end == word.data() + word.size() ? std::optional(number) : std::nullopt;
}

// At most so many digits, whatever the locale is: as short as they come, with a power of ten where that is shorter.
[[nodiscard]] inline std::string in_digits(double value, int digits = 6) {
    std::array<char, 32> text{};
    return {text.data(), std::to_chars(text.begin(), text.end(), value, std::chars_format::general, digits).ptr};
}

// UTF-8 of at most `most` bytes, ending in an ellipsis where some was left out.
[[nodiscard]] inline std::string shortened(std::string text, std::size_t most = 32) {
    if (text.size() <= most) return text;
    std::size_t end = most;
    while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80) --end; // not inside a character
    return text.substr(0, end) + "\xE2\x80\xA6";
}

// What a table of pairs has for a name, or for whatever else stands first.
template <class Table, class First> [[nodiscard]] auto paired(const Table& table, const First& first) {
    const auto found = std::ranges::find_if(table, [&](const auto& pair) { return pair.first == first; });
    return found == std::end(table) ? std::nullopt : std::optional(found->second);
}

// What stands between commas: one part at least, which may be empty.
[[nodiscard]] inline std::vector<std::string_view> parts_of(std::string_view text) {
    std::vector<std::string_view> parts;
    for (std::size_t from = 0, end = 0; from <= text.size(); from = end + 1) {
        end = std::min(text.find(',', from), text.size());
        parts.push_back(text.substr(from, end - from));
    }
    return parts;
}

// The words that things have, one after the other with `between` between.
template <class Things, class Word = std::identity>
[[nodiscard]] std::string joined(Things&& things, std::string_view between = ", ", const Word& word_of = {}) {
    std::string text;
    for (auto&& thing : things) text.append(text.empty() ? "" : between).append(std::invoke(word_of, thing));
    return text;
}

} // namespace ramus
