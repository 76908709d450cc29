#include "core/volume/label_choice.h"

#include "core/base/words.h"
#include "core/volume/volume.h"

#include <algorithm>
#include <cctype>

namespace ramus::volume {

namespace {

// The form of a name for comparison: without capitals, blanks and underscores.
std::string folded(std::string_view name) {
    std::string text(name);
    for (char& c : text) c = c == '_' ? ' ' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return text;
}

std::string names_there(const Volume& volume) {
    constexpr std::size_t kMost = 40;
    if (volume.label_names.empty()) return "its labels have no names: choose by number; ramus info lists the labels";
    std::string list;
    for (std::size_t i = 0; i < std::min(kMost, volume.label_names.size()); ++i)
        list += (i == 0 ? "" : ", ") + volume.label_names[i].name + " (" + std::to_string(volume.label_names[i].label) +
                ")";
    return "the names there are: " + list +
           (volume.label_names.size() > kMost ? ", ... (ramus info lists the labels)" : "");
}

Result<std::int32_t> number_of(const Volume& volume, const std::string& name) {
    std::vector<std::int32_t> found;
    const auto look_for = [&](const auto& matches) {
        for (const LabelName& each : volume.label_names)
            if (matches(each.name)) found.push_back(each.label);
    };
    look_for([&](const std::string& other) { return other == name; });
    if (found.empty()) look_for([&](const std::string& other) { return folded(other) == folded(name); });
    if (found.size() == 1) return found.front();
    if (found.empty()) return fail("no label is called \"" + name + "\"", {}, names_there(volume));
    return fail("several labels are called \"" + name +
                    "\": " + joined(found, ", ", [](std::int32_t label) { return std::to_string(label); }),
                {}, "choose one of them by its number");
}

} // namespace

Result<std::vector<std::int32_t>> label_numbers(const Volume& volume, const std::vector<LabelChoice>& choices) {
    std::vector<std::int32_t> numbers;
    for (const LabelChoice& choice : choices) {
        if (choice.name.empty()) {
            numbers.push_back(choice.number);
            continue;
        }
        RAMUS_TRY(number, number_of(volume, choice.name));
        numbers.push_back(number);
    }
    return numbers;
}

std::string spelled(const LabelChoice& choice) {
    if (choice.name.empty()) return std::to_string(choice.number);
    const bool plain = !parsed<std::int32_t>(choice.name) && choice.name.find_first_of("+,\"") == std::string::npos &&
                       choice.name != "all" && choice.name != "apart" && choice.name != "together" &&
                       choice.name != "auto";
    return plain ? choice.name : '"' + choice.name + '"';
}

} // namespace ramus::volume
