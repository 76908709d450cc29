#include "app/commands/command.h"

#include "core/base/words.h"
#include "core/io/standard_input.h"
#include "core/io/text_numbers.h"

#include <algorithm>

namespace ramus::app {

namespace {

int standard_input_words = 0; // of this command line

} // namespace

std::string input_word(const std::string& word) {
    if (word != "-" && !io::is_standard_input(word)) return word;
    if (++standard_input_words > 1)
        throw CLI::ValidationError(word, "standard input can be one input only; name a file for the other one");
    return io::kStandardInputPath;
}

bool reads_standard_input() { return standard_input_words > 0; }

std::optional<std::uint64_t> memory_size(std::string_view word) {
    constexpr std::string_view kPrefixes = "kmgt";
    constexpr std::uint64_t kMost = std::uint64_t{1} << 50;
    std::string text = io::lower_case(word);
    for (const std::string_view end : {"ib", "b"}) // of "4GiB", "4GB", "4096B"
        if (text.ends_with(end)) {
            text.resize(text.size() - end.size());
            break;
        }
    std::uint64_t unit = 1;
    if (const std::size_t prefix = text.empty() ? text.npos : kPrefixes.find(text.back()); prefix != text.npos) {
        unit <<= 10 * (prefix + 1);
        text.pop_back();
    }
    const auto number = parsed<std::uint64_t>(io::trimmed(text));
    return number && *number <= kMost / unit ? std::optional(*number * unit) : std::nullopt;
}

} // namespace ramus::app
