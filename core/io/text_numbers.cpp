#include "core/io/text_numbers.h"

#include "core/base/words.h"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace ramus::io {

namespace {

constexpr std::string_view kBlanks = " \t\r\n\f\v";

} // namespace

std::optional<double> to_real(std::string_view text) {
    if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error == std::errc::result_out_of_range && end == text.data() + text.size())
        return text.find("e-") != std::string_view::npos || text.find("E-") != std::string_view::npos ? 0.0 : HUGE_VAL;
    if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
    return value;
}

bool begins_formula(std::string_view text) {
    constexpr std::string_view kSigns = "=+-@\t\r\n";
    return text.size() > 1 && kSigns.find(text.front()) != std::string_view::npos && !to_real(text);
}

std::optional<std::int64_t> to_whole(std::string_view text) {
    const auto whole = parsed<std::int64_t>(text);
    if (whole && std::abs(static_cast<double>(*whole)) < 9e15) return whole;
    const auto real = to_real(text);
    if (!real || !(std::abs(*real) < 9e15) || *real != std::floor(*real)) return std::nullopt;
    return static_cast<std::int64_t>(*real);
}

std::string shown(std::string_view text) {
    std::string shown;
    for (const char c : text.substr(0, 24)) shown += c >= ' ' && c < 127 ? c : '?';
    return "'" + shown + (text.size() > 24 ? "...'" : "'");
}

std::string_view trimmed(std::string_view text) {
    const std::size_t first = text.find_first_not_of(kBlanks);
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

std::string lower_case(std::string_view text) {
    std::string lower(text);
    std::ranges::transform(lower, lower.begin(), [](char c) { return c >= 'A' && c <= 'Z' ? char(c + 32) : c; });
    return lower;
}

std::string exact_number(double value) {
    char text[32];
    return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

std::string short_number(double value) { return in_digits(value, 4); }

std::size_t line_at(std::string_view text, std::size_t offset) {
    return 1 + static_cast<std::size_t>(std::ranges::count(text.substr(0, std::min(offset, text.size())), '\n'));
}

std::string counted(std::size_t count, std::string_view noun) {
    return std::to_string(count) + " " + std::string(noun) + (count == 1 ? "" : "s");
}

std::string_view WordScanner::next() {
    while (at_ < text_.size() && kBlanks.find(text_[at_]) != std::string_view::npos)
        if (text_[at_++] == '\n') ++line_;
    const std::size_t begin = at_;
    at_ = std::min(text_.find_first_of(kBlanks, at_), text_.size());
    return text_.substr(begin, at_ - begin);
}

std::string_view WordScanner::peek() const {
    const std::size_t begin = std::min(text_.find_first_not_of(kBlanks, at_), text_.size());
    return text_.substr(begin, std::min(text_.find_first_of(kBlanks, begin), text_.size()) - begin);
}

std::string_view WordScanner::line() {
    const std::size_t end = text_.find('\n', at_);
    const std::string_view rest = text_.substr(at_, end == std::string_view::npos ? end : end - at_);
    at_ = end == std::string_view::npos ? text_.size() : end + 1;
    if (end != std::string_view::npos) ++line_;
    return rest;
}

Result<std::string_view> WordScanner::bytes(std::uint64_t count) {
    if (count > left())
        return fail("the file ends here: " + std::to_string(count) + " bytes should follow, there are " +
                        std::to_string(left()),
                    place(), "the file is incomplete; get it again");
    const std::string_view bytes = text_.substr(at_, count);
    at_ += count;
    line_ += static_cast<std::size_t>(std::ranges::count(bytes, '\n'));
    return bytes;
}

Result<std::string_view> WordScanner::needed(std::string_view what) {
    const std::string_view word = next();
    if (!word.empty()) return word;
    return fail("the file ends where " + std::string(what) + " should stand", place(),
                "the file is incomplete; get it again");
}

Result<double> WordScanner::real(std::string_view what) {
    RAMUS_TRY(word, needed(what));
    if (const auto value = to_real(word)) return *value;
    return fail(std::string(what) + " " + shown(word) + " is not a number", place(),
                word.find(',') != std::string_view::npos ? "numbers take a decimal point" : "correct the file");
}

Result<std::int64_t> WordScanner::whole(std::string_view what) {
    RAMUS_TRY(word, needed(what));
    if (const auto value = to_whole(word)) return *value;
    return fail(std::string(what) + " " + shown(word) + " is not a whole number", place(), "correct the file");
}

Result<std::size_t> WordScanner::count(std::string_view what) {
    RAMUS_TRY(value, whole(what));
    if (value < 0) return fail(std::string(what) + " is negative", place(), "correct the file");
    if (static_cast<std::uint64_t>(value) > left())
        return fail(std::string(what) + " is " + std::to_string(value) + ", more than the file has bytes", place(),
                    "the file is incomplete or damaged; get it again");
    return static_cast<std::size_t>(value);
}

} // namespace ramus::io
