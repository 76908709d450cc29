#include "app/panels/branch_columns.h"

#include "app/panels/theme.h"
#include "app/panels/widgets.h"
#include "app/session/numbers.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

namespace ramus::app {

namespace {

// A column as wide as its heading with the sort arrow, and as its widest number.
struct NumberColumn {
    const QuantityRow* row;
    std::string heading;
    float width;
    bool shown = true;
};

std::vector<NumberColumn> number_columns(const BranchList& list, const Lengths& lengths) {
    std::vector<NumberColumn> columns;
    for (const QuantityRow* row : rows_with(&QuantityRow::list)) {
        NumberColumn column{row, lengths.worded(row->list.heading), 0.0F};
        const float widest = list.largest.size() > columns.size()
                                 ? ImGui::CalcTextSize(number_text(*row, list.largest[columns.size()]).c_str()).x
                                 : 0.0F;
        const bool sorted = list.sorted == static_cast<int>(kFirstQuantity + columns.size());
        const float arrow = sorted ? ImGui::GetFontSize() : 0.0F;
        column.width = std::max(widest, ImGui::CalcTextSize(column.heading.c_str()).x + arrow);
        columns.push_back(std::move(column));
    }
    return columns;
}

// Full text of a heading.
std::string heading_help(int column, const Lengths& lengths) {
    if (column == kId) return "The number of the branch";
    if (column == kName) return "Its name, or in grey that of a branch upstream";
    if (column == kSystem) return "The vessel system that it belongs to";
    const QuantityRow& row = *rows_with(&QuantityRow::list)[static_cast<std::size_t>(column) - kFirstQuantity];
    return std::string(row.label) + (row.unit.empty() ? "" : lengths.worded(", " + std::string(row.unit)));
}

// Draws a mark as in the rows, which determines the column's width.
void draw_mark_heading() {
    const float side = std::round(8.0F * theme::scale());
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const ImVec2 from(at.x, std::round(at.y + 0.5F * (ImGui::GetTextLineHeight() - side)));
    ImGui::Dummy({side, ImGui::GetTextLineHeight()});
    widgets::tooltip("The colour of the branch in the picture; hidden branches are hollow");
    ImGui::GetWindowDrawList()->AddRect(from, {from.x + side, from.y + side}, ImGui::GetColorU32(theme::kQuiet),
                                        2.0F * theme::scale());
}

// Drops columns for which there is no room next to `taken`.
void leave_out(std::vector<NumberColumn>& columns, float taken, float room) {
    const float between = 2.0F * ImGui::GetStyle().CellPadding.x;
    for (;;) {
        float sum = taken;
        NumberColumn* spare = nullptr;
        for (NumberColumn& column : columns) {
            if (!column.shown) continue;
            sum += column.width + between;
            if (column.row->list.spare > (spare == nullptr ? 0 : spare->row->list.spare)) spare = &column;
        }
        if (sum <= room || spare == nullptr) return;
        spare->shown = false;
    }
}

} // namespace

std::string number_text(const QuantityRow& row, double value) {
    return row.whole ? grouped(static_cast<std::uint64_t>(value)) : digits(value);
}

// Distributes remaining space in proportion to widths.
void set_up_columns(const BranchList& list, const Document& document, float room) {
    const float scale = theme::scale(), between = 2.0F * ImGui::GetStyle().CellPadding.x;
    const bool named = !document.marks().names.empty(), systems = document.tree()->systems.size() > 1;
    const auto column = [](const char* name, ImGuiID id, float width, ImGuiTableColumnFlags flags = 0) {
        ImGui::TableSetupColumn(name, flags | ImGuiTableColumnFlags_NoResize, width, id);
    };
    const auto shown = [](bool is) { return is ? 0 : ImGuiTableColumnFlags_Disabled; };
    const float mark = 8.0F * scale;
    const std::string last = std::to_string(document.branch_count());
    const float id_width =
        std::max(ImGui::CalcTextSize(last.c_str()).x,
                 ImGui::CalcTextSize("Id").x + (list.sorted == static_cast<int>(kId) ? ImGui::GetFontSize() : 0.0F));
    const float names = 84.0F * scale;
    std::vector<NumberColumn> numbers = number_columns(list, document.lengths());
    const float scrollbar = ImGui::GetStyle().ScrollbarSize;
    const int texts = (named ? 1 : 0) + (systems ? 1 : 0);
    leave_out(numbers, mark + id_width + static_cast<float>(texts) * names + static_cast<float>(3 + texts) * between,
              room - scrollbar);
    column("State", kMark, mark, ImGuiTableColumnFlags_WidthFixed | ImGuiTableColumnFlags_NoSort);
    column("Id", kId, id_width, ImGuiTableColumnFlags_DefaultSort);
    column("Name", kName, names, shown(named));
    column("System", kSystem, names, shown(systems));
    ImGuiID id = kFirstQuantity;
    for (const NumberColumn& number : numbers)
        column(number.heading.c_str(), id++, number.width,
               (number.row->list.largest_first ? ImGuiTableColumnFlags_PreferSortDescending : 0) | shown(number.shown));
}

// Like ImGui::TableHeadersRow(), but for right-aligned numbers.
void draw_branch_headings(const Lengths& lengths) {
    ImGui::TableNextRow(ImGuiTableRowFlags_Headers);
    const ImGuiTableSortSpecs* specs = ImGui::TableGetSortSpecs();
    for (int column = 0; column < ImGui::TableGetColumnCount(); ++column) {
        if (!ImGui::TableSetColumnIndex(column)) continue;
        const char* name = ImGui::TableGetColumnName(column);
        if (column == kMark) {
            draw_mark_heading();
            continue;
        }
        const bool sorted = specs != nullptr && specs->SpecsCount > 0 && specs->Specs[0].ColumnIndex == column;
        const bool text = column == kId || column == kName || column == kSystem;
        widgets::column_heading(name, heading_help(column, lengths),
                                text ? widgets::HeadingAt::kLeft : widgets::HeadingAt::kRight,
                                sorted ? ImGui::GetFontSize() : 0.0F);
        widgets::note_item(("Sort by " + std::string(name)).c_str());
    }
}

} // namespace ramus::app
