#include "app/session/session.h"

#include "app/session/branch_facts.h"
#include "app/session/marks_table.h"
#include "core/base/sort_unique.h"

#include <algorithm>
#include <array>
#include <utility>

namespace ramus::app {

using tree::BranchState;

std::filesystem::path subject_of(const Session& session) {
    const Marks& marks = session.marks;
    if (!session.tree.path.empty() || !has_objects_alone(marks)) return session.tree.path;
    return marks.context.empty() ? marks.scans.front().file : marks.context.front().file;
}

void number_objects(Marks& marks) {
    int largest = kNoObject;
    for_each_object(marks, [&](const SceneObject auto& object) { largest = std::max(largest, object.id); });
    for_each_object(marks, [&](SceneObject auto& object) {
        if (object.id == kNoObject) object.id = ++largest;
    });
}

std::vector<std::array<double, 4>> spheres_of(const Marks& marks) {
    std::vector<std::array<double, 4>> spheres;
    for (const Lesion& lesion : marks.lesions)
        if (!lesion.is_mesh()) spheres.push_back(lesion.sphere);
    return spheres;
}

std::vector<Lesion> lesion_meshes(const Marks& marks) {
    std::vector<Lesion> meshes;
    for (const Lesion& lesion : marks.lesions)
        if (lesion.is_mesh())
            meshes.push_back({.file = lesion.file,
                              .axes = lesion.axes,
                              .labels = lesion.labels,
                              .units = lesion.units,
                              .part = lesion.part});
    return meshes;
}

std::vector<std::string> lesion_files(const Marks& marks) {
    std::vector<std::string> files;
    for (const Lesion& lesion : marks.lesions)
        if (lesion.is_mesh()) files.push_back(lesion.file);
    return files;
}

std::optional<std::size_t> lesion_index(const Marks& marks, int id) {
    const auto lesion = std::ranges::find(marks.lesions, id, &Lesion::id);
    if (id == kNoObject || lesion == marks.lesions.end()) return {};
    return static_cast<std::size_t>(lesion - marks.lesions.begin());
}

void add_lesion(Marks& marks, Lesion lesion) {
    const auto place = lesion.is_mesh() ? marks.lesions.end() : std::ranges::find_if(marks.lesions, &Lesion::is_mesh);
    marks.lesions.insert(place, std::move(lesion));
}

std::size_t remove_object(Marks& marks, std::vector<Lesion>& list, std::size_t index) {
    const auto at = list.begin() + static_cast<std::ptrdiff_t>(index);
    std::size_t gone = std::erase_if(marks.measurements, [id = at->id](const Measurement& measurement) {
        return std::ranges::find(measurement.lesions, id) != measurement.lesions.end();
    });
    gone += std::erase_if(marks.resections, [id = at->id](const Resection& one) { return one.lesion == id; });
    for (OperationPlan& plan : marks.plans.others)
        std::erase_if(plan.resections, [id = at->id](const Resection& one) { return one.lesion == id; });
    list.erase(at);
    return gone;
}

void change_lesion(Marks& marks, std::size_t index, const std::array<double, 4>& sphere) {
    Lesion& lesion = marks.lesions[index];
    const std::array<double, 4> before = std::exchange(lesion.sphere, sphere);
    const glm::dvec3 from(before[0], before[1], before[2]), to(sphere[0], sphere[1], sphere[2]);
    for (Measurement& measurement : marks.measurements)
        for (std::size_t i = 0; i < point_count(measurement); ++i)
            if (measurement.lesions[i] == lesion.id && before[3] > 0.0)
                measurement.points[i] = to + sphere[3] / before[3] * (measurement.points[i] - from);
}

std::string_view name_of(tree::BranchState state) {
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

bool names_lesion(const Measurement& measurement) {
    return std::ranges::any_of(measurement.lesions, [](int id) { return id != kNoObject; });
}

bool measure_alike(const Measurement& a, const Measurement& b) {
    Measurement other = b;
    other.id = a.id, other.name = a.name, other.visible = a.visible, other.colour = a.colour;
    return other == a;
}

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
