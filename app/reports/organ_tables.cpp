#include "app/reports/organ_tables.h"

#include "app/assets/assets.h"
#include "app/assets/organ_text.h"
#include "app/assets/territories.h"
#include "app/session/numbers.h"
#include "app/session/systems.h"

#include <utility>

namespace ramus::app {

Table organ_table(const Document& document, const Assets& assets) {
    Table table{"Organ",
                {{"plan", "Plan"},
                 {"figure", "Figure"},
                 {"volume", "Volume, mm\xC2\xB3"},
                 {"area", "Area, mm\xC2\xB2"},
                 {"length", "Length, mm"},
                 {"percent", "Percent"},
                 {"meaning", "Meaning"}},
                {}};
    const auto cell = [](const std::optional<double>& number) { return number ? Cell(*number) : Cell(""); };
    const Marks& marks = document.marks();
    const std::vector<OperationPlan> plans = all_plans(marks);
    for (std::size_t plan = 0; plan < plans.size(); ++plan)
        if (const auto operation = operation_of(assets, marks, plan))
            for (const OrganFact& fact : organ_facts(*operation, marks))
                table.rows.push_back({plans[plan].name, fact.label, cell(fact.volume), cell(fact.area),
                                      cell(fact.length), cell(fact.percent), fact.help});
    add_unit(table, Lengths(assets.organ.mask.value.value()->claims));
    return table;
}

Table plans_table(const Document& document, const Assets& assets) {
    const Marks& marks = document.marks();
    const std::vector<OperationPlan> plans = all_plans(marks);
    Table table{"Organ and operation", {{"figure", "Figure"}}, {}};
    for (const OperationPlan& plan : plans) table.columns.push_back({"plan " + plan.name, "Plan " + plan.name});
    table.columns.push_back({"meaning", "Meaning"});
    for (const PlanFigure& figure : plan_figures(assets, marks, OperationOf::kNow)) {
        std::vector<Cell> row{figure.label};
        for (const std::string& value : figure.values) row.emplace_back(value.empty() ? "\xE2\x80\x93" : value);
        row.emplace_back(figure.help);
        table.rows.push_back(std::move(row));
    }
    return table;
}

Table cut_vessels_table(const Document& document, const Assets& assets) {
    return cut_vessels_table(document, *operation_of(assets, document.marks(), document.marks().plans.place));
}

Table cut_vessels_table(const Document& document, const Operation& operation) {
    Table table{"Vessels that are cut",
                {{"resection", "Resection"},
                 {"system", "System"},
                 {"branch", "Branch"},
                 {"name", "Name"},
                 {"fraction", "At"},
                 {"diameter", "Diameter, mm"},
                 {"over_limit", "Over " + digits(document.marks().planning.reconstruct_mm) + " mm"},
                 {"angle", "Angle, \xC2\xB0"},
                 {"x", "x, mm"},
                 {"y", "y, mm"},
                 {"z", "z, mm"}},
                {}};
    const Marks& marks = document.marks();
    for (const organ::CutVessel& vessel : operation.vessels) {
        if (!vessel.in_organ) continue;
        const auto name = marks.names.find(vessel.place.branch);
        const bool by_resection = vessel.resection < operation.of.resections.size();
        table.rows.push_back({by_resection ? Cell(static_cast<int>(vessel.resection + 1)) : Cell("cut"),
                              system_of(*document.tree(), marks, vessel.place.branch), vessel.place.branch,
                              name == marks.names.end() ? std::string() : name->second, vessel.place.fraction,
                              vessel.diameter_mm, vessel.diameter_mm > marks.planning.reconstruct_mm ? "yes" : "no",
                              vessel.angle_deg, vessel.at.x, vessel.at.y, vessel.at.z});
    }
    add_unit(table, document.lengths());
    return table;
}

Table territories_table(const Document& /*document*/, const Assets& assets) {
    Table table{
        "Territories", {{"name", "Name"}, {"volume", "Volume, mm\xC2\xB3"}, {"percent", "Percent of the organ"}}, {}};
    const OrganTerritories& territories = *assets.organ.territories;
    for (const OrganTerritories::Part& part : territories.parts)
        table.rows.push_back({part.name, territories.volume_mm3(part), territories.percent(part)});
    add_unit(table, Lengths(territories.of.supply->of.mask->claims));
    return table;
}

} // namespace ramus::app
