// Every branch as a row, sortable by column; a click selects, with Ctrl it adds or takes away.
#include "app/numbers.h"
#include "app/panels/interface.h"
#include "app/panels/widgets.h"
#include "app/window/theme.h"

#include <algorithm>
#include <cmath>
#include <imgui.h>
#include <numeric>

namespace ramus::app {

namespace {

enum Column : ImGuiID { kId, kGeneration, kDiameter, kLength, kDependents };

void sort_rows(Interface& interface, const TreeFacts& facts, const tree::VesselTree& tree,
               const ImGuiTableSortSpecs& specs) {
    const ImGuiID column = specs.SpecsCount > 0 ? specs.Specs[0].ColumnUserID : static_cast<ImGuiID>(kId);
    const bool descending = specs.SpecsCount > 0 && specs.Specs[0].SortDirection == ImGuiSortDirection_Descending;
    const auto value = [&](int id) -> double {
        const auto index = static_cast<std::size_t>(id);
        switch (column) {
        case kGeneration:
            return tree.branches[index].generation;
        case kDiameter:
            return facts.branches[index].mean_diameter_mm;
        case kLength:
            return facts.branches[index].length_mm;
        case kDependents:
            return facts.branches[index].dependents;
        default:
            return id;
        }
    };
    auto& order = interface.list_order;
    order.resize(tree.branches.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(),
                     [&](int a, int b) { return descending ? value(a) > value(b) : value(a) < value(b); });
}

void number_cell(const std::string& text, bool faint) {
    ImGui::TableNextColumn();
    widgets::align_right(ImGui::CalcTextSize(text.c_str()).x);
    if (faint) ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));
    ImGui::TextUnformatted(text.c_str());
    if (faint) ImGui::PopStyleColor();
}

void draw_row(InterfaceContext& context, int id) {
    const auto index = static_cast<std::size_t>(id);
    const Document& document = context.workspace.document;
    const BranchFacts& facts = context.workspace.facts()->branches[index];
    const bool hidden = state_of(document.marks(), id) == render::BranchState::kHidden;
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::PushID(id);
    const bool lit = state_of(document.marks(), id) == render::BranchState::kHighlighted;
    if (lit)
        ImGui::PushStyleColor(ImGuiCol_Text, theme::kHighlight);
    else if (hidden)
        ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));
    if (ImGui::Selectable(std::to_string(id).c_str(), is_selected(document.marks(), id),
                          ImGuiSelectableFlags_SpanAllColumns)) {
        context.interface.shown_selection = id; // it is in sight already
        const ImGuiIO& io = ImGui::GetIO();
        context.perform(io.KeyCtrl ? "select-toggle" : io.KeyAlt ? "select-subtree" : "select", {std::to_string(id)});
    }
    if (lit || hidden) ImGui::PopStyleColor();
    if (ImGui::IsItemHovered()) context.interface.listed = id;
    ImGui::PopID();
    number_cell(std::to_string(document.tree()->branches[index].generation), hidden);
    number_cell(digits(facts.mean_diameter_mm), hidden);
    number_cell(digits(facts.length_mm), hidden);
    number_cell(grouped(static_cast<std::uint64_t>(facts.dependents)), hidden);
}

// As ImGui::TableHeadersRow(), but over numbers that end at the right.
void draw_headers() {
    ImGui::TableNextRow(ImGuiTableRowFlags_Headers);
    const ImGuiTableSortSpecs* specs = ImGui::TableGetSortSpecs();
    for (int column = 0; column < ImGui::TableGetColumnCount(); ++column) {
        ImGui::TableSetColumnIndex(column);
        const char* name = ImGui::TableGetColumnName(column);
        if (column == 0) {
            ImGui::TableHeader(name);
            continue;
        }
        const ImVec2 at = ImGui::GetCursorScreenPos();
        float right = at.x + ImGui::GetContentRegionAvail().x;
        const bool sorted = specs != nullptr && specs->SpecsCount > 0 && specs->Specs[0].ColumnIndex == column;
        if (sorted) right -= ImGui::GetFontSize(); // its arrow
        ImGui::PushID(column);
        ImGui::TableHeader("##header");
        ImGui::PopID();
        ImGui::GetWindowDrawList()->AddText({std::round(right - ImGui::CalcTextSize(name).x), at.y},
                                            ImGui::GetColorU32(ImGuiCol_Text), name);
    }
}

