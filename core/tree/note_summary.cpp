#include "core/tree/note_summary.h"

#include "core/base/words.h"

#include <map>
#include <utility>

namespace ramus::tree {

namespace {

constexpr std::size_t kPlacesNamed = 5;
constexpr std::size_t kMostLikeOneAnother = 1000, kKeptOfMany = 100;

} // namespace

std::vector<NoteSummary> summed_up(const VesselTree& tree) {
    std::vector<NoteSummary> summaries;
    for (const NoteGroup& group : note_groups(tree)) {
        NoteSummary several{group.kind, group.topic, {}, 0, {}};
        for (const std::size_t n : group.notes) {
            const Note& note = tree.notes[n];
            if (!note.at) {
                summaries.push_back({group.kind, group.topic, note.text, 1, {}});
                continue;
            }
            if (several.count++ == 0) several.text = note.text;
            if (several.places.size() < kPlacesNamed) several.places.push_back(*note.at);
        }
        if (several.count == 0) continue;
        if (several.count > 1) several.text += ", and " + std::to_string(several.count - 1) + " more like it";
        summaries.push_back(std::move(several));
    }
    return summaries;
}

std::string with_places(const NoteSummary& summary) {
    std::string places;
    for (const glm::dvec3& at : summary.places)
        places +=
            (places.empty() ? "" : "; ") + in_digits(at.x, 4) + ", " + in_digits(at.y, 4) + ", " + in_digits(at.z, 4);
    if (places.empty()) return summary.text;
    return summary.text + (summary.count > 1 ? " (the first at " : " (at ") + places + ")";
}

void drop_repeated(std::vector<Note>& notes) {
    const auto counts = [](const Note& note) { return note.at.has_value() && !note.outward; };
    std::map<std::pair<Note::Kind, std::string>, std::size_t> all, seen;
    for (const Note& note : notes)
        if (counts(note)) ++all[{note.kind, note.topic}];
    std::erase_if(all, [](const auto& group) { return group.second <= kMostLikeOneAnother; });
    if (all.empty()) return;
    std::erase_if(notes, [&](const Note& note) {
        const std::pair key(note.kind, note.topic);
        return counts(note) && all.contains(key) && ++seen[key] > kKeptOfMany;
    });
    for (const auto& [key, count] : all)
        notes.push_back({key.first,
                         key.second,
                         "the first " + std::to_string(kKeptOfMany) + " of " + std::to_string(count) +
                             " such places (" + key.second + ") are listed",
                         {}});
}

} // namespace ramus::tree
