#include "app/actions/phrases.h"

#include "app/session/numbers.h"

#include <algorithm>

namespace ramus::app {

namespace {

constexpr std::size_t kLongest = 32; // bytes of what is quoted

std::string shortened(std::string text) {
    if (text.size() <= kLongest) return text;
    std::size_t end = kLongest;
    while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80) --end; // not inside a character
    return text.substr(0, end) + "\xE2\x80\xA6";
}

std::string branches_phrase(const std::vector<int>& branches, const Marks& marks) {
    if (branches.size() != 1) return grouped(branches.size()) + " branches";
    const auto name = marks.names.find(branches.front());
    return name == marks.names.end() ? "branch " + std::to_string(branches.front()) : shortened(name->second);
}

} // namespace

std::string phrase_of(const Command& command, Arguments arguments, const MarksChange& change, const Marks& after) {
    std::string words = command.name;
    std::ranges::replace(words, '-', ' ');
    const std::vector<int> restated = change.restated();
    if (!restated.empty() || (change.selects() && !after.selection.empty())) {
        // "hide 12 branches", but "select dependents: 12 branches".
        const std::string who = branches_phrase(restated.empty() ? after.selection : restated, after);
        return words + (words.find(' ') == std::string::npos ? " " : ": ") + who;
    }
    if (change.selects()) return "select none";
    std::string given;
    for (const std::string& argument : arguments) given += " " + argument;
    std::ranges::replace(given, '\n', ' ');
    return words + shortened(given);
}

} // namespace ramus::app