// A selection made in the picture comes into sight in the list.
void scroll_to_selection(Interface& interface, const Document& document, float row_height) {
    const auto& selection = document.marks().selection;
    const int wanted = selection.size() == 1 ? selection.front() : tree::kNoBranch;
    if (wanted == std::exchange(interface.shown_selection, wanted) || wanted == tree::kNoBranch) return;
    const auto row =
        std::find(interface.list_order.begin(), interface.list_order.end(), wanted) - interface.list_order.begin();
    // In the middle, with whole rows under the header.
    const float rows_above = std::floor(0.5F * ImGui::GetWindowHeight() / row_height) - 1.0F;
    ImGui::SetScrollY(std::max(0.0F, static_cast<float>(row) - rows_above) * row_height);
}

} // namespace

void draw_branch_list(InterfaceContext& context) {
    Interface& interface = context.interface;
    const auto& facts = context.workspace.facts();
    const tree::VesselTree& tree = *context.workspace.document.tree();
    const float least = 8.0F * ImGui::GetTextLineHeightWithSpacing();
    const ImVec2 size(0.0F, std::max(least, ImGui::GetContentRegionAvail().y));
    ImGui::PushFont(theme::small_font());
    if (ImGui::BeginTable("branches", 5,
                          ImGuiTableFlags_Sortable | ImGuiTableFlags_ScrollY | ImGuiTableFlags_SizingStretchProp |
                              ImGuiTableFlags_NoSavedSettings | ImGuiTableFlags_PadOuterX,
                          size)) {
        ImGui::TableSetupScrollFreeze(0, 1);
        const auto column = [](const char* name, Column id, float weight, ImGuiTableColumnFlags flags = 0) {
            ImGui::TableSetupColumn(name, flags | ImGuiTableColumnFlags_NoResize, weight, id);
        };
        column("Id", kId, 1.1F, ImGuiTableColumnFlags_DefaultSort);
        column("Gen", kGeneration, 0.9F);
        column("\xC3\x98 mm", kDiameter, 1.1F, ImGuiTableColumnFlags_PreferSortDescending);
        column("Length", kLength, 1.2F, ImGuiTableColumnFlags_PreferSortDescending);
        column("Deps", kDependents, 1.0F, ImGuiTableColumnFlags_PreferSortDescending);
        ImGui::PushStyleColor(ImGuiCol_Text, theme::kQuiet);
        draw_headers();
        ImGui::PopStyleColor();
        ImGuiTableSortSpecs* specs = ImGui::TableGetSortSpecs();
        if (specs != nullptr && (specs->SpecsDirty || interface.list_of != facts.get())) {
            sort_rows(interface, *facts, tree, *specs);
            interface.list_of = facts.get();
            specs->SpecsDirty = false;
        }
        const float row_height = ImGui::GetTextLineHeight() + 2.0F * ImGui::GetStyle().CellPadding.y;
        scroll_to_selection(interface, context.workspace.document, row_height);
        ImGuiListClipper clipper;
        clipper.Begin(static_cast<int>(interface.list_order.size()));
        while (clipper.Step())
            for (int row = clipper.DisplayStart; row < clipper.DisplayEnd; ++row)
                draw_row(context, interface.list_order[static_cast<std::size_t>(row)]);
        ImGui::EndTable();
    }
    ImGui::PopFont();
}

} // namespace ramus::app
