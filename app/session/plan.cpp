#include "app/session/plan.h"

#include "app/session/branch_facts.h"

namespace ramus::app {

namespace {

bool same_lesions(const measure::Lesions& a, const measure::Lesions& b) {
    return a.spheres == b.spheres && a.meshes == b.meshes;
}

// What takes no time, once the distances are there.
void conclude(Plan& plan, const tree::VesselTree& tree, const TreeFacts& facts, const Marks& marks) {
    if (!plan.lesion_distances_mm.empty())
        plan.bands =
            measure::band_table(plan.lesion_distances_mm, marks.planning.bands_mm, facts.statistics, facts.dependents);
    plan.cuts =
        measure::cut_report(tree, facts.dependency, facts.dependents, marks.cuts, marks.planning.reconstruct_mm);
}

} // namespace

Plan make_plan(const tree::VesselTree& tree, const TreeFacts& facts, const Marks& marks, const Plan* before) {
    Plan plan;
    plan.lesions.spheres = marks.lesions;
    for (const std::string& path : marks.lesion_meshes) {
        const auto mesh = lesion_mesh(path);
        plan.meshes.push_back(mesh ? *mesh : nullptr);
        if (mesh)
            plan.lesions.meshes.push_back((*mesh)->distance);
        else
            plan.troubles.push_back(mesh.error().message());
    }
    if (before != nullptr && !before->measuring && same_lesions(before->lesions, plan.lesions))
        plan.lesion_distances_mm = before->lesion_distances_mm;
    else if (!plan.lesions.empty())
        plan.lesion_distances_mm = measure::wall_distances(tree, plan.lesions);
    conclude(plan, tree, facts, marks);
    return plan;
}

Plan plan_so_far(const tree::VesselTree& tree, const TreeFacts& facts, const Marks& marks, const Plan* before) {
    Plan plan;
    plan.measuring = true;
    plan.lesions.spheres = marks.lesions;
    for (const std::string& path : marks.lesion_meshes) {
        plan.meshes.push_back(lesion_mesh_read_before(path));
        if (plan.meshes.back()) plan.lesions.meshes.push_back(plan.meshes.back()->distance);
    }
    if (before != nullptr && !before->measuring && same_lesions(before->lesions, plan.lesions))
        plan.lesion_distances_mm = before->lesion_distances_mm;
    else {
        plan.lesions.meshes.clear();
        if (!plan.lesions.empty()) plan.lesion_distances_mm = measure::wall_distances(tree, plan.lesions);
    }
    conclude(plan, tree, facts, marks);
    return plan;
}

bool same_plan(const Marks& a, const Marks& b) {
    return a.lesions == b.lesions && a.lesion_meshes == b.lesion_meshes && a.cuts == b.cuts && a.planning == b.planning;
}

} // namespace ramus::app
