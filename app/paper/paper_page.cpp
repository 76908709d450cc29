#include "app/paper/paper_page.h"

#include "app/reports/validation/validation_tables.h"

#include <utility>

namespace ramus::app::paper {

namespace {

constexpr const char* kIntroduction =
    "The figures and tables of S. Oeltze and B. Preim, Visualization of Vasculature with Convolution Surfaces: Method, "
    "Validation and Evaluation, IEEE Transactions on Medical Imaging 24 (4), 2005, made anew as far as their content "
    "is known. Each has what it shows, what was measured, and what the paper says. Pictures of patients, drawings and "
    "the answers of raters are the authors' and are not reproduced; the text of such a figure says what replaces them.";

std::string anchor_of(const FigureRow& row) {
    return (row.is_table() ? "table-" : "figure-") + std::string(row.number);
}

std::string paragraph(std::string_view head, std::string_view text) {
    return "<p><strong>" + html_text(head) + "</strong> " + html_text(text) + "</p>\n";
}

std::string figure_html(const MadeFigure& made) {
    const auto& [row, figure] = made;
    std::string text = "<section id=\"" + anchor_of(*row) + "\">\n<h2>" + row->name() + ": " + html_text(row->title) +
                       "</h2>\n<p>" + html_text(row->shows) + "</p>\n";
    for (const Picture& picture : figure.pictures)
        text += "<div class=\"wide\">" + pictures_html({{picture.caption, picture.png}}) + "</div>\n";
    if (!figure.plots.empty()) {
        text += "<div class=\"plots\">\n";
        for (const Plot& plot : figure.plots) text += "<figure>" + plot.svg.drawing() + "</figure>\n";
        text += "</div>\n";
    }
    if (!figure.measured.empty()) {
        Table measured = measured_table({made});
        measured.columns.erase(measured.columns.begin());
        for (auto& cells : measured.rows) cells.erase(cells.begin());
        text += table_html(for_people(std::move(measured)), {.is_part = true});
    }
    for (const SavedTable& saved : figure.tables)
        text += table_html(for_people(saved.table),
                           {.note = saved.note, .sums = saved.sums, .is_part = true, .all_rows_in = saved.file});
    text += paragraph("The paper:", row->paper) + paragraph("Here:", row->differs);
    for (const std::string& options : figure.options)
        text += "<p class=\"quiet\">Made with " + html_text(options) + "</p>\n";
    return text + "</section>\n";
}

} // namespace

Table measured_table(const std::vector<MadeFigure>& figures) {
    Table table{"Measured",
                {{"figure", "Figure"},
                 {"what", "Quantity"},
                 {"value", "Measured", 4},
                 {"formula", "Closed form", 4},
                 {"unit", "Unit"},
                 {"paper", "Paper"}},
                {}};
    for (const auto& [row, figure] : figures)
        for (const Measured& one : figure.measured)
            table.rows.push_back(
                {row->name(), one.what, one.value, one.formula ? Cell(*one.formula) : Cell(""), one.unit, one.paper});
    return table;
}

std::string paper_page(const std::vector<MadeFigure>& figures, const Facts& inputs, const std::string& made) {
    std::string page = page_begin("The paper's figures and tables", "Made anew", made);
    page += "<p>" + html_text(kIntroduction) + "</p>\n<p>";
    for (const MadeFigure& one : figures)
        page += "<a href=\"#" + anchor_of(*one.row) + "\">" + one.row->name() + "</a>" +
                (&one == &figures.back() ? "</p>\n" : " \xC2\xB7 ");
    page += facts_html(inputs);
    for (const MadeFigure& one : figures) page += figure_html(one);
    return page + page_end();
}

} // namespace ramus::app::paper
