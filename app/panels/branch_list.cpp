// The table of branches: sorted by column, filtered by the typed text, linked with the picture.
#include "app/panels/branch_list.h"

#include "app/panels/branch_columns.h"
#include "app/panels/parts.h"
#include "app/panels/rename_dialog.h"
#include "app/panels/theme.h"
#include "app/panels/widgets.h"
#include "app/session/numbers.h"
#include "app/session/systems.h"

#include <algorithm>
#include <cmath>
#include <imgui.h>

namespace ramus::app {

namespace {

std::size_t index_of(int id) { return static_cast<std::size_t>(id); }

Quantity quantity_of(ImGuiID column) {
    if (column < kFirstQuantity) return Quantity::kId;
    return rows_with(&QuantityRow::list)[column - kFirstQuantity]->quantity;
}

// Applies the typed filter if it is valid; otherwise keeps the last one.
void read_filter(BranchList& list) {
    const std::string typed = list.filter.data();
    if (list.made && typed == list.applied) return;
    list.applied = typed;
    auto parsed = parse_branch_filter(typed);
    list.trouble = parsed ? "" : parsed.error().message();
    if (!parsed) return;
    list.parsed = std::move(*parsed);
    list.made = false;
}

// Compares only inputs that affect rows: states and selection only with a filter.
bool is_current(const BranchList& list, const TreeFacts& facts, const Marks& marks) {
    return list.made && list.of == &facts && list.given == marks.names && list.given_subtrees == marks.subtree_names &&
           list.systems == marks.systems &&
           (list.parsed.empty() || (list.selection == marks.selection && list.states == marks.states));
}

void measure_columns(BranchList& list, const tree::VesselTree& tree, const TreeFacts& facts) {
    list.largest.clear();
    for (const QuantityRow* row : rows_with(&QuantityRow::list)) {
        double largest = 0.0;
        for (int id = 0; id < static_cast<int>(tree.branches.size()); ++id)
            largest = std::max(largest, row->value(tree, facts, id));
        list.largest.push_back(largest);
    }
}

void make_rows(BranchList& list, const Document& document, const TreeFacts& facts, const ImGuiTableSortSpecs* specs) {
    const tree::VesselTree& tree = *document.tree();
    const Marks& marks = document.marks();
    if (list.of != &facts) measure_columns(list, tree, facts);
    list.of = &facts;
    list.given = marks.names;
    list.given_subtrees = marks.subtree_names;
    list.systems = marks.systems;
    list.selection = marks.selection;
    list.states = marks.states;
    list.made = true;
    list.names.clear();
    if (!marks.names.empty())
        for (const int source : label_sources(facts.dependency, marks))
            list.names.push_back(source == tree::kNoBranch ? std::string{} : marks.names.at(source));
    list.rows = branches_passing(list.parsed, tree, facts, marks);
    if (specs == nullptr || specs->SpecsCount == 0) return;
    const ImGuiID column = specs->Specs[0].ColumnUserID;
    const bool descending = specs->Specs[0].SortDirection == ImGuiSortDirection_Descending;
    if (column == kName) {
        if (list.names.empty()) return;
        // Branches without a name come last in both directions.
        std::ranges::stable_sort(list.rows, [&](int a, int b) {
            const std::string& one = list.names[index_of(a)];
            const std::string& other = list.names[index_of(b)];
            if (one.empty() || other.empty()) return !one.empty() && other.empty();
            return descending ? one > other : one < other;
        });
        return;
    }
    if (column == kSystem) {
        const auto system = [&](int id) { return tree.branches[index_of(id)].system; };
        std::ranges::stable_sort(
            list.rows, [&](int a, int b) { return descending ? system(a) > system(b) : system(a) < system(b); });
        return;
    }
    const Quantity quantity = quantity_of(column);
    std::vector<double> values(tree.branches.size());
    for (const int id : list.rows) values[index_of(id)] = value_of(quantity, tree, facts, id);
    std::ranges::stable_sort(list.rows, [&](int a, int b) {
        return descending ? values[index_of(a)] > values[index_of(b)] : values[index_of(a)] < values[index_of(b)];
    });
}

// The range from the last clicked row to this one.
std::vector<std::string> range_to(const BranchList& list, int id) {
    const auto from = std::ranges::find(list.rows, list.anchor);
    const auto to = std::ranges::find(list.rows, id);
    if (from == list.rows.end() || to == list.rows.end()) return {std::to_string(id)};
    std::vector<std::string> words;
    for (auto row = std::min(from, to); row <= std::max(from, to); ++row) words.push_back(std::to_string(*row));
    return words;
}

void click(InterfaceContext& context, int id) {
    BranchList& list = context.interface.of<BranchList>();
    const ImGuiIO& io = ImGui::GetIO();
    list.shown = list.cursor = id; // already visible
    list.focused = true;
    if (ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) {
        context.perform("centre", {std::to_string(id)});
        return;
    }
    if (io.KeyShift && list.anchor != tree::kNoBranch) {
        context.perform(io.KeyCtrl ? "select-add" : "select", range_to(list, id));
        return;
    }
    list.anchor = id;
    context.perform(io.KeyCtrl ? "select-toggle" : io.KeyAlt ? "select-subtree" : "select", {std::to_string(id)});
}

// A small square in the branch's colour in the picture; hollow if hidden.
void draw_mark(const InterfaceContext& context, int id) {
    const Marks& marks = context.workspace.document().marks();
    const render::Appearance appearance;
    const PictureLook& picture = context.interface.picture;
    glm::vec3 colour = index_of(id) < picture.colours.size() ? picture.colours[index_of(id)] : appearance.vessel;
    const tree::BranchState state = state_of(marks, id);
    if (state == tree::BranchState::kHighlighted) colour = appearance.highlight;
    if (state == tree::BranchState::kDefocused) colour = 0.8F * appearance.glass;
    const float side = std::round(8.0F * theme::scale());
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const ImVec2 from(at.x, std::round(at.y + 0.5F * (ImGui::GetTextLineHeight() - side)));
    const ImVec2 to(from.x + side, from.y + side);
    const float rounding = 2.0F * theme::scale();
    ImDrawList* draw = ImGui::GetWindowDrawList();
    const ImU32 grey = ImGui::GetColorU32(ImGuiCol_TextDisabled);
    if (state == tree::BranchState::kHidden)
        draw->AddRect(from, to, grey, rounding);
    else
        draw->AddRectFilled(from, to,
                            ImGui::ColorConvertFloat4ToU32(
                                {colour.r, colour.g, colour.b, state == tree::BranchState::kDefocused ? 0.5F : 1.0F}),
                            rounding);
    ImGui::Dummy({side, ImGui::GetTextLineHeight()});
}

void number_cell(const std::string& text) {
    if (!ImGui::TableNextColumn()) return;
    widgets::text_right(text);
}

void name_cell(InterfaceContext& context, int id) {
    const BranchList& list = context.interface.of<BranchList>();
    if (!ImGui::TableNextColumn() || list.names.empty()) return;
    const std::string& name = list.names[index_of(id)];
    const bool own = list.given.contains(id);
    if (!own) ImGui::PushStyleColor(ImGuiCol_Text, theme::kQuiet); // label from another branch
    const std::string shown = widgets::fitted(name, ImGui::GetContentRegionAvail().x);
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const ImVec2 end(at.x + ImGui::GetContentRegionAvail().x, at.y + ImGui::GetTextLineHeight());
    ImGui::TextUnformatted(shown.c_str());
    if (!own) ImGui::PopStyleColor();
    if (!ImGui::IsMouseHoveringRect(at, end)) return;
    if (ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left))
        context.perform("rename", {std::to_string(id)});
    else if (shown != name)
        ImGui::SetTooltip("%s", name.c_str());
}

void system_cell(const InterfaceContext& context, int id) {
    if (!ImGui::TableNextColumn()) return;
    const Document& document = context.workspace.document();
    const std::string name = system_of(*document.tree(), document.marks(), id);
    ImGui::TextUnformatted(widgets::fitted(name, ImGui::GetContentRegionAvail().x).c_str());
}

void draw_row(InterfaceContext& context, int id) {
    const Document& document = context.workspace.document();
    const tree::BranchState state = state_of(document.marks(), id);
    const bool lit = state == tree::BranchState::kHighlighted;
    const bool faint = state == tree::BranchState::kHidden;
    const bool pointed_at = context.interface.picture.hovered == id;
    ImGui::TableNextRow();
    if (pointed_at) // in the picture or in the overview
        ImGui::TableSetBgColor(ImGuiTableBgTarget_RowBg1, ImGui::GetColorU32(theme::kRaised));
    ImGui::TableNextColumn();
    draw_mark(context, id);
    ImGui::TableNextColumn();
    ImGui::PushID(id);
    ImGui::PushStyleColor(ImGuiCol_Text, lit     ? theme::kHighlight
                                         : faint ? ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled)
                                                 : theme::kText);
    const bool double_click_names = context.interface.of<Rename>().open; // the second click opened the field
    if (ImGui::Selectable(std::to_string(id).c_str(), is_selected(document.marks(), id),
                          ImGuiSelectableFlags_SpanAllColumns | ImGuiSelectableFlags_AllowDoubleClick) &&
        !double_click_names)
        click(context, id);
    if (!lit) ImGui::PopStyleColor();
    if (ImGui::IsItemHovered()) context.interface.listed = id;
    name_cell(context, id);
    system_cell(context, id);
    for (const QuantityRow* row : rows_with(&QuantityRow::list)) {
        const double value = row->value(*document.tree(), *context.workspace.facts(), id);
        number_cell(number_text(*row, value));
    }
    if (lit) ImGui::PopStyleColor();
    ImGui::PopID();
}

