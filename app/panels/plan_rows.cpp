#include "app/panels/plan_rows.h"

#include "app/panels/editing.h"
#include "app/panels/row_buttons.h"
#include "app/panels/theme.h"
#include "app/panels/widgets.h"
#include "app/session/colour_by.h"
#include "app/session/numbers.h"

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

namespace {

std::vector<std::string> name_of(const ObjectRow& row) {
    return {std::string(row.kind), std::to_string(row.index + 1)};
}

bool is_of(const Editing::Object& trial, const ObjectRow& row) {
    return trial.kind == row.kind && trial.index == row.index;
}

// Shows the trial value in the picture.
void try_object(InterfaceContext& context, const Editing::Object& trial) {
    SceneObjects& tried = context.interface.tried_objects.emplace(context.workspace.document().marks());
    for_each_object_list(tried, [&]<class T>(std::vector<T>& list) {
        if (trial.kind != T::kNoun || trial.index >= list.size()) return;
        T& object = list[trial.index];
        object.colour = trial.colour.value_or(object.colour);
        if constexpr (SurfaceObject<T>) object.opacity = trial.opacity.value_or(object.opacity);
    });
}

} // namespace

void object_controls(InterfaceContext& context, const ObjectRow& row) {
    if (widgets::eye_button(row.visible, row.visible ? "Hide" : "Show"))
        context.perform(row.visible ? "object-hide" : "object-show", name_of(row));
    ImGui::SameLine(0.0F, 2.0F * theme::scale());
    if (!row.has_colour) return;
    Editing::Object& trial = context.interface.of<Editing>().object;
    const bool changing = is_of(trial, row) && trial.colour;
    Rgb colour = changing ? *trial.colour : row.colour;
    if (widgets::colour_swatch(colour)) {
        trial = {row.kind, row.index, colour, {}};
    } else if (changing && !ImGui::IsPopupOpen("colour")) {
        trial = {};
        auto words = name_of(row);
        words.push_back(colour_text(colour));
        if (colour != row.colour) context.perform("object-colour", words);
    }
    if (is_of(trial, row) && trial.colour) try_object(context, trial);
}

void object_opacity(InterfaceContext& context, const ObjectRow& row) {
    Editing::Object& trial = context.interface.of<Editing>().object;
    const bool changing = is_of(trial, row) && trial.opacity;
    float shown = static_cast<float>(changing ? *trial.opacity : row.opacity.value_or(1.0));
    ImGui::SetNextItemWidth(-44.0F * theme::scale());
    ImGui::SliderFloat("##opacity", &shown, 0.0F, 1.0F, "Opacity", ImGuiSliderFlags_AlwaysClamp);
    widgets::tooltip("Opacity");
    const bool done = ImGui::IsItemDeactivatedAfterEdit();
    if (ImGui::IsItemActive()) {
        trial = {row.kind, row.index, {}, static_cast<double>(shown)};
        try_object(context, trial);
    } else if (changing) {
        trial = {};
    }
    ImGui::SameLine();
    widgets::text_right(widgets::percent_text(shown));
    auto words = name_of(row);
    words.push_back(digits(static_cast<double>(shown), 3));
    if (done) context.perform("object-opacity", words);
}

void object_row(InterfaceContext& context, const ObjectRow& row) {
    ImGui::PushID((std::string(row.kind) + std::to_string(row.index)).c_str()); // kinds share a panel
    object_controls(context, row);
    const ImVec4& colour = row.words.trouble ? theme::kTrouble : row.visible ? theme::kText : theme::kQuiet;
    const std::string help = row.words.details + (row.words.details.empty() ? "" : "\n") +
                             "Click to bring it to the middle of the picture, double-click to name it";
    const int done = removable_row(row.words.title, colour, help.c_str(), row.words.value);
    const bool twice = done > 0 && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left);
    ImGui::PopID();
    if (done < 0)
        context.perform("object-remove", name_of(row));
    else if (twice)
        context.perform("object-name", name_of(row));
    else if (done > 0)
        context.perform("object-centre", name_of(row));
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
