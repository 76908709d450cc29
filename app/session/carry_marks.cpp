#include "app/session/carry_marks.h"

#include "app/session/carry_over.h"
#include "app/session/labels.h"
#include "app/session/systems.h"
#include "app/session/usual_sizes.h"

#include <algorithm>
#include <utility>

namespace ramus::app {

using tree::BranchState;

namespace {

// Returns the branches of `after` in systems that exist in both trees and are completely hidden; removes those of
// `before` from `hidden`.
std::vector<int> take_hidden_systems(std::vector<int>& hidden, const tree::VesselTree& before,
                                     const tree::VesselTree& after) {
    std::vector<int> whole;
    if (before.systems != after.systems) return whole;
    for (int system = 0; system < static_cast<int>(before.systems.size()); ++system) {
        const std::vector<int> own = branches_in_system(before, system);
        if (own.empty() || !std::ranges::includes(hidden, own)) continue;
        std::erase_if(hidden, [&](int id) { return std::ranges::binary_search(own, id); });
        const std::vector<int> now = branches_in_system(after, system);
        whole.insert(whole.end(), now.begin(), now.end());
    }
    return whole;
}

// Appends the branches that `ids` became; returns how many are gone.
std::size_t append_there(std::vector<int>& there, const std::vector<int>& ids, const BranchMap& map) {
    std::size_t lost = 0;
    for (const int id : ids) {
        const std::vector<int>& now = map.mostly(id);
        lost += map.became(id).empty() ? 1 : 0;
        there.insert(there.end(), now.begin(), now.end());
    }
    return lost;
}

} // namespace

std::size_t carry_selection(Marks& marks, const BranchMap& map) {
    const std::vector<int> selected = std::exchange(marks.selection, {});
    const std::size_t lost = append_there(marks.selection, selected, map);
    marks.selection = canonical(std::move(marks.selection));
    return lost;
}

std::size_t carry_states(Marks& marks, const BranchMap& map) {
    const Marks before = marks;
    marks.states.clear();
    std::size_t lost = 0;
    for (const BranchState state : kListedStates) {
        std::vector<int> ids = branches_in_state(before, state), there;
        if (state == BranchState::kHidden && !map.was_edited())
            there = take_hidden_systems(ids, map.before(), map.after());
        lost += append_there(there, ids, map);
        set_state(marks, there, state);
    }
    return lost;
}

namespace {

std::size_t carry(std::vector<std::pair<int, double>>& cuts, const BranchMap& map) {
    std::size_t lost = 0;
    for (const auto& [branch, fraction] : std::exchange(cuts, {}))
        if (const auto place = map.place({branch, fraction}))
            cuts.emplace_back(place->branch, place->fraction);
        else
            ++lost;
    return lost;
}

} // namespace

std::size_t carry_cuts(Marks& marks, const BranchMap& map) { return carry(marks.cuts, map); }

std::size_t carry_plans(Marks& marks, const BranchMap& map) {
    std::size_t lost = 0;
    for (OperationPlan& plan : marks.plans.others) lost += carry(plan.cuts, map);
    return lost;
}

std::size_t carry_names(Marks& marks, const BranchMap& map) {
    Marks before;
    std::swap(before.names, marks.names);
    std::swap(before.subtree_names, marks.subtree_names);
    std::size_t lost = 0;
    for (const auto& [branch, name] : before.names) {
        const std::vector<int>& became = map.became(branch);
        if (became.empty())
            ++lost;
        else if (!marks.names.contains(became.front()))
            set_name(marks, became.front(), name, names_subtree(before, branch));
    }
    return lost;
}

std::size_t carry_measurements(Marks& marks, const BranchMap& map) {
    std::size_t lost = 0;
    for (Measurement measurement : std::exchange(marks.measurements, {})) {
        bool whole = true;
        for (std::size_t i = 0; i < place_count(measurement) && whole; ++i) {
            const auto place = map.place(measurement.places[i]);
            whole = place.has_value();
            if (whole) measurement.places[i] = *place;
        }
        if (whole)
            marks.measurements.push_back(measurement);
        else
            ++lost;
    }
    return lost;
}

// Names and colours belong to the old systems.
std::size_t carry_systems(Marks& marks, const BranchMap& map) {
    if (map.before().systems != map.after().systems) marks.systems.clear();
    return 0;
}

std::size_t carry_colour_by(Marks& marks, const BranchMap& map) {
    if (map.before().systems != map.after().systems) marks.colour_by = first_colouring(marks.colour_by, map.after());
    return 0;
}

std::size_t carry_organ(Marks& marks, const BranchMap& map) {
    if (map.before().systems.size() != map.after().systems.size()) marks.organ.roles.clear(), marks.organ.system = -1;
    return 0;
}

std::size_t carry_planning(Marks& marks, const BranchMap& map) {
    if (!map.was_edited() && marks.planning == usual_sizes(map.before()).planning)
        marks.planning = usual_sizes(map.after()).planning;
    return 0;
}

} // namespace ramus::app
