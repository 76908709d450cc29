#include "app/session/plan.h"

#include "app/session/branch_facts.h"

namespace ramus::app {

Plan make_plan(const tree::VesselTree& tree, const TreeFacts& facts, const Marks& marks) {
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
    if (!plan.lesions.empty()) {
        plan.lesion_distances_mm = measure::wall_distances(tree, plan.lesions);
        plan.bands =
            measure::band_table(plan.lesion_distances_mm, marks.planning.bands_mm, facts.statistics, facts.dependents);
    }
    plan.cuts =
        measure::cut_report(tree, facts.dependency, facts.dependents, marks.cuts, marks.planning.reconstruct_mm);
    return plan;
}

bool same_plan(const Marks& a, const Marks& b) {
    return a.lesions == b.lesions && a.lesion_meshes == b.lesion_meshes && a.cuts == b.cuts && a.planning == b.planning;
}

} // namespace ramus::app
