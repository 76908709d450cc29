#include "app/session/session.h"

#include "app/session/branch_facts.h"
#include "app/session/marks_table.h"
#include "core/base/sort_unique.h"

#include <algorithm>
#include <array>
#include <utility>

namespace ramus::app {

using render::BranchState;

std::filesystem::path subject_of(const Session& session) {
    if (!session.tree.path.empty() || session.marks.context.empty()) return session.tree.path;
    return session.marks.context.front().file;
}

std::string axes_of_lesion(const Marks& marks, const std::string& file) {
    const auto said = marks.lesion_axes.find(file);
    return said == marks.lesion_axes.end() ? std::string() : said->second;
}

std::size_t lesion_count(const Marks& marks) { return marks.lesions.size() + marks.lesion_meshes.size(); }

LesionRef lesion_at(const Marks& marks, std::size_t index) {
    const std::size_t spheres = marks.lesions.size();
    return index < spheres ? LesionRef{LesionRef::Shape::kSphere, static_cast<int>(index)}
                           : LesionRef{LesionRef::Shape::kMesh, static_cast<int>(index - spheres)};
}

std::size_t lesion_number(const Marks& marks, const LesionRef& lesion) {
    const auto index = static_cast<std::size_t>(lesion.index) + 1;
    return lesion.shape == LesionRef::Shape::kMesh ? marks.lesions.size() + index : index;
}

std::size_t remove_lesion(Marks& marks, const LesionRef& lesion) {
    const auto at = static_cast<std::ptrdiff_t>(lesion.index);
    if (lesion.shape == LesionRef::Shape::kMesh) {
        const auto file = marks.lesion_meshes.begin() + at;
        marks.lesion_axes.erase(*file);
        marks.lesion_meshes.erase(file);
    } else {
        marks.lesions.erase(marks.lesions.begin() + at);
    }
    const std::size_t gone = std::erase_if(marks.measurements, [&](const Measurement& measurement) {
        return std::ranges::find(measurement.lesions, lesion) != measurement.lesions.end();
    });
    for (Measurement& measurement : marks.measurements)
        for (LesionRef& other : measurement.lesions)
            if (other.shape == lesion.shape && other.index > lesion.index) --other.index;
    return gone;
}

void change_lesion(Marks& marks, std::size_t index, const std::array<double, 4>& sphere) {
    const std::array<double, 4> before = std::exchange(marks.lesions[index], sphere);
    const LesionRef lesion{LesionRef::Shape::kSphere, static_cast<int>(index)};
    const glm::dvec3 from(before[0], before[1], before[2]), to(sphere[0], sphere[1], sphere[2]);
    for (Measurement& measurement : marks.measurements)
        for (std::size_t i = 0; i < point_count(measurement); ++i)
            if (measurement.lesions[i] == lesion && before[3] > 0.0)
                measurement.points[i] = to + sphere[3] / before[3] * (measurement.points[i] - from);
}

std::string_view name_of(render::BranchState state) {
    constexpr std::array<std::string_view, 4> kNames{"normal", "highlighted", "defocused", "hidden"};
    return kNames[static_cast<std::size_t>(state)];
}

BranchState state_of(const Marks& marks, int branch) {
    const auto index = static_cast<std::size_t>(branch);
    return branch >= 0 && index < marks.states.size() ? marks.states[index] : BranchState::kNormal;
}

void set_state(Marks& marks, std::span<const int> branches, BranchState state) {
    for (const int branch : branches) {
        const auto index = static_cast<std::size_t>(branch);
        if (index >= marks.states.size()) marks.states.resize(index + 1, BranchState::kNormal);
        marks.states[index] = state;
    }
    while (!marks.states.empty() && marks.states.back() == BranchState::kNormal) marks.states.pop_back();
}

std::vector<int> branches_in_state(const Marks& marks, BranchState state) {
    return branches_where(marks.states.size(), [&](std::size_t id) { return marks.states[id] == state; });
}

std::vector<int> canonical(std::vector<int> branches) {
    sort_unique(branches);
    return branches;
}

bool is_selected(const Marks& marks, int branch) {
    return std::binary_search(marks.selection.begin(), marks.selection.end(), branch);
}

std::size_t point_count(const Measurement& measurement) {
    return measurement.kind == Measurement::Kind::kDistance && !measurement.shortest ? 2 : 0;
}

std::size_t place_count(const Measurement& measurement) {
    switch (measurement.kind) {
    case Measurement::Kind::kDistance:
        return measurement.shortest ? 1 : 0;
    case Measurement::Kind::kPath:
        return 2;
    case Measurement::Kind::kDiameter:
        return 1;
    case Measurement::Kind::kAngle:
        return of_branching(measurement) ? 1 : 3;
    }
    return 0;
}

bool of_branching(const Measurement& measurement) {
    return measurement.kind == Measurement::Kind::kAngle && measurement.places[1].branch == tree::kNoBranch;
}

bool names_lesion(const Measurement& measurement) { return std::ranges::any_of(measurement.lesions, &LesionRef::any); }

Marks with_looks(Marks marks, const Marks& looks) {
    for (const MarksRow& row : marks_table())
        if (row.is_look) row.take(marks, looks);
    return marks;
}

bool differ_in_looks_alone(const Marks& a, const Marks& b) {
    return std::ranges::all_of(marks_table(), [&](const MarksRow& row) { return row.is_look || row.same(a, b); });
}

Marks carry_looks(const Marks& before, const Marks& now, Marks after, bool same_branches) {
    const std::vector<int> selection = after.selection;
    for (const MarksRow& row : marks_table())
        if (row.is_look && row.same(after, before)) row.take(after, now);
    if (!same_branches) after.selection = selection;
    return after;
}

} // namespace ramus::app
