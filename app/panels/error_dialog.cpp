// The dialog for errors of files: what, where, and what to do. The open document stays open.
#include "app/panels/error_dialog.h"

#include "app/panels/choice_row.h"
#include "app/panels/doctor_panel.h"
#include "app/panels/parts.h"
#include "app/panels/recovery_dialogs.h"
#include "app/panels/theme.h"
#include "app/panels/widgets.h"
#include "app/session/window_words.h"

#include <imgui.h>

namespace ramus::app {

namespace {

std::string sentence(const std::string& words) {
    std::string text = capitalised(words);
    if (!text.empty() && text.back() != '.') text += '.';
    return text;
}

// Asks for a radius for a file without radii; true: the file is being opened.
bool draw_radius_field(InterfaceContext& context, const Error& error) {
    const std::string file = context.workspace.asked_for().string();
    if (file.empty() || !error.where.starts_with(file) || error.hint.find("--radius MM") == std::string::npos)
        return false;
    auto& typed = context.interface.of<Doctor>().radius;
    ImGui::Dummy({0.0F, 4.0F * theme::scale()});
    widgets::begin_row("Radius", "The radius of all points, in mm; Enter opens the file with it");
    const bool entered = ImGui::InputTextWithHint("##radius", "mm; Enter opens the file with it", typed.data(),
                                                  typed.size(), ImGuiInputTextFlags_EnterReturnsTrue);
    ImGui::PopID();
    if (!entered || typed[0] == '\0') return false;
    context.perform("open", {file, "--tree", "--radius", typed.data()});
    typed = {};
    return true;
}

} // namespace

void draw_error_dialog(InterfaceContext& context) {
    auto& errors = context.interface.of<ErrorDialog>().errors;
    if (errors.empty() || !widgets::begin_dialog("error", 520.0F, 0.0F)) return;
    const Error error = in_window_words(errors.front());
    const bool recovery = context.interface.of<RecoveryDialog>().failed;
    widgets::heading(recovery ? "This session cannot be recovered" : "This file cannot be opened");
    ImGui::Dummy({0.0F, 2.0F * theme::scale()});
    ImGui::TextWrapped("%s", sentence(error.what).c_str());
    if (!error.hint.empty()) ImGui::TextWrapped("%s", sentence(error.hint).c_str());
    if (!error.where.empty()) widgets::quiet_wrapped(error.where.c_str());
    const bool opens = draw_radius_field(context, errors.front());
    ImGui::Dummy({0.0F, 6.0F * theme::scale()});
    const float width = 90.0F * theme::scale();
    const float other = 150.0F * theme::scale();
    bool another = false;
    widgets::align_right(recovery ? width : width + other + ImGui::GetStyle().ItemSpacing.x);
    if (!recovery) {
        another = ImGui::Button("Open another...", {other, 0.0F});
        ImGui::SameLine();
    }
    const bool typing = context.interface.of<Doctor>().radius[0] != '\0';
    const bool closed = widgets::button("Close", {width, 0.0F}, theme::kAccentDim) ||
                        (!typing && ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Enter), false));
    if (closed || another || opens) {
        if (!errors.empty()) errors.pop_front();
        ImGui::CloseCurrentPopup();
        if (another) context.perform("open", {});
    }
    widgets::end_dialog();
}

} // namespace ramus::app
