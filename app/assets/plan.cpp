#include "app/assets/plan.h"

#include "app/assets/assets.h"

namespace ramus::app {

measure::Lesions loaded_lesions(const Assets& assets, const Marks& marks) {
    measure::Lesions lesions{marks.lesions, {}};
    for (const std::string& file : marks.lesion_meshes)
        if (const auto mesh = assets.lesion_mesh(file)) lesions.meshes.push_back(mesh->distance);
    return lesions;
}

PlannedMarks planned(const Marks& marks) { return {marks.lesions, marks.lesion_meshes, marks.cuts, marks.planning}; }

Plan make_plan(const Assets& assets, const Marks& marks) {
    Plan plan;
    plan.of = planned(marks);
    plan.lesions = loaded_lesions(assets, marks);
    for (const std::string& file : marks.lesion_meshes) {
        plan.meshes.push_back(assets.lesion_mesh(file));
        const auto loaded = assets.lesion_meshes.find(file);
        if (loaded == assets.lesion_meshes.end())
            plan.measuring = true;
        else if (!loaded->second.value)
            plan.troubles.push_back(loaded->second.value.error().message());
    }
    const LesionDistances& known = assets.lesion_distances;
    const bool fits = known.fits(plan.lesions);
    if (!fits && !plan.lesions.meshes.empty()) {
        plan.measuring = true;
        plan.lesions.meshes.clear();
    }
    if (!plan.lesions.empty())
        plan.lesion_distances_mm = fits ? known.mm : measure::wall_distances(*assets.tree, plan.lesions);
    const TreeFacts& facts = *assets.facts;
    if (!plan.lesion_distances_mm.empty())
        plan.bands =
            measure::band_table(plan.lesion_distances_mm, marks.planning.bands_mm, facts.statistics, facts.dependents);
    plan.cuts = measure::cut_report(*assets.tree, facts.dependency, facts.dependents, marks.cuts,
                                    marks.planning.reconstruct_mm);
    return plan;
}

} // namespace ramus::app
