#include "app/session/carry_over.h"

#include "app/session/marks_table.h"
#include "app/session/reading_options.h"
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

// Independent of the branch's direction.
auto looks_of(const tree::VesselTree& tree, const tree::Branch& branch) {
    using Place = std::tuple<double, double, double>;
    const std::size_t last = branch.points.size() - 1;
    Place first = place(tree, branch.points.front()), end = place(tree, branch.points.back());
    Place middle = place(tree, branch.points[last / 2]), other = place(tree, branch.points[last - last / 2]);
    if (end < first) std::swap(first, end), std::swap(middle, other);
    return std::tuple(branch.points.size(), first, end, middle, other);
}

const tree::Branch& branch_of(const tree::VesselTree& tree, int id) {
    return tree.branches[static_cast<std::size_t>(id)];
}

auto start_of(const tree::VesselTree& tree, int branch) { return place(tree, branch_of(tree, branch).points.front()); }
auto end_of(const tree::VesselTree& tree, int branch) { return place(tree, branch_of(tree, branch).points.back()); }

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

BranchMap BranchMap::read_again(const tree::VesselTree& before, const tree::VesselTree& after) {
    BranchMap map(before, after, false);
    map.same_shape_ = same_shape(before, after);
    const std::vector<int> same = same_branches(before, after);
    for (std::size_t id = 0; id < same.size(); ++id)
        if (same[id] != kNoBranch) map.became_[id] = {same[id]};
    return map;
}

BranchMap BranchMap::edited(const tree::VesselTree& before, const tree::EditedTree& after) {
    BranchMap map(before, after.tree, true);
    map.mostly_.resize(before.branches.size());
    for (std::size_t id = 0; id < after.sources.size(); ++id) {
        const std::vector<int>& sources = after.sources[id];
        for (const int source : sources) map.became_[static_cast<std::size_t>(source)].push_back(static_cast<int>(id));
        if (!sources.empty()) map.mostly_[static_cast<std::size_t>(sources.front())].push_back(static_cast<int>(id));
    }
    return map;
}

const std::vector<int>& BranchMap::in(const Lists& lists, int branch) {
    static const std::vector<int> none;
    return branch >= 0 && static_cast<std::size_t>(branch) < lists.size() ? lists[static_cast<std::size_t>(branch)]
                                                                          : none;
}

const std::vector<int>& BranchMap::became(int branch) const { return in(became_, branch); }

const std::vector<int>& BranchMap::mostly(int branch) const { return in(mostly_.empty() ? became_ : mostly_, branch); }

std::optional<measure::BranchPlace> BranchMap::place(const measure::BranchPlace& place) const {
    const std::vector<int>& ids = became(place.branch);
    if (ids.empty()) return {};
    if (!was_edited_) {
        const int now = ids.front();
        const bool turned = !same_shape_ && start_of(*before_, place.branch) == end_of(*after_, now);
        return measure::BranchPlace{now, turned ? 1.0 - place.fraction : place.fraction};
    }
    constexpr double kSame = 1e-6; // mm; positions are kept exactly, fractions are not
    const glm::dvec3 at = measure::point_on(*before_, place.branch, place.fraction).position;
    std::optional<measure::BranchPlace> found;
    double nearest = kSame * (1.0 + glm::length(at));
    for (const int id : ids) {
        const double here = measure::nearest_fraction(*after_, id, at);
        const double distance = glm::distance(at, measure::point_on(*after_, id, here).position);
        if (distance < nearest) nearest = distance, found = {id, here};
    }
    return found;
}

CarriedOver carried_over(const Marks& marks, const BranchMap& map) {
    CarriedOver carried{marks, 0};
    for (const MarksRow& row : marks_table())
        if (row.carry != nullptr) carried.lost += row.carry(carried.marks, map);
    return carried;
}

void follow_unit(Marks& marks, const TreeFile& file) {
    if (marks.comparison.mask != file.path.string()) return;
    marks.comparison.mask_units = marks.reading.unit ? spelled(*marks.reading.unit) : std::string();
}

namespace {

// The permutation and reflection of axes that maps one tree to the other, apart from scaling. Uses the first of all
// points; identity (RAS) unless something was turned.
io::Orientation turn_between(const tree::VesselTree& before, const tree::VesselTree& after, double scale, double size) {
    constexpr double kSame = 1e-6;
    constexpr std::size_t kLooked = 200; // places: if these agree, all do
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

std::optional<Way> carried_over(const Way& way, const BranchMap& map) {
    const auto end_after = [&](const WayEnd& end) -> std::optional<WayEnd> {
        if (end.branch < 0) return end;
        if (static_cast<std::size_t>(end.branch) >= map.before().branches.size()) return {};
        if (!end.fraction) {
            const std::vector<int>& became = map.mostly(end.branch);
            return became.size() == 1 ? std::optional(WayEnd{became.front()}) : std::nullopt;
        }
        const auto place = map.place({end.branch, *end.fraction});
        return place ? std::optional(WayEnd{place->branch, place->fraction}) : std::nullopt;
    };
    const auto from = end_after(way.from);
    if (!from || !way.to) return from ? std::optional(Way{*from}) : std::nullopt;
    const auto to = end_after(*way.to);
    return to ? std::optional(Way{*from, to}) : std::nullopt;
}

} // namespace ramus::app
