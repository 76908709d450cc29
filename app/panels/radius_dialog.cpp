// A field for the diameter of what is selected, or for a factor.
#include "app/panels/radius_dialog.h"

#include "app/panels/parts.h"
#include "app/panels/theme.h"
#include "app/panels/widgets.h"
#include "app/session/numbers.h"
#include "core/base/words.h"

#include <imgui.h>

namespace ramus::app {

void draw_radius(InterfaceContext& context) {
    RadiusDialog& dialog = context.interface.of<RadiusDialog>();
    const auto& selection = context.workspace.document().marks().selection;
    if (dialog.open && selection.empty()) dialog.open = false;
    if (!dialog.open || !widgets::begin_dialog("##radius", 380.0F, 0.0F)) return;
    const float scale = theme::scale();
    widgets::heading(("Diameter of " + counted(selection.size(), "branch", "branches")).c_str());
    ImGui::Dummy({0.0F, 2.0F * scale});
    if (std::exchange(dialog.fresh, false)) ImGui::SetKeyboardFocusHere();
    ImGui::SetNextItemWidth(120.0F * scale);
    const bool entered = ImGui::InputText("##number", dialog.text.data(), dialog.text.size(),
                                          ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_AutoSelectAll |
                                              ImGuiInputTextFlags_CharsDecimal);
    ImGui::SameLine();
    if (ImGui::RadioButton(context.workspace.document().lengths().unit().c_str(), !dialog.scales))
        dialog.scales = false;
    ImGui::SameLine();
    if (ImGui::RadioButton("times", dialog.scales)) dialog.scales = true;
    widgets::quiet_wrapped("Nodes that they share with other branches keep theirs.");
    ImGui::Dummy({0.0F, 4.0F * scale});
    const float width = 90.0F * scale;
    widgets::align_right(2.0F * width + ImGui::GetStyle().ItemSpacing.x);
    if (ImGui::Button("Cancel", {width, 0.0F})) dialog.open = false;
    ImGui::SameLine();
    if (ImGui::Button("Set", {width, 0.0F}) || entered) {
        dialog.open = false;
        const auto diameter = parsed<double>(std::string_view(dialog.text.data()));
        const bool halves = !dialog.scales && diameter;
        context.perform(dialog.scales ? "scale-radius" : "set-radius",
                        {halves ? exact_text(0.5 * *diameter) : std::string(dialog.text.data())});
    }
    if (!dialog.open) ImGui::CloseCurrentPopup();
    widgets::end_dialog();
}

} // namespace ramus::app
