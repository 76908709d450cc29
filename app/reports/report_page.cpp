#include "app/reports/report_page.h"

#include "app/assets/assets.h"
#include "app/reports/plan_pages.h"
#include "app/reports/report_tables.h"
#include "app/reports/surface_facts.h"
#include "app/reports/table_kinds.h"
#include "app/session/colour_by.h"
#include "app/session/numbers.h"

#include <cstdint>
#include <filesystem>
#include <numbers>
#include <utility>

namespace ramus::app {

namespace {

std::string range_text(double least, double most) { return digits(least) + " to " + digits(most) + " mm"; }

Facts worded(Facts facts, const Lengths& lengths) {
    for (auto& [name, value] : facts) value = lengths.worded(value);
    return facts;
}

std::string claim_text(tree::SaidBy who, const std::string& known, const std::string& open) {
    return who == tree::SaidBy::kFile     ? known + ", as the file says"
           : who == tree::SaidBy::kPerson ? known + ", as the user says"
                                          : open;
}

Facts tree_facts(const Document& document) {
    const TreeFacts& facts = *document.facts();
    const tree::VesselTree& tree = *document.tree();
    const Marks& marks = document.marks();
    const auto count = [&](tree::BranchState state) { return grouped(branches_in_state(marks, state).size()); };
    Facts found{{"File", document.session().tree.path.filename().string()},
                {"Checksum", document.session().tree.checksum.empty() ? "not known" : document.session().tree.checksum},
                {"Branches", grouped(tree.branches.size())},
                {"Generations", grouped(static_cast<std::uint64_t>(facts.statistics.generations))},
                {"Length", document.lengths().text(facts.statistics.length_mm)},
                {"Volume", document.lengths().volume(facts.statistics.volume_mm3)},
                {"Diameters", range_text(2.0 * facts.statistics.radius_mm.min, 2.0 * facts.statistics.radius_mm.max)},
                {"Roots", grouped(tree.roots.size())},
                {"Dependency", nothing_depends(facts) ? kNothingDepends : "by the way from the roots"},
                {"Loops", grouped(static_cast<std::uint64_t>(tree.loop_count))},
                {"Repairs on reading", grouped(sentences(tree, tree::Note::Kind::kRepaired).size())},
                {"Selected", grouped(marks.selection.size())},
                {"Highlighted", count(tree::BranchState::kHighlighted)},
                {"Defocused", count(tree::BranchState::kDefocused)},
                {"Hidden", count(tree::BranchState::kHidden)}};
    found.push_back({"Unit", claim_text(tree.claims.unit, "mm", "not known: lengths count as the file has them")});
    found.push_back({"Orientation", claim_text(tree.claims.orientation, "right, anterior, superior (RAS)",
                                               "not known: axes x, y, z are those of the file")});
    return found;
}

Facts option_facts(const Marks& marks) {
    std::string bands;
    for (const double band : marks.planning.bands_mm) bands += (bands.empty() ? "" : ", ") + digits(band);
    Facts found = surface_facts(marks.options);
    found.insert(found.end(), {{"Coloured by", std::string(name_of(marks.colour_by))},
                               {"Margins", bands + " mm"},
                               {"Contact with lesions within", digits(marks.planning.touch_mm) + " mm"},
                               {"Cuts marked above", digits(marks.planning.reconstruct_mm) + " mm"}});
    return found;
}

std::string lesions_html(const Document& document, const Assets& assets) {
    const Marks& marks = document.marks();
    if (marks.lesions.empty()) return {};
    Table table{"Lesions",
                {{"lesion", "Lesion"},
                 {"shape", "Shape"},
                 {"x", "x, mm"},
                 {"y", "y, mm"},
                 {"z", "z, mm"},
                 {"diameter", "Diameter, mm"},
                 {"volume", "Volume, mm\xC2\xB3"}},
                {}};
    int number = 0;
    for (const Lesion& lesion : marks.lesions) {
        const auto& [x, y, z, r] = lesion.sphere;
        std::vector<Cell> row{++number};
        if (lesion.is_mesh()) {
            const std::string file = std::filesystem::path(lesion.file).filename().string();
            const auto mesh = assets.lesion_mesh(lesion);
            row.insert(row.end(), {lesion.of_mask() ? file + ", part " + std::to_string(lesion.part) : file, "", "", "",
                                   mesh ? Cell(mesh->diameter_mm) : Cell(""),
                                   mesh && mesh->volume_mm3 ? Cell(*mesh->volume_mm3) : Cell("")});
        } else {
            row.insert(row.end(), {"sphere", x, y, z, 2.0 * r, 4.0 / 3.0 * std::numbers::pi * r * r * r});
        }
        table.rows.push_back(std::move(row));
    }
    add_unit(table, document.lengths());
    std::string note;
    for (const std::string& trouble : assets.plan->troubles) note += trouble + ". ";
    return table_html(table, {.note = note});
}

// The file's name of the label, if known.
std::string label_text(const ContextItem& item, const ContextShape* shape) {
    if (item.isovalue) return "from " + rounded(*item.isovalue);
    if (item.label.none()) return "";
    const bool named = shape != nullptr && shape->label && !shape->label->name.empty();
    return named ? shape->label->name : item.label.name.empty() ? std::to_string(item.label.number) : item.label.name;
}

// `asked`: the user's statement, in the words of the options.
std::string said_text(tree::SaidBy who, const std::string& asked) {
    return who == tree::SaidBy::kFile     ? "as the file says"
           : who == tree::SaidBy::kPerson ? (asked.empty() ? "as the user says" : asked + ", as the user says")
                                          : "not known, taken for the tree's";
}

std::string context_html(const Document& document, const Assets& assets) {
    Table table{"Context",
                {{"context", "No."},
                 {"file", "File"},
                 {"label", "Label"},
                 {"colour", "Colour"},
                 {"opacity", "Opacity, %"},
                 {"shown", "Shown"},
                 {"unit_from", "Unit"},
                 {"axes_from", "Axes"}},
                {}};
    for (const ContextItem& item : document.marks().context) {
        const auto shape = assets.context_shape(source_of(item));
        const auto said = [&](tree::SaidBy tree::Claims::*claim, const std::string& asked) {
            return shape ? said_text(shape->claims.*claim, asked) : std::string("not read");
        };
        table.rows.push_back({static_cast<int>(table.rows.size() + 1),
                              std::filesystem::path(item.file).filename().string(), label_text(item, shape.get()),
                              colour_text(item.colour), 100.0 * item.opacity, item.visible ? "yes" : "no",
                              said(&tree::Claims::unit, item.units), said(&tree::Claims::orientation, item.axes)});
    }
    return table.rows.empty() ? "" : table_html(table, {.note = "Surfaces that are shown next to the vessels."});
}

std::string case_html(const std::string& line) {
    return line.empty() ? "" : "<p class=\"case\">" + html_text(line) + "</p>\n";
}

std::string cuts_note(const Document& document, const Plan& plan) {
    const measure::CutReport& report = plan.cuts;
    std::size_t rebuilt = 0;
    for (const measure::CutFigures& cut : report.cuts) rebuilt += cut.reconstruct ? 1 : 0;
    std::string note = counted(rebuilt, "vessel that is cut is", "vessels that are cut are") + " over " +
                       digits(document.marks().planning.reconstruct_mm) + " mm wide.";
    if (report.in_part > 0)
        note.append(" ")
            .append(counted(static_cast<std::uint64_t>(report.in_part), "branch is", "branches are"))
            .append(" lost in part only.");
    return document.lengths().worded(note) + " The last line counts nothing twice.";
}

std::string saved_views_html(const std::vector<ReportPicture>& pictures, std::size_t saved) {
    if (pictures.empty()) return {};
    std::string text = "<h2>Saved views</h2>\n" + even_pictures_html(pictures);
    if (saved > pictures.size())
        text += "<p class=\"quiet\">And " + counted(saved - pictures.size(), "more saved view", "more saved views") +
                ", which the session has.</p>\n";
    return text;
}

std::string slices_html(const std::vector<SliceRow>& rows) {
    if (rows.empty()) return {};
    std::string text = "<h2>Slices</h2>\n";
    for (const SliceRow& row : rows)
        text += "<h3>" + html_text(row.title) + "</h3>\n<div class=\"three\">" + even_pictures_html(row.pictures) +
                "</div>\n";
    return text;
}

} // namespace

std::string report_page(const Document& document, const Assets& assets, const ReportPictures& pictures,
                        const ReportHead& head) {
    std::string page = page_begin(document.session().tree.path.filename().string(), "Vessel tree report", head.made) +
                       case_html(head.case_line) + pictures_html(pictures.general) +
                       saved_views_html(pictures.saved_views, document.marks().views.size());
    page += "<h2>Tree</h2>\n" + facts_html(worded(tree_facts(document), document.lengths()));
    if (!document.tree()->systems.empty()) page += table_html(systems_table(document, assets));
    const Marks& marks = document.marks();
    const Plan& plan = *assets.plan;
    page += lesions_html(document, assets);
    if (!plan.vessels.empty())
        page += table_html(
            lesions_table(document, assets),
            {.note = document.lengths().worded(
                 "From the surface of the lesion to the nearest wall; 0 where the two touch, with how deep they "
                 "overlap. "
                 "The angle of contact is the largest share of a cross-section's wall that lies within the lesion, or "
                 "within " +
                 digits(marks.planning.touch_mm) + " mm of it.")});
    if (!marks.cuts.empty())
        page += table_html(cuts_table(document, assets),
                           {.note = cuts_note(document, plan), .flag_column = "over_limit", .sums = 1});
    if (const Table bands = bands_table(document, assets); !plan.bands.empty())
        page += table_html(bands, {.note = bands.rows.empty() ? "No vessel lies within the margins."
                                                              : "From the lesions to the vessels' walls; the thickest "
                                                                "first."});
    page += plans_html(document, assets, pictures.plans);
    page += slices_html(pictures.slices);
    for (const TableKind& kind : table_kinds())
        if (kind.plain_on_page && kind.there(document, assets)) page += table_html(kind.table(document, assets));
    if (!marks.selection.empty()) page += table_html(selection_table(document, assets));
    page += context_html(document, assets);
    if (const Table contacts = contacts_table(document, assets); !contacts.rows.empty())
        page += table_html(contacts,
                           {.note = "Where vessels press on each other without being connected there, the closest "
                                    "first. A gap below 0 is an overlap. Flattened: by how much the surface that is "
                                    "drawn has less than the vessel's radius there, which is no stenosis."});
    page += "<h2>Options</h2>\n" + facts_html(worded(option_facts(marks), document.lengths())) + page_end();
    return page;
}

} // namespace ramus::app
