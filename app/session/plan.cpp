#include "app/session/plan.h"

#include "app/session/branch_facts.h"

namespace ramus::app {

namespace {

// Takes over the distances of an earlier plan of the same lesions; false: there is none.
bool take_distances(Plan& plan, const Plan* before) {
    if (before == nullptr || before->lesions.spheres != plan.lesions.spheres ||
        before->lesions.meshes != plan.lesions.meshes)
        return false;
    plan.lesion_distances_mm = before->lesion_distances_mm;
    return true;
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
    if (!take_distances(plan, before) && !plan.lesions.empty())
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
    if (!take_distances(plan, before)) {
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
