#include "app/panels/plan_rows.h"

#include "app/panels/editing.h"
#include "app/panels/row_buttons.h"
#include "app/panels/theme.h"
#include "app/panels/widgets.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace ramus::app::plan_rows {

std::string branch_name(const Document& document, int branch) {
    const auto name = document.marks().names.find(branch);
    return name == document.marks().names.end() ? "Branch " + std::to_string(branch) : name->second;
}

int removable_row(const std::string& text, const ImVec4& colour, const char* help, const std::string& value) {
    const float cross = ImGui::GetFrameHeight();
    const float width = ImGui::GetContentRegionAvail().x - cross;
    const float of_value = ImGui::CalcTextSize(value.c_str()).x;
    int result = 0;
    ImGui::PushStyleColor(ImGuiCol_Text, colour);
    const std::string shown = widgets::fitted(text, width - of_value - 12.0F * theme::scale());
    ImGui::AlignTextToFramePadding();
    if (ImGui::Selectable(shown.c_str(), false, ImGuiSelectableFlags_AllowDoubleClick, {width, 0.0F})) result = 1;
    widgets::tooltip(shown == text ? help : text.c_str());
    const ImVec2 line = ImGui::GetItemRectMin();
    ImGui::GetWindowDrawList()->AddText({std::round(line.x + width - of_value - 4.0F * theme::scale()),
                                         std::round(line.y + 0.5F * ImGui::GetStyle().ItemSpacing.y)},
                                        ImGui::GetColorU32(ImGuiCol_Text), value.c_str());
    ImGui::PopStyleColor();
    ImGui::SameLine();
    widgets::align_right(cross);
    if (widgets::button("\xC3\x97", {cross, 0.0F}, theme::kNothing, theme::kQuiet)) result = -1;
    widgets::tooltip("Remove");
    return result;
}

void object_eye(InterfaceContext& context, const std::string& kind, std::size_t index, bool visible) {
    if (widgets::eye_button(visible, visible ? "Hide" : "Show"))
        context.perform(visible ? "object-hide" : "object-show", {kind, std::to_string(index + 1)});
    ImGui::SameLine(0.0F, 2.0F * theme::scale());
}

bool object_row(InterfaceContext& context, const std::string& kind, std::size_t index, bool visible,
                const RowWords& words) {
    ImGui::PushID(static_cast<int>(index));
    object_eye(context, kind, index, visible);
    const ImVec4& colour = words.trouble ? theme::kTrouble : visible ? theme::kText : theme::kQuiet;
    const int done = removable_row(words.what, colour, words.help.c_str(), words.value);
    const bool twice = done > 0 && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left);
    ImGui::PopID();
    const std::vector<std::string> which{kind, std::to_string(index + 1)};
    if (done < 0) context.perform("object-remove", which);
    if (twice) context.perform("object-name", which);
    return done > 0 && !twice;
}

std::vector<std::string> number_field(InterfaceContext& context, const char* id, const std::string& current,
                                      float width, float before_right) {
    auto& [owner, typed] = context.interface.of<Editing>().numbers;
    widgets::align_right(width * theme::scale() + before_right);
    std::array<char, 64> shown{};
    std::copy_n(current.begin(), std::min(current.size(), shown.size() - 1), shown.begin());
    const bool mine = owner == id;
    ImGui::SetNextItemWidth(width * theme::scale());
    ImGui::PushID(id);
    const bool entered = ImGui::InputText("##numbers", mine ? typed.data() : shown.data(), typed.size(),
                                          ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_AutoSelectAll);
    ImGui::PopID();
    if (ImGui::IsItemActivated()) owner = id, typed = shown;
    std::vector<std::string> words;
    if (mine && (entered || ImGui::IsItemDeactivatedAfterEdit())) {
        std::string word;
        for (const char c : std::string(typed.data()) + " ") {
            if (c != ' ' && c != ',' && c != ';')
                word += c;
            else if (!word.empty())
                words.push_back(std::exchange(word, {}));
        }
    }
    if (mine && ImGui::IsItemDeactivated()) owner.clear();
    return words;
}

void field_label(const InterfaceContext& context, const char* label) {
    ImGui::AlignTextToFramePadding();
    widgets::quiet(context.workspace.document().lengths().worded(label).c_str());
    ImGui::SameLine();
}

void go_to(InterfaceContext& context, int branch) {
    context.perform("select", {std::to_string(branch)});
    context.perform("go-to", {std::to_string(branch)});
}

} // namespace ramus::app::plan_rows
