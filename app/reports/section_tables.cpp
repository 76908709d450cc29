#include "app/reports/section_tables.h"

#include "app/assets/assets.h"
#include "core/base/words.h"

#include <algorithm>
#include <iterator>

namespace ramus::app {

namespace {

const slice::Lumen* lumen_at(const Lumens& lumens, std::size_t n) {
    return n < lumens.size() && lumens[n] ? &*lumens[n] : nullptr;
}

std::vector<Cell> cells_of_lumen(const slice::Lumen* lumen) {
    if (lumen == nullptr) return {"", "", "", ""};
    const slice::ShapeFigures& one = lumen->figures;
    return {one.area_mm2, one.equivalent_mm, one.least_mm, one.largest_mm};
}

std::vector<Column> section_columns(bool has_mask) {
    const auto internal = [](const char* name) { return Column{name, name, 3, true}; };
    std::vector<Column> columns{{"arc", "Along, mm"}, {"branch", "Branch"}, {"fraction", "Fraction"},
                                internal("x"),        internal("y"),        internal("z"),
                                internal("normal_x"), internal("normal_y"), internal("normal_z")};
    columns.insert(columns.end(), {{"area", "Area, mm\xC2\xB2"},
                                   {"equivalent_diameter", "Equivalent \xC3\x98, mm"},
                                   {"least_diameter", "Least \xC3\x98, mm"},
                                   {"largest_diameter", "Largest \xC3\x98, mm"},
                                   {"closed", "Closed"},
                                   {"shared_with", "Shared with"},
                                   internal("file_radius")});
    if (has_mask)
        for (const char* name :
             {"mask_area", "mask_equivalent_diameter", "mask_least_diameter", "mask_largest_diameter"})
            columns.push_back({name, name});
    return columns;
}

} // namespace

Table sections_table(std::span<const slice::PathSample> samples, const Outlines& sections, const Lengths& lengths) {
    const bool has_mask = !sections.mask.empty();
    Table table{"Cross-sections", section_columns(has_mask), {}};
    for (std::size_t n = 0; n < samples.size(); ++n) {
        const slice::PathSample& one = samples[n];
        const slice::Lumen* lumen = lumen_at(sections.surface, n);
        std::vector<Cell> row{one.arc_mm, one.place.branch, one.place.fraction, one.at.x,     one.at.y,
                              one.at.z,   one.tangent.x,    one.tangent.y,      one.tangent.z};
        std::ranges::copy(cells_of_lumen(lumen), std::back_inserter(row));
        row.emplace_back(lumen == nullptr ? "" : lumen->closed ? "yes" : "no");
        row.emplace_back(lumen == nullptr ? std::string() : joined(lumen->shared_with, " ", [](int branch) {
            return std::to_string(branch);
        }));
        row.emplace_back(one.radius_mm);
        if (has_mask) std::ranges::copy(cells_of_lumen(lumen_at(sections.mask, n)), std::back_inserter(row));
        table.rows.push_back(std::move(row));
    }
    add_unit(table, lengths);
    return table;
}

bool has_sections(const Document& document, const Assets& assets) {
    return document.session().slices.along && assets.followed.path && assets.sections &&
           assets.sections->path == assets.followed.path;
}

Table followed_sections_table(const Document& document, const Assets& assets) {
    const VesselSections& sections = *assets.sections;
    std::vector<slice::PathSample> samples;
    Outlines outlines;
    for (const slice::PathSample& usual : usual_samples(*sections.path)) {
        const std::size_t nearest = sections.path->nearest(usual.arc_mm);
        samples.push_back(sections.path->samples[nearest]);
        outlines.surface.push_back(sections.lumens[nearest]);
    }
    Table table = sections_table(samples, outlines, document.lengths());
    table.title = "Cross-sections along the vessel";
    return table;
}

bool has_stenosis(const Document& document, const Assets& assets) {
    if (!has_sections(document, assets)) return false;
    const auto& choice = document.session().slices.along->stenosis;
    return choice && narrow_places(*assets.sections, *choice).has_value();
}

Table stenosis_table(const Document& document, const Assets& assets) {
    Table table{"Stenosis",
                {{"measure", "Measure"},
                 {"percent", "Less than the reference, %"},
                 {"least", "Least, mm or mm\xC2\xB2"},
                 {"reference", "Reference, mm or mm\xC2\xB2"},
                 {"arc", "At, mm along"},
                 {"branch", "Branch"}},
                {}};
    if (!has_sections(document, assets) || !document.session().slices.along->stenosis) return table;
    const VesselSections& sections = *assets.sections;
    const auto places = narrow_places(sections, *document.session().slices.along->stenosis);
    if (!places) return table;
    const auto add = [&](const char* measure, const slice::Narrowing& narrowing, double slice::ShapeFigures::*figure) {
        const slice::PathSample& at = sections.path->samples[narrowing.sample];
        table.rows.push_back({measure, narrowing.percent, (*sections.figures[narrowing.sample]).*figure,
                              places->reference.*figure, at.arc_mm, at.place.branch});
    };
    add("least diameter", places->found.least_diameter, &slice::ShapeFigures::least_mm);
    add("equivalent diameter", places->found.equivalent_diameter, &slice::ShapeFigures::equivalent_mm);
    add("area", places->found.area, &slice::ShapeFigures::area_mm2);
    add_unit(table, document.lengths());
    return table;
}

} // namespace ramus::app
