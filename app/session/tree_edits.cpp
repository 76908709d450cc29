#include "app/session/tree_edits.h"

#include "app/session/labels.h"
#include "app/session/session_file.h"
#include "core/measure/branch_point.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <optional>

namespace ramus::app {

namespace {

using render::BranchState;

// Where what was on a branch is now.
class Places {
public:
    Places(const tree::VesselTree& before, const tree::EditedTree& after)
        : before_(before), after_(after), became_(before.branches.size()) {
        for (std::size_t id = 0; id < after.sources.size(); ++id)
            for (const int source : after.sources[id])
                became_[static_cast<std::size_t>(source)].push_back(static_cast<int>(id));
    }

    [[nodiscard]] const std::vector<int>& became(int branch) const {
        static const std::vector<int> none;
        return static_cast<std::size_t>(branch) < became_.size() ? became_[static_cast<std::size_t>(branch)] : none;
    }

    [[nodiscard]] std::optional<measure::BranchPlace> of(const measure::BranchPlace& place) const {
        const auto found = of(place.branch, place.fraction);
        return found ? std::optional(measure::BranchPlace{found->first, found->second}) : std::nullopt;
    }

    [[nodiscard]] std::optional<std::pair<int, double>> of(int branch, double fraction) const {
        constexpr double kSame = 1e-6; // mm; positions are kept exactly, fractions are not
        if (became(branch).empty()) return {};
        const glm::dvec3 at = measure::point_on(before_, branch, fraction).position;
        std::optional<std::pair<int, double>> found;
        double nearest = kSame * (1.0 + glm::length(at));
        for (const int id : became(branch)) {
            const double here = measure::nearest_fraction(after_.tree, id, at);
            const double distance = glm::distance(at, measure::point_on(after_.tree, id, here).position);
            if (distance < nearest) nearest = distance, found = {id, here};
        }
        return found;
    }

private:
    const tree::VesselTree& before_;
    const tree::EditedTree& after_;
    std::vector<std::vector<int>> became_; // by branch before
};

std::optional<Measurement> carried(const Measurement& measurement, const Places& places) {
    Measurement moved = measurement;
    for (std::size_t i = 0; i < place_count(measurement); ++i) {
        const auto place = places.of(measurement.places[i]);
        if (!place) return {};
        moved.places[i] = *place;
    }
    return moved;
}

} // namespace

Marks carried_over(const Marks& marks, const tree::VesselTree& before, const tree::EditedTree& after) {
    Marks next = marks;
    const Places places(before, after);
    next.selection.clear();
    next.states.assign(after.tree.branches.size(), BranchState::kNormal);
    for (std::size_t id = 0; id < after.sources.size(); ++id) {
        if (after.sources[id].empty()) continue;
        const int mostly = after.sources[id].front();
        if (is_selected(marks, mostly)) next.selection.push_back(static_cast<int>(id));
        next.states[id] = state_of(marks, mostly);
    }
    set_state(next, {}, BranchState::kNormal); // trailing normal ones go
    next.names.clear();
    next.subtree_names.clear();
    for (const auto& [branch, name] : marks.names)
        if (const auto& became = places.became(branch); !became.empty() && !next.names.contains(became.front()))
            set_name(next, became.front(), name, names_subtree(marks, branch));
    next.cuts.clear();
    for (const auto& [branch, fraction] : marks.cuts)
        if (const auto place = places.of(branch, fraction)) next.cuts.push_back(*place);
    next.measurements.clear();
    for (const Measurement& measurement : marks.measurements)
        if (auto moved = carried(measurement, places)) next.measurements.push_back(*moved);
    return next;
}

Result<MadeEdit> made_edit(std::shared_ptr<const tree::VesselTree> tree, const tree::Edit& edit) {
    if (!tree) return fail("there is no tree", {}, "open one first");
    RAMUS_TRY(edited, tree::apply(*tree, edit));
    auto facts = std::make_shared<const TreeFacts>(facts_of(edited.tree));
    return MadeEdit{edit, std::move(tree), std::make_shared<const tree::EditedTree>(std::move(edited)),
                    std::move(facts)};
}

Result<std::shared_ptr<const tree::VesselTree>> with_edits(std::shared_ptr<const tree::VesselTree> base,
                                                           const Session& session, const std::string& checksum,
                                                           const std::string& where) {
    if (session.marks.edits.empty()) return base;
    if (auto same = check_checksum(session, checksum, where); !same) return tl::unexpected(same.error());
    auto edited = tree::apply_all(*base, session.marks.edits);
    if (!edited)
        return fail("an edit of the tree cannot be made again: " + edited.error().what, where,
                    "the session belongs to another tree");
    return std::make_shared<const tree::VesselTree>(std::move(*edited));
}

} // namespace ramus::app
