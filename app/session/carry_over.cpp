#include "app/session/carry_over.h"

#include "app/session/labels.h"
#include "app/session/reading_options.h"
#include "app/session/systems.h"
#include "app/session/usual_sizes.h"
#include "render/scene/bounds.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <map>
#include <tuple>
#include <utility>

namespace ramus::app {

namespace {

using tree::kNoBranch;

bool same_shape(const tree::VesselTree& a, const tree::VesselTree& b) {
    return std::ranges::equal(a.branches, b.branches, [](const tree::Branch& x, const tree::Branch& y) {
        return x.parent == y.parent && x.points.size() == y.points.size();
    });
}

std::tuple<double, double, double> place(const tree::VesselTree& tree, std::uint32_t point) {
    const glm::dvec3& p = tree.points[point].position;
    return {p.x, p.y, p.z};
}

// The same whichever end comes first.
auto looks_of(const tree::VesselTree& tree, const tree::Branch& branch) {
    using Place = std::tuple<double, double, double>;
    const std::size_t last = branch.points.size() - 1;
    Place first = place(tree, branch.points.front()), end = place(tree, branch.points.back());
    Place middle = place(tree, branch.points[last / 2]), other = place(tree, branch.points[last - last / 2]);
    if (end < first) std::swap(first, end), std::swap(middle, other);
    return std::tuple(branch.points.size(), first, end, middle, other);
}

// The branches of `after` of systems that are in both and hidden as a whole; those of `before` are taken out of
// `hidden`.
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

} // namespace

std::vector<int> same_branches(const tree::VesselTree& before, const tree::VesselTree& after) {
    std::vector<int> same(before.branches.size(), kNoBranch);
    if (same_shape(before, after)) {
        for (std::size_t id = 0; id < same.size(); ++id) same[id] = static_cast<int>(id);
        return same;
    }
    using Looks = decltype(looks_of(after, after.branches.front()));
    std::map<Looks, int> by_looks;
    for (std::size_t id = 0; id < after.branches.size(); ++id)
        by_looks.emplace(looks_of(after, after.branches[id]), static_cast<int>(id));
    for (std::size_t id = 0; id < same.size(); ++id)
        if (const auto found = by_looks.find(looks_of(before, before.branches[id])); found != by_looks.end())
            same[id] = found->second;
    return same;
}

CarriedOver carried_over(const Marks& marks, const tree::VesselTree& before, const tree::VesselTree& after) {
    const std::vector<int> same = same_branches(before, after);
    const bool alike = same_shape(before, after);
    CarriedOver carried{marks, 0};
    // Counts what is lost.
    const auto to = [&](int id) {
        const int found =
            id >= 0 && id < static_cast<int>(same.size()) ? same[static_cast<std::size_t>(id)] : kNoBranch;
        if (found == kNoBranch) ++carried.lost;
        return found;
    };
    const auto turned = [&](int id, int now) {
        return !alike && place(before, before.branches[static_cast<std::size_t>(id)].points.front()) ==
                             place(after, after.branches[static_cast<std::size_t>(now)].points.back());
    };
    Marks& next = carried.marks;
    next.selection.clear(), next.states.clear(), next.cuts.clear(), next.measurements.clear(), next.names.clear();
    next.subtree_names.clear();
    for (const int id : marks.selection)
        if (const int now = to(id); now != kNoBranch) next.selection.push_back(now);
    next.selection = canonical(std::move(next.selection));
    for (const auto state :
         {render::BranchState::kHighlighted, render::BranchState::kDefocused, render::BranchState::kHidden}) {
        std::vector<int> were = branches_in_state(marks, state), those;
        if (state == render::BranchState::kHidden) those = take_hidden_systems(were, before, after);
        for (const int id : were)
            if (const int now = to(id); now != kNoBranch) those.push_back(now);
        set_state(next, those, state);
    }
    if (before.systems != after.systems) { // others: names and colours were given to those before
        next.systems.clear();
        next.colour_by = first_colouring(next.colour_by, after);
    }
    for (const auto& [id, fraction] : marks.cuts)
        if (const int now = to(id); now != kNoBranch)
            next.cuts.emplace_back(now, turned(id, now) ? 1.0 - fraction : fraction);
    for (const auto& [id, name] : marks.names)
        if (const int now = to(id); now != kNoBranch) set_name(next, now, name, names_subtree(marks, id));
    for (Measurement measurement : marks.measurements) {
        bool whole = true;
        for (std::size_t i = 0; i < place_count(measurement); ++i) {
            auto& [branch, fraction] = measurement.places[i];
            const int was = std::exchange(branch, to(branch));
            whole = whole && branch != kNoBranch;
            if (branch != kNoBranch && turned(was, branch)) fraction = 1.0 - fraction;
        }
        if (whole) next.measurements.push_back(measurement);
    }
    if (marks.planning == usual_sizes(before).planning) next.planning = usual_sizes(after).planning;
    return carried;
}

void follow_unit(Marks& marks, const TreeFile& file) {
    if (marks.comparison.mask != file.path.string()) return;
    marks.comparison.mask_units = marks.reading.unit ? spelled(*marks.reading.unit) : std::string();
}

namespace {

// Which turn of the axes, a mirror image included, made one tree of the other beside a change of scale: that of the
// first of all points, which RAS is unless something was turned.
io::Orientation turn_between(const tree::VesselTree& before, const tree::VesselTree& after, double scale, double size) {
    constexpr double kSame = 1e-6;
    constexpr std::size_t kLooked = 200; // places: what turns so many alike turns all
    const std::size_t count = before.points.size(), step = std::max<std::size_t>(1, count / kLooked);
    if (count == 0 || count != after.points.size()) return {};
    const glm::dvec3 from = before.points.front().position, to = after.points.front().position;
    for (const io::Orientation& turn : io::all_orientations()) {
        bool turns_all = true;
        for (std::size_t p = 0; p < count && turns_all; p += step) {
            const glm::dvec3 there = to + scale * turn.to_patient(before.points[p].position - from);
            turns_all = glm::distance(there, after.points[p].position) <= kSame * scale * size;
        }
        if (turns_all) return turn;
    }
    return {};
}

} // namespace

render::Camera carried_over(const render::Camera& camera, const tree::VesselTree& before,
                            const tree::VesselTree& after) {
    const render::Box from = render::bounds_of(before), to = render::bounds_of(after);
    const double size = glm::distance(from.lower, from.upper);
    if (from.empty() || to.empty() || !(size > 0.0)) return camera;
    const double scale = glm::distance(to.lower, to.upper) / size;
    const glm::dvec3 old_centre = 0.5 * (from.lower + from.upper), centre = 0.5 * (to.lower + to.upper);
    const io::Orientation turn = turn_between(before, after, scale, size);
    render::Camera carried = camera;
    carried.focal_point = centre + scale * turn.to_patient(camera.focal_point - old_centre);
    carried.position = centre + scale * turn.to_patient(camera.position - old_centre);
    carried.view_up = turn.to_patient(camera.view_up);
    carried.scale = scale * camera.scale;
    return carried;
}

} // namespace ramus::app
