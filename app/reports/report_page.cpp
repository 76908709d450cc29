#include "app/reports/report_page.h"

#include "app/assets/assets.h"
#include "app/reports/report_tables.h"
#include "app/session/numbers.h"
#include "core/io/trees/binary_numbers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

namespace ramus::app {

namespace {

// More rows make no page that anybody reads: the CSV has them all.
constexpr std::size_t kMostRows = 100;

constexpr const char* kStyle = R"(
:root { color-scheme: light; }
body { font: 14px/1.45 "Open Sans", system-ui, sans-serif; color: #1d2126; margin: 2.2em auto; max-width: 60em; padding: 0 1.5em; }
h1 { font-size: 1.6em; font-weight: 600; margin: 0 0 .1em; overflow-wrap: anywhere; }
h2 { font-size: 1.1em; font-weight: 600; margin: 1.8em 0 .5em; padding-top: .7em; border-top: 1px solid #d5d9de; }
.quiet, figcaption, dt, th { color: #5b6570; }
.pictures { display: grid; grid-template-columns: 1fr 1fr; gap: .7em; margin-top: 1.3em; }
.pictures figure:first-child { grid-column: 1 / -1; }
figure { margin: 0; } img { display: block; width: 100%; border-radius: 4px; }
figcaption { font-size: .85em; margin-top: .25em; }
dl { display: grid; grid-template-columns: repeat(auto-fill, minmax(17em, 1fr)); gap: .15em 2em; margin: 0; }
dl div { display: flex; justify-content: space-between; gap: 1em; border-bottom: 1px solid #eceef1; padding: .12em 0; }
dd { margin: 0; text-align: right; overflow-wrap: anywhere; }
table { border-collapse: collapse; width: 100%; font-size: .88em; font-variant-numeric: tabular-nums; }
th { font-weight: 600; text-align: left; vertical-align: bottom; }
th, td { padding: .28em .5em; border-bottom: 1px solid #e3e6ea; overflow-wrap: anywhere; }
.number { text-align: right; white-space: nowrap; } th.number { white-space: normal; }
tr.flag td { background: #fff1ec; } tr.sum td { font-weight: 600; border-top: 2px solid #aab2bb; }
@media print { body { margin: 0; max-width: none; font-size: 11px; } h2 { break-after: avoid; } tr, figure { break-inside: avoid; } }
)";

std::string cell_text(const Cell& cell) {
    if (!cell.number) return html_text(cell.text);
    const double number = *cell.number;
    if (!std::isfinite(number)) return "\xE2\x80\x93";
    if (number == std::floor(number) && std::abs(number) < 1e9)
        return std::string(number < 0.0 ? "-" : "").append(grouped(static_cast<std::uint64_t>(std::abs(number))));
    return digits(number, 3);
}

bool numeric(const Table& table, std::size_t column) {
    return !table.rows.empty() && table.rows.front()[column].number.has_value();
}

// `flag_column`: rows whose text there is "yes" stand out. The last row may be a sum.
std::string table_html(const Table& table, const std::string& note, const std::string& flag_column = {},
                       bool last_is_sum = false) {
    std::string text = "<h2>" + html_text(table.title) + "</h2>\n";
    if (!note.empty()) text += "<p class=\"quiet\">" + html_text(note) + "</p>\n";
    if (table.rows.empty()) return text;
    text += "<table>\n<thead><tr>";
    for (std::size_t c = 0; c < table.columns.size(); ++c)
        text += std::string("<th") + (numeric(table, c) ? " class=\"number\">" : ">") +
                html_text(table.columns[c].heading) + "</th>";
    text += "</tr></thead>\n<tbody>\n";
    for (std::size_t r = 0; r < table.rows.size(); ++r) {
        const bool sum = last_is_sum && r + 1 == table.rows.size();
        if (r >= kMostRows && !sum) continue;
        bool flagged = false;
        for (std::size_t c = 0; c < table.columns.size(); ++c)
            flagged = flagged || (table.columns[c].name == flag_column && table.rows[r][c].text == "yes");
        text += sum ? "<tr class=\"sum\">" : flagged ? "<tr class=\"flag\">" : "<tr>";
        for (std::size_t c = 0; c < table.columns.size(); ++c)
            text += std::string("<td") + (numeric(table, c) ? " class=\"number\">" : ">") +
                    cell_text(table.rows[r][c]) + "</td>";
        text += "</tr>\n";
    }
    text += "</tbody></table>\n";
    if (const std::size_t shown = kMostRows + (last_is_sum ? 1 : 0); table.rows.size() > shown)
        text += "<p class=\"quiet\">And " + grouped(table.rows.size() - shown) +
                " more, which the same report as .csv lists.</p>\n";
    return text;
}

using Facts = std::vector<std::pair<std::string, std::string>>;

std::string facts_html(const Facts& facts) {
    std::string text = "<dl>\n";
    for (const auto& [name, value] : facts)
        text += "<div><dt>" + html_text(name) + "</dt><dd>" + html_text(value) + "</dd></div>\n";
    return text + "</dl>\n";
}

std::string range_text(double least, double most) { return digits(least) + " to " + digits(most) + " mm"; }

Facts tree_facts(const Document& document) {
    const TreeFacts& facts = *document.facts();
    const tree::VesselTree& tree = *document.tree();
    const Marks& marks = document.marks();
    const auto count = [&](render::BranchState state) { return grouped(branches_in_state(marks, state).size()); };
    Facts found{{"File", document.session().tree.path.filename().string()},
                {"Checksum", document.session().tree.checksum.empty() ? "not known" : document.session().tree.checksum},
                {"Branches", grouped(tree.branches.size())},
                {"Generations", grouped(static_cast<std::uint64_t>(facts.statistics.generations))},
                {"Length", digits(facts.statistics.length_mm, 4) + " mm"},
                {"Volume", digits(facts.statistics.volume_mm3, 4) + " mm\xC2\xB3"},
                {"Diameters", range_text(2.0 * facts.statistics.radius_mm.min, 2.0 * facts.statistics.radius_mm.max)},
                {"Roots", grouped(tree.roots.size())},
                {"Loops", grouped(static_cast<std::uint64_t>(tree.loop_count))},
                {"Repairs on reading", grouped(sentences(tree, tree::Note::Kind::kRepaired).size())},
                {"Selected", grouped(marks.selection.size())},
                {"Highlighted", count(render::BranchState::kHighlighted)},
                {"Defocused", count(render::BranchState::kDefocused)},
                {"Hidden", count(render::BranchState::kHidden)}};
    return found;
}

Facts option_facts(const Marks& marks) {
    const mesh::SurfaceOptions& options = marks.options;
    std::string bands;
    for (const double band : marks.planning.bands_mm) bands += (bands.empty() ? "" : ", ") + digits(band);
    Facts found{{"Surface", std::string(mesh::row_of(options.method).noun)},
                {"Smoothing passes", std::to_string(options.smooth_passes)},
                {"Pruning ratio", options.prune_ratio > 0.0 ? digits(options.prune_ratio) : "off"},
                {"Kernel width", digits(options.width)},
                {"Blends", options.blend == mesh::Blend::kTree ? "along the tree" : "wherever vessels come close"},
                options.cell_mm > 0.0
                    ? std::pair<std::string, std::string>{"Cell size", digits(options.cell_mm) + " mm"}
                    : std::pair<std::string, std::string>{"Triangles around a vessel", std::to_string(options.detail)},
                {"Coloured by", std::string(name_of(marks.colour_by))},
                {"Margins", bands + " mm"},
                {"Reconstruct above", digits(marks.planning.reconstruct_mm) + " mm"}};
    return found;
}

std::string lesions_html(const Document& document, const Plan& plan) {
    const Marks& marks = document.marks();
    if (marks.lesions.empty() && marks.lesion_meshes.empty()) return {};
    Table table{
        "Lesions",
        {{"lesion", "Lesion"}, {"shape", "Shape"}, {"x", "x, mm"}, {"y", "y, mm"}, {"z", "z, mm"}, {"r", "Radius, mm"}},
        {}};
    int number = 0;
    for (const auto& [x, y, z, r] : marks.lesions) table.rows.push_back({++number, "sphere", x, y, z, r});
    for (const std::string& mesh : marks.lesion_meshes)
        table.rows.push_back({++number, std::filesystem::path(mesh).filename().string(), "", "", "", ""});
    std::string note;
    for (const std::string& trouble : plan.troubles) note += trouble + ". ";
    return table_html(table, note);
}

std::string cuts_note(const Document& document, const Plan& plan) {
    const measure::CutReport& report = plan.cuts;
    std::size_t rebuilt = 0;
    for (const measure::CutFigures& cut : report.cuts) rebuilt += cut.reconstruct ? 1 : 0;
    std::string note = counted(rebuilt, "vessel", "vessels") + " of more than " +
                       digits(document.marks().planning.reconstruct_mm) + " mm must be reconstructed.";
    if (report.in_part > 0)
        note.append(" ")
            .append(counted(static_cast<std::uint64_t>(report.in_part), "branch is", "branches are"))
            .append(" lost in part only.");
    return note + " The last line counts nothing twice.";
}

} // namespace

std::string html_text(std::string_view text) {
    std::string safe;
    for (const char c : text) {
        constexpr std::array<std::pair<char, std::string_view>, 5> kSafe{
            {{'&', "&amp;"}, {'<', "&lt;"}, {'>', "&gt;"}, {'"', "&quot;"}, {'\'', "&#39;"}}};
        const auto* const found = std::ranges::find(kSafe, c, &std::pair<char, std::string_view>::first);
        safe += found == kSafe.end() ? std::string_view(&c, 1) : found->second;
    }
    return safe;
}

std::string report_page(const Document& document, const Assets& assets, const std::vector<ReportPicture>& pictures,
                        const std::string& made) {
    const std::string name = html_text(document.session().tree.path.filename().string());
    std::string page = "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
                       "<meta name=\"viewport\" content=\"width=device-width\">\n<title>" +
                       name + " \xE2\x80\x93 ramus report</title>\n<style>" + kStyle +
                       "</style>\n</head>\n<body>\n<h1>" + name +
                       "</h1>\n<p class=\"quiet\">Vessel tree report, ramus " RAMUS_VERSION ", " + html_text(made) +
                       ". Not a medical device.</p>\n";
    if (!pictures.empty()) page += "<div class=\"pictures\">\n";
    for (const ReportPicture& picture : pictures)
        page += "<figure><img alt=\"" + html_text(picture.caption) + "\" src=\"data:image/png;base64," +
                io::base64_encoded(picture.png) + "\"><figcaption>" + html_text(picture.caption) +
                "</figcaption></figure>\n";
    if (!pictures.empty()) page += "</div>\n";
    page += "<h2>Tree</h2>\n" + facts_html(tree_facts(document));
    if (!document.tree()->systems.empty()) page += table_html(systems_table(document, assets), "");
    if (const Table contacts = contacts_table(document, assets); !contacts.rows.empty())
        page += table_html(contacts, "Where vessels press on each other without being connected there, the closest "
                                     "first. A gap below 0 is an overlap.");
    const Marks& marks = document.marks();
    const Plan& plan = *assets.plan;
    page += lesions_html(document, plan);
    if (!marks.cuts.empty())
        page += table_html(cuts_table(document, assets), cuts_note(document, plan), "must_be_reconstructed", true);
    if (const Table bands = bands_table(document, assets); !plan.bands.empty())
        page += table_html(bands, bands.rows.empty() ? "No vessel lies within the margins."
                                                     : "From the lesions to the vessels' walls; the thickest first.");
    if (!marks.measurements.empty()) page += table_html(measurements_table(document, assets), "");
    if (!marks.selection.empty()) page += table_html(selection_table(document, assets), "");
    page += "<h2>Options</h2>\n" + facts_html(option_facts(marks)) + "</body>\n</html>\n";
    return page;
}

} // namespace ramus::app