// Scrolls to the row: in the middle, with complete rows below the header.
void scroll_to(const BranchList& list, int id, float row_height) {
    const auto row = std::ranges::find(list.rows, id) - list.rows.begin();
    const float rows_above = std::floor(0.5F * ImGui::GetWindowHeight() / row_height) - 1.0F;
    ImGui::SetScrollY(std::max(0.0F, static_cast<float>(row) - rows_above) * row_height);
}

// Scrolls to a selection made in the picture.
void scroll_to_selection(BranchList& list, const Marks& marks, float row_height) {
    const int wanted = marks.selection.size() == 1 ? marks.selection.front() : tree::kNoBranch;
    if (wanted == std::exchange(list.shown, wanted) || wanted == tree::kNoBranch) return;
    list.cursor = list.anchor = wanted;
    scroll_to(list, wanted, row_height);
}

// Arrow keys, if the list was clicked last.
void handle_keys(InterfaceContext& context, float row_height) {
    BranchList& list = context.interface.of<BranchList>();
    if (ImGui::IsMouseClicked(ImGuiMouseButton_Left) && !ImGui::IsWindowHovered()) list.focused = false;
    if (!list.focused || ImGui::GetIO().WantTextInput || context.interface.dialog_open() || list.rows.empty()) return;
    const int step = ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_DownArrow)) ? 1
                     : ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_UpArrow)) ? -1
                                                                                 : 0;
    if (step == 0) return;
    const auto at = std::ranges::find(list.rows, list.cursor);
    const auto last = static_cast<std::ptrdiff_t>(list.rows.size()) - 1;
    const auto row = at == list.rows.end() ? 0 : std::clamp<std::ptrdiff_t>(at - list.rows.begin() + step, 0, last);
    list.cursor = list.rows[static_cast<std::size_t>(row)];
    if (ImGui::GetIO().KeyShift && list.anchor != tree::kNoBranch) {
        context.perform("select", range_to(list, list.cursor));
    } else {
        list.anchor = list.shown = list.cursor;
        context.perform("select", {std::to_string(list.cursor)});
    }
    const float y = static_cast<float>(row) * row_height;
    const float visible = ImGui::GetWindowHeight() - 2.0F * row_height; // under the header
    if (y < ImGui::GetScrollY() || y > ImGui::GetScrollY() + visible) scroll_to(list, list.cursor, row_height);
}

