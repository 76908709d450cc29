#include "app/assets/organ_text.h"

#include <algorithm>
#include <utility>

namespace ramus::app {

namespace {

OrganFact of_volume(std::string label, double mm3, std::optional<double> percent, std::string help) {
    return {std::move(label), mm3, percent, {}, {}, std::move(help)};
}
OrganFact of_share(std::string label, double percent, std::string help) {
    return {std::move(label), {}, percent, {}, {}, std::move(help)};
}

// A volume and its share of another.
OrganFact share(std::string label, const Operation& operation, double voxels, double of_voxels, std::string help) {
    return of_volume(std::move(label), 1000.0 * operation.voxel_ml() * voxels,
                     of_voxels > 0.0 ? 100.0 * voxels / of_voxels : 0.0, std::move(help));
}

void add_removed(std::vector<OrganFact>& facts, const Operation& operation) {
    const auto whole = static_cast<double>(operation.of.supply->of.mask->organ.count());
    facts.push_back(share("Removed", operation, operation.removed, whole, "What resections remove of the organ"));
    facts.push_back(
        share("Remnant", operation, whole - operation.removed, whole, "What resections leave of the organ"));
    facts.push_back({"Cut surface", {}, {}, operation.area_mm2, {}, "Area that resections leave within the organ"});
    for (std::size_t n = 0; n < operation.margins.size(); ++n) {
        const organ::Margin& margin = operation.margins[n];
        const std::string removed = margin.removed == organ::Removed::kWhole  ? "The lesion is removed as a whole"
                                    : margin.removed == organ::Removed::kPart ? "Part of the lesion stays"
                                                                              : "The lesion stays";
        facts.push_back({"Margin of " + operation.of.lesions[n].name,
                         {},
                         {},
                         {},
                         margin.distance_mm,
                         removed + "; the shortest distance from its surface to the cut surface"});
    }
}

void add_remnant(std::vector<OrganFact>& facts, const Operation& operation) {
    const organ::PartRemnant& found = operation.remnant;
    const auto add = [&](const char* label, double voxels, const char* help) {
        facts.push_back(share(label, operation, voxels, operation.functional, help));
    };
    const bool supply = operation.has(organ::Role::kSupplies), drainage = operation.has(organ::Role::kDrains);
    if (supply)
        add("Keeps supply", found.supplied,
            "What remains and is still reached by the vessels that supply, in percent of the functional organ");
    if (drainage) add("Keeps drainage", found.drained, "What remains and is still reached by the vessels that drain");
    if (!supply || !drainage) return;
    add("Keeps both", found.both, "What remains supplied and drained");
    add("Not drained", found.congested(), "What keeps its supply and loses its drainage: congested");
    add("Not supplied", found.unsupplied(), "What keeps its drainage and loses its supply");
}

void add_systems(std::vector<OrganFact>& facts, const Operation& operation, const Marks& marks) {
    const OrganSupply& supply = *operation.of.supply;
    const Systems& systems = systems_of(*supply.of.tree, marks);
    for (std::size_t system = 0; system < systems.size(); ++system) {
        const bool drains = operation.of.roles[system] == organ::Role::kDrains;
        const std::string name = system_name(systems, static_cast<int>(system));
        if (!supply.reaches(system))
            facts.push_back({name, {}, {}, {}, {}, "No branch of this system reaches the organ"});
        else if (const double lost = operation.remnant.lost[system]; lost > 0.0)
            facts.push_back(share(name + " loses", operation, lost, operation.functional,
                                  drains ? "What remains and this system no longer drains"
                                         : "What remains and this system no longer supplies"));
    }
}

void add_ratios(std::vector<OrganFact>& facts, const Operation& operation, const OrganChoice& choice) {
    const double kept_ml = operation.voxel_ml() * operation.remnant.both;
    if (choice.weight_kg > 0.0)
        facts.push_back(of_share("Of the body's weight", 0.1 * kept_ml / choice.weight_kg,
                                 "What keeps both, at 1 g/ml, in percent of the body's weight; customary least " +
                                     rounded(choice.least_of_weight) + " %"));
    if (const auto standard = standard_liver_ml(choice.weight_kg, choice.height_cm)) {
        facts.push_back(of_volume("Standard liver", 1000.0 * *standard, {},
                                  "Usual for adults of this size: -794.41 + 1267.28 times the body surface in "
                                  "m\xC2\xB2 (Vauthey 2002)"));
        facts.push_back(of_share("Of the standard liver", 100.0 * kept_ml / *standard,
                                 "What keeps both, in percent of the standard liver; customary least " +
                                     rounded(choice.least_of_standard) + " %"));
    }
}

} // namespace

std::string OrganFact::value(const Lengths& lengths) const {
    std::string text = volume   ? lengths.volume(*volume)
                       : area   ? lengths.area(*area)
                       : length ? lengths.text(*length)
                                : std::string();
    if (percent) text += (text.empty() ? "" : ", ") + digits(*percent) + " %";
    return text.empty() ? "none" : text;
}

std::vector<OrganFact> organ_facts(const Operation& operation, const Marks& marks) {
    const OrganMask& mask = *operation.of.supply->of.mask;
    std::vector<OrganFact> facts{of_volume("Organ", 1000.0 * mask.organ.volume_ml(), {}, "All voxels of the mask"),
                                 of_volume("Functional", 1000.0 * operation.voxel_ml() * operation.functional, {},
                                           Lengths(mask.claims)
                                               .worded("Without lesions and vessels of at least " +
                                                       rounded(marks.organ.large_vessels_mm) + " mm"))};
    if (!operation.of.resections.empty()) add_removed(facts, operation);
    if (!operation.of.cuts.empty() || !operation.of.resections.empty()) {
        add_remnant(facts, operation);
        add_systems(facts, operation, marks);
    }
    if (mask.claims.has_unit()) add_ratios(facts, operation, marks.organ);
    return facts;
}

std::vector<PlanFigure> plan_figures(const Assets& assets, const Marks& marks, OperationOf which) {
    std::vector<PlanFigure> figures;
    for (std::size_t plan = 0; plan < marks.plans.count(); ++plan) {
        const auto operation = operation_of(assets, marks, plan, which);
        if (!operation) continue;
        const Lengths lengths(operation->of.supply->of.mask->claims);
        for (const OrganFact& fact : organ_facts(*operation, marks)) {
            auto figure = std::ranges::find(figures, fact.label, &PlanFigure::label);
            if (figure == figures.end())
                figure = figures.insert(figures.end(),
                                        {fact.label, fact.help, std::vector<std::string>(marks.plans.count())});
            figure->values[plan] = fact.value(lengths);
        }
    }
    return figures;
}

} // namespace ramus::app
