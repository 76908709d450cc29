#include "app/session/warnings.h"

#include "app/session/numbers.h"
#include "app/session/reading_options.h"
#include "app/session/window_words.h"

#include <algorithm>
#include <utility>

namespace ramus::app {

std::vector<Warning> warnings_of(const tree::VesselTree& tree, const std::string& file) {
    using Kind = tree::Note::Kind;
    std::vector<Warning> found;
    for (const tree::NoteGroup& group : note_groups(tree)) {
        const std::string kind = group.kind == Kind::kSuspect    ? "Suspicious"
                                 : group.kind == Kind::kRepaired ? "Repaired"
                                                                 : "Assumed";
        std::string what =
            kind + ", " + topic_label(group.topic) + ": " + window_words(tree.notes[group.notes.front()].text);
        if (group.notes.size() > 1) what += "; and " + grouped(group.notes.size() - 1) + " more";
        const bool units_panel =
            (group.topic == "units" && !tree.claims.has_unit()) || (group.topic == "axes" && !tree.claims.has_sides());
        found.push_back({std::move(what), file,
                         units_panel
                             ? "say it: View, Orientation and unit"
                             : "look at it in the import doctor, and read the file in another way if it is wrong",
                         units_panel ? "orientation" : "doctor", true});
    }
    return found;
}

std::size_t WarningList::unread() const {
    return static_cast<std::size_t>(std::ranges::count(list_, false, &Warning::read));
}

void WarningList::add(Warning warning) {
    std::erase_if(list_, [&](const Warning& there) { return there.same_as(warning); });
    list_.push_back(std::move(warning));
}

void WarningList::follow(const std::shared_ptr<const tree::VesselTree>& tree, const std::string& file) {
    if (tree == tree_) return;
    tree_ = tree;
    std::vector<Warning> now = tree ? warnings_of(*tree, file) : std::vector<Warning>();
    for (Warning& warning : now)
        warning.read = std::ranges::any_of(
            list_, [&](const Warning& there) { return there.of_tree && there.read && there.same_as(warning); });
    std::erase_if(list_, [](const Warning& there) { return there.of_tree; });
    list_.insert(list_.begin(), std::make_move_iterator(now.begin()), std::make_move_iterator(now.end()));
}

void WarningList::mark_read(std::size_t index) {
    if (index < list_.size()) list_[index].read = true;
}

void WarningList::mark_all_read() {
    for (Warning& warning : list_) warning.read = true;
}

} // namespace ramus::app