void select_rows(InterfaceContext& context) {
    std::vector<std::string> words;
    for (const int id : context.interface.of<BranchList>().rows) words.push_back(std::to_string(id));
    if (!words.empty()) context.perform("select", words);
}

std::string filter_examples() {
    std::string text;
    for (const QuantityRow& row : quantities())
        if (!row.filter_example.empty()) text.append(text.empty() ? "" : ", ").append(row.filter_example);
    return text;
}

void draw_filter(InterfaceContext& context) {
    BranchList& list = context.interface.of<BranchList>();
    const float scale = theme::scale();
    const std::string button = list.parsed.empty() ? "Select" : "Select " + grouped(list.rows.size());
    const float width = ImGui::CalcTextSize(button.c_str()).x + 14.0F * scale;
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {7.0F * scale, 3.0F * scale});
    ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x - width - 6.0F * scale);
    const bool wrong = !list.trouble.empty();
    if (wrong) ImGui::PushStyleColor(ImGuiCol_Text, theme::kTrouble);
    const bool entered = ImGui::InputTextWithHint("##filter", "Filter: d>3 gen<5 name", list.filter.data(),
                                                  list.filter.size(), ImGuiInputTextFlags_EnterReturnsTrue);
    if (wrong) ImGui::PopStyleColor();
    if (!ImGui::IsItemActive())
        widgets::tooltip(
            wrong ? list.trouble.c_str()
                  : ("Conditions, all of which hold: " + filter_examples() +
                     "; is:hidden, is:selected, is:leaf, is:named; system:portal; words of a name. Enter selects.")
                        .c_str());
    ImGui::SameLine(0.0F, 6.0F * scale);
    ImGui::BeginDisabled(list.rows.empty() || wrong);
    if (ImGui::Button(button.c_str(), {width, 0.0F}) || (entered && !wrong)) select_rows(context);
    ImGui::EndDisabled();
    widgets::tooltip("Selects the branches that are listed", "Enter");
    ImGui::PopStyleVar();
}

