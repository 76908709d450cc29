#include "app/panels/choice_row.h"

#include "app/panels/theme.h"
#include "app/panels/widgets.h"

#include <imgui.h>

namespace ramus::app::widgets {

void begin_row(const char* label, const char* help, float width) {
    ImGui::AlignTextToFramePadding();
    quiet(label);
    tooltip(help);
    ImGui::SameLine(ImGui::GetStyle().WindowPadding.x + 70.0F * theme::scale());
    ImGui::SetNextItemWidth(width);
    const ImVec2 at = ImGui::GetCursorScreenPos();
    note(help, at, {at.x + ImGui::GetContentRegionAvail().x, at.y + ImGui::GetFrameHeight()});
    ImGui::PushID(label);
}

std::optional<std::string> choice_row(const char* label, const char* help, const std::string& now,
                                      const std::vector<std::pair<std::string, std::string>>& entries) {
    begin_row(label, help);
    std::string shown = now;
    for (const auto& [value, text] : entries)
        if (value == now) shown = text;
    std::optional<std::string> chosen;
    if (ImGui::BeginCombo("##choice", shown.c_str(), ImGuiComboFlags_HeightLarge)) {
        for (const auto& [value, text] : entries) {
            if (ImGui::Selectable(text.c_str(), value == now) && value != now) chosen = value;
            note_item(text.c_str());
        }
        ImGui::EndCombo();
    }
    ImGui::PopID();
    return chosen;
}

std::optional<std::string> mesh_axes_row(const std::string& asked) {
    return choice_row("Axes", "The file does not say where its axes lead: LPS where the mesh lies half a turn away",
                      asked.empty() ? "RAS" : asked, {{"RAS", "RAS"}, {"LPS", "LPS, as in ITK"}});
}

} // namespace ramus::app::widgets
