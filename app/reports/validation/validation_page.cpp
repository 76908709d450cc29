#include "app/reports/validation/validation_page.h"

#include "app/reports/plots/distance_plots.h"
#include "app/reports/validation/branch_radii.h"
#include "app/reports/validation/validation_tables.h"
#include "app/session/numbers.h"

#include <algorithm>
#include <array>

namespace ramus::app {

namespace {

constexpr std::array kAllHeld{Held::kToCones, Held::kToMask, Held::kFromMask};
constexpr const char* kHalfVoxel = "half the diagonal of the mask's voxels";

const Stroke& stroke_of(Held how) { return how == Held::kToCones ? kConesStroke : kMaskStroke; }

// A table for the page, with the unit of its lengths.
Table said(Table table, const Lengths& lengths) {
    add_unit(table, lengths);
    return table;
}

// A table whose last rows, without a number, are for all data sets.
std::string table_of_sets(const Table& table, bool is_part) {
    const auto is_sum = [](const std::vector<Cell>& row) { return !row.front().number; };
    return table_html(for_people(table), {.sums = static_cast<std::size_t>(std::ranges::count_if(table.rows, is_sum)),
                                          .is_part = is_part});
}

std::string figure_html(const Svg& plot) { return "<figure>" + plot.drawing() + "</figure>\n"; }

std::string summary_html(std::span<const ValidatedDataSet> sets) {
    const bool several = sets.size() > 1;
    std::string note = "For each vertex of the one surface the distance to the nearest point of the other one, mm.";
    const Lengths lengths = lengths_of(sets);
    if (several)
        note += " The average is the mean of the data sets' figures, each data set weighing the same, not the figures "
                "of all vertices together; the standard deviation is that of these figures.";
    std::string text = "<h2>Distances</h2>\n<p class=\"quiet\">" + html_text(lengths.worded(note)) + "</p>\n";
    std::string plots;
    for (const Held how : kAllHeld) {
        if (how != Held::kToCones && !has_mask(sets)) continue;
        text += table_of_sets(distance_table(sets, how), true);
        plots += figure_html(boxes_of(sets, how));
        if (several) continue;
        const SurfaceDistances& distances = *distances_of(sets.front(), how);
        plots += figure_html(histogram_plot(title_of(how), distances.statistics, stroke_of(how),
                                            sets.front().half_voxel_mm, kHalfVoxel, lengths.unit()));
    }
    return text + "<div class=\"plots\">\n" + plots + "</div>\n";
}

// The questions with findings, each with its places.
std::string places_html(const ValidatedDataSet& set) {
    const validate::Validation& found = set.validation;
    const Lengths lengths(set.claims);
    const TableLook look{.is_part = true, .all_rows_in = "places.csv"};
    std::string text, none;
    struct Question {
        Table table;
        const char* note;
    };
    const std::array questions{
        Question{lost_table(found), "Stretches of centerline outside of the surface, or where it is less than half as "
                                    "wide as the vessel."},
        Question{false_table(found), "Parts of the surface with no centerline."},
        Question{merged_table(found), "Vessels that pass each other without a joint and are one in the surface. A gap "
                                      "below 0 is an overlap."},
        Question{constrictions_table(found), "Narrow places whose radius the surface changes by more than 10 %."},
        Question{widths_table(found), "Stretches that are wider or narrower than in the tree by more than 10 %; radii "
                                      "are means along the vessel."},
        Question{positions_table(found), "Stretches whose axis is off the tree's centerline by more than a third of "
                                         "the radius, as the mean along the vessel."}};
    for (const Question& question : questions) {
        if (question.table.rows.empty()) {
            none += (none.empty() ? "" : ", ") + question.table.title;
            continue;
        }
        TableLook with_note = look;
        with_note.note = question.note;
        text += table_html(said(question.table, lengths), with_note);
    }
    if (!none.empty()) text += "<p><strong>None:</strong> " + html_text(none) + ".</p>\n";
    return text;
}

std::string radii_html(const ValidatedDataSet& set, std::size_t most) {
    const Table table = worst_branches_table(set, most);
    if (table.rows.empty())
        return "<p class=\"quiet\">No place is away from joints, ends and other vessels: there is no error of the "
               "radius.</p>\n";
    const Lengths lengths(set.claims);
    const validate::RadiusError& error = set.validation.radius_error;
    const std::string note = "The radius of a circle as large as the surface's cross-section, against what was read, "
                             "away from joints, ends and other vessels (elsewhere the plots are grey): over " +
                             counted(error.places, "place", "places") + " the median error is " +
                             digits(100.0 * error.median) + " %, the 95th percentile " + digits(100.0 * error.p95) +
                             " %. radii.csv has all branches.";
    std::string text = table_html(said(table, lengths), {.note = note, .is_part = true}) + "<div class=\"plots\">\n";
    for (const validate::BranchError& branch : validate::worst_branches(set.validation, most))
        text +=
            figure_html(radius_plot("Branch " + std::to_string(branch.branch), curves_of(set, branch), lengths.unit()));
    return text + "</div>\n";
}

std::string data_set_html(const ValidatedDataSet& set, std::size_t number, bool several) {
    std::string text = "<section class=\"data-set\">\n";
    if (several) {
        text += "<h2>" + std::to_string(number) + ". " + html_text(name_of(set)) + "</h2>\n" +
                pictures_html(set.pictures) + "<div class=\"plots\">\n";
        for (const Held how : kAllHeld)
            if (const SurfaceDistances* distances = distances_of(set, how))
                text += figure_html(histogram_plot(title_of(how), distances->statistics, stroke_of(how),
                                                   set.half_voxel_mm, kHalfVoxel, Lengths(set.claims).unit()));
        text += "</div>\n";
    }
    text += several ? "<h3>Found places</h3>\n" : "<h2>Found places</h2>\n";
    text += places_html(set) + even_pictures_html(set.close_ups);
    text += several ? "" : "<h2>Worst places</h2>\n";
    text += radii_html(set, several ? 4 : 6);
    for (const Held how : kAllHeld)
        if (const Table far = farthest_table(set, how); !far.rows.empty())
            text += table_html(said(far, Lengths(set.claims)), {.is_part = true});
    return text + "</section>\n";
}

} // namespace

std::string validation_page(std::span<const ValidatedDataSet> sets, const Facts& settings, const std::string& made) {
    const bool several = sets.size() > 1;
    std::string page =
        page_begin(several ? "Validation of " + counted(sets.size(), "data set", "data sets") : name_of(sets.front()),
                   several ? "Surfaces held against their trees" : "Surface held against its tree", made);
    if (!several) page += pictures_html(sets.front().pictures);
    page += table_of_sets(questions_table(sets), false);
    page += table_of_sets(fidelity_table(sets), true);
    if (const Table volumes = volumes_table(sets); !volumes.rows.empty()) page += table_of_sets(volumes, true);
    if (const Table shapes = shape_table(sets); !shapes.rows.empty()) page += table_html(shapes, {.is_part = true});
    page += summary_html(sets);
    for (std::size_t i = 0; i < sets.size(); ++i) page += data_set_html(sets[i], i + 1, several);
    page += "<h2>Settings</h2>\n" + facts_html(settings);
    page += "<div class=\"sums\">\n" + table_html(files_table(sets)) + "</div>\n";
    return page + page_end();
}

Svg boxes_of(std::span<const ValidatedDataSet> sets, Held how) {
    std::vector<BoxRow> rows;
    const bool mixed = by_unit(sets).size() > 1;
    for (const ValidatedDataSet& set : sets)
        if (const SurfaceDistances* distances = distances_of(set, how))
            rows.push_back({name_of(set) + (mixed ? ", " + std::string(set.claims.unit_word()) : ""),
                            &distances->statistics, set.half_voxel_mm});
    return box_plots(title_of(how), rows, stroke_of(how), kHalfVoxel, lengths_of(sets).unit());
}

bool has_mask(std::span<const ValidatedDataSet> sets) {
    for (const ValidatedDataSet& set : sets)
        if (set.to_mask) return true;
    return false;
}

} // namespace ramus::app