// Six rows and the headings, in the small font.
float least_table_height() {
    constexpr float kLeastRows = 6.0F;
    return (kLeastRows + 1.0F) * (ImGui::GetTextLineHeight() + 2.0F * ImGui::GetStyle().CellPadding.y) +
           2.0F * theme::scale();
}

} // namespace

float least_branch_list_height(const BranchList& list) {
    const float title = 2.0F * ImGui::GetFrameHeightWithSpacing() + 10.0F * theme::scale(); // and its line
    if (list.apart) return title;
    ImGui::PushFont(theme::small_font());
    const float height = title + ImGui::GetFrameHeightWithSpacing() + least_table_height();
    ImGui::PopFont();
    return height;
}

void draw_branch_list(InterfaceContext& context) {
    BranchList& list = context.interface.of<BranchList>();
    const auto& facts = context.workspace.facts();
    const Document& document = context.workspace.document();
    ImGui::PushFont(theme::small_font());
    draw_filter(context);
    read_filter(list);
    const float least = list.apart ? 0.0F : least_table_height();
    const ImVec2 size(0.0F, std::max(least, ImGui::GetContentRegionAvail().y));
    const float width = ImGui::GetContentRegionAvail().x;
    if (ImGui::BeginTable("branches", static_cast<int>(kFirstQuantity + rows_with(&QuantityRow::list).size()),
                          ImGuiTableFlags_Sortable | ImGuiTableFlags_ScrollY | ImGuiTableFlags_SizingStretchProp |
                              ImGuiTableFlags_NoSavedSettings | ImGuiTableFlags_PadOuterX,
                          size)) {
        ImGui::TableSetupScrollFreeze(0, 1);
        set_up_columns(list, document, width);
        draw_branch_headings(document.lengths());
        ImGuiTableSortSpecs* specs = ImGui::TableGetSortSpecs();
        if (specs != nullptr && std::exchange(specs->SpecsDirty, false)) list.made = false;
        list.sorted = specs != nullptr && specs->SpecsCount > 0 ? specs->Specs[0].ColumnIndex : static_cast<int>(kId);
        if (!is_current(list, *facts, document.marks())) make_rows(list, document, *facts, specs);
        const float row_height = ImGui::GetTextLineHeight() + 2.0F * ImGui::GetStyle().CellPadding.y;
        scroll_to_selection(list, document.marks(), row_height);
        handle_keys(context, row_height);
        if (list.rows.empty()) {
            ImGui::TableNextRow();
            ImGui::TableSetColumnIndex(kId);
            widgets::quiet("none");
        }
        widgets::clipped(list.rows.size(), [&](std::size_t row) { draw_row(context, list.rows[row]); });
        ImGui::EndTable();
    }
    ImGui::PopFont();
}

void draw_branch_window(InterfaceContext& context) {
    BranchList& list = context.interface.of<BranchList>();
    if (!list.apart || !context.workspace.document().tree() || !context.workspace.facts()) return;
    const Layout& layout = context.layout;
    const float scale = theme::scale();
    const ImVec2 view(static_cast<float>(layout.view_size.x), static_cast<float>(layout.view_size.y));
    const ImVec2 margin(16.0F * scale, 16.0F * scale);
    const ImVec2 size(std::min(520.0F * scale, view.x - 2.0F * margin.x),
                      std::min(420.0F * scale, view.y - 2.0F * margin.y));
    ImGui::SetNextWindowSize(size, ImGuiCond_Appearing);
    ImGui::SetNextWindowPos({static_cast<float>(layout.view_at.x) + margin.x,
                             static_cast<float>(layout.view_at.y) + view.y - margin.y - size.y},
                            ImGuiCond_Appearing);
    ImGui::SetNextWindowSizeConstraints({280.0F * scale, 180.0F * scale}, {view.x, view.y});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {12.0F * scale, 10.0F * scale});
    bool open = true;
    if (ImGui::Begin("Branches###branch window", &open,
                     ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoNavInputs |
                         ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse)) {
        const ImVec2 at = ImGui::GetWindowPos(), whole = ImGui::GetWindowSize();
        context.interface.note_covered();
        widgets::note("The window of branches", at, {at.x + whole.x, at.y + whole.y});
        draw_branch_list(context);
    }
    ImGui::End();
    ImGui::PopStyleVar();
    if (!open) context.perform("branches", {});
}

} // namespace ramus::app
