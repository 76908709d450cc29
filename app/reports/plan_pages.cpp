#include "app/reports/plan_pages.h"

#include "app/assets/assets.h"
#include "app/assets/organ_text.h"
#include "app/picture/scene_objects.h"
#include "app/reports/organ_tables.h"
#include "app/reports/plots/flat_map_plot.h"
#include "app/session/numbers.h"

namespace ramus::app {

namespace {

constexpr const char* kMethod =
    "Estimated by distance: a scan shows the thick branches only, and each voxel of the organ is given to the branch "
    "whose visible tip or axis is nearest. Volumes are those of the mask's voxels, in part where a resection divides "
    "one. For planning, with the scan itself; not a measurement of function.";
constexpr const char* kMapNote =
    "The cut surface as it is seen after the part is removed, projected along its normal; areas are true for planes. "
    "Circles: vessels that are cut, in the colours of their systems.";

Facts facts_of(const Operation& operation, const Marks& marks) {
    const Lengths lengths(operation.of.supply->of.mask->claims);
    Facts facts;
    for (const OrganFact& fact : organ_facts(operation, marks)) facts.emplace_back(fact.label, fact.value(lengths));
    return facts;
}

std::string maps_html(const Operation& operation, const Marks& marks, const Assets& assets, const Lengths& lengths) {
    std::string plots;
    for (std::size_t n = 0; n < operation.of.resections.size(); ++n) {
        const auto map = flat_map_of(operation, n, marks);
        if (!map) continue;
        const std::string title = words_of(marks.resections[n], n, assets, lengths).title;
        plots += "<figure>" +
                 flat_map_plot("Cut surface, " + title, *map, operation.of.supply->of.mask->claims).drawing() +
                 "<figcaption>" + html_text(title) + "</figcaption></figure>\n";
    }
    if (plots.empty()) return {};
    return "<h3>Cut surfaces, laid flat</h3>\n<p class=\"quiet\">" + html_text(kMapNote) +
           "</p>\n<div class=\"plots\">\n" + plots + "</div>\n";
}

// `marks`: with the plan as the current one.
std::string plan_html(const Document& document, const Operation& operation, const Marks& marks, const Assets& assets,
                      const std::vector<ReportPicture>& pictures) {
    constexpr std::size_t kMostVessels = 12; // so that the plan fits on a page
    std::string page = "<section class=\"page\">\n<h2>Plan " + html_text(marks.plans.name) + "</h2>\n" +
                       even_pictures_html(pictures) + facts_html(facts_of(operation, marks));
    if (!operation.vessels.empty())
        page += table_html(cut_vessels_table(document, operation),
                           {.note = document.lengths().worded("The thickest first; those over " +
                                                              digits(marks.planning.reconstruct_mm) +
                                                              " mm are set off. Angle: 90 is straight across."),
                            .flag_column = "over_limit",
                            .is_part = true,
                            .most_rows = kMostVessels,
                            .all_rows_in = "the table of vessels that are cut as .csv, of the current plan,"});
    return page + maps_html(operation, marks, assets, document.lengths()) + "</section>\n";
}

} // namespace

std::string plans_html(const Document& document, const Assets& assets,
                       const std::vector<std::vector<ReportPicture>>& pictures) {
    const Marks& marks = document.marks();
    if (!operation_of(assets, marks, marks.plans.place)) return {};
    std::string pages;
    for (std::size_t plan = 0; plan < marks.plans.count(); ++plan) {
        const auto operation = operation_of(assets, marks, plan);
        if (!operation) continue;
        Marks of_plan = marks;
        use_plan(of_plan, plan);
        pages += plan_html(document, *operation, of_plan, assets,
                           plan < pictures.size() ? pictures[plan] : std::vector<ReportPicture>());
    }
    return pages + "<section class=\"page\">\n" + table_html(plans_table(document, assets), {.note = kMethod}) +
           "</section>\n";
}

} // namespace ramus::app
