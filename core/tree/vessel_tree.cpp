#include "core/tree/vessel_tree.h"

#include "core/base/printable.h"

#include <algorithm>
#include <cctype>
#include <glm/geometric.hpp>

namespace ramus::tree {

std::size_t VesselTree::segment_count() const {
    std::size_t count = 0;
    for (const Branch& branch : branches) count += branch.points.size() - 1;
    return count;
}

std::string_view Claims::unit_word() const { return has_unit() ? "mm" : kNotSaid; }
std::string_view Claims::axes_word() const { return has_sides() ? "RAS" : kNotSaid; }

// Matches only the separate word: after a blank or a bracket, and not before a letter. Skips names of files.
std::string Claims::worded(std::string_view text) const {
    std::string worded(text);
    if (has_unit()) return worded;
    constexpr std::string_view kMm = "mm", kUnits = "units";
    for (std::size_t at = worded.find(kMm); at != std::string::npos; at = worded.find(kMm, at + 1)) {
        const char before = at == 0 ? ' ' : worded[at - 1];
        const char after = at + kMm.size() < worded.size() ? worded[at + kMm.size()] : ' ';
        const bool is_word = (before == ' ' || before == '(' || before == '\n') &&
                             std::isalpha(static_cast<unsigned char>(after)) == 0 && after != '_' && after != '/';
        if (is_word) worded.replace(at, kMm.size(), kUnits);
    }
    return worded;
}

std::string_view name_of(SaidBy who) {
    return who == SaidBy::kFile ? "file" : who == SaidBy::kPerson ? "person" : "nobody";
}

std::vector<std::string> sentences(const VesselTree& tree, Note::Kind kind) {
    std::vector<std::string> found;
    for (const Note& note : tree.notes)
        if (note.kind == kind) found.push_back(printable(note.text));
    return found;
}

std::string_view name_of(Note::Kind kind) {
    return kind == Note::Kind::kAssumed ? "assumed" : kind == Note::Kind::kRepaired ? "repaired" : "suspect";
}

std::vector<NoteGroup> note_groups(const VesselTree& tree) {
    std::vector<NoteGroup> groups;
    for (const Note::Kind kind : {Note::Kind::kSuspect, Note::Kind::kRepaired, Note::Kind::kAssumed}) {
        const std::size_t first = groups.size(); // of this kind
        for (std::size_t n = 0; n < tree.notes.size(); ++n) {
            const Note& note = tree.notes[n];
            if (note.kind != kind) continue;
            auto group = std::find_if(groups.begin() + static_cast<std::ptrdiff_t>(first), groups.end(),
                                      [&](const NoteGroup& each) { return each.topic == note.topic; });
            if (group == groups.end()) group = groups.insert(group, {kind, note.topic, {}});
            group->notes.push_back(n);
        }
    }
    return groups;
}

double length_mm(const VesselTree& tree, const Branch& branch) {
    double sum = 0.0;
    for (std::size_t i = 1; i < branch.points.size(); ++i)
        sum += glm::distance(tree.points[branch.points[i - 1]].position, tree.points[branch.points[i]].position);
    return sum;
}

} // namespace ramus::tree
