// The warnings panel at the left edge of the picture, and its mark in the status bar with the number of unread
// warnings.
#include "app/panels/warnings_panel.h"

#include "app/panels/left_panel.h"
#include "app/panels/parts.h"
#include "app/panels/theme.h"
#include "app/panels/widgets.h"
#include "app/session/numbers.h"
#include "app/session/window_words.h"

#include <filesystem>
#include <imgui.h>

namespace ramus::app {

namespace {

// Actions to run after the list is drawn, since they change it.
struct Pressed {
    std::optional<std::size_t> read;
    std::string command;
};

void draw_warning(const Warning& warning, std::size_t index, Pressed& pressed) {
    ImGui::PushID(static_cast<int>(index));
    ImGui::PushStyleColor(ImGuiCol_Text, warning.read ? theme::kQuiet : theme::kText);
    ImGui::TextWrapped("%s", capitalised(warning.what).c_str());
    ImGui::PopStyleColor();
    ImGui::PushFont(theme::small_font());
    if (!warning.where.empty()) {
        const std::string name = std::filesystem::path(warning.where).filename().string();
        widgets::quiet_wrapped(("Where: " + name).c_str());
        widgets::tooltip(warning.where.c_str());
    }
    if (!warning.remedy.empty()) widgets::quiet_wrapped(("What to do: " + warning.remedy).c_str());
    ImGui::PopFont();
    const std::string number = std::string(" ").append(std::to_string(index + 1));
    if (!warning.command.empty()) {
        if (widgets::small_button("Go there", "Shows where it can be looked at and changed"))
            pressed.command = warning.command;
        widgets::note_item(("Go to warning" + number).c_str());
        ImGui::SameLine();
    }
    if (!warning.read) {
        if (widgets::small_button("I have read it", "Takes it out of the count in the status bar"))
            pressed.read = index;
        widgets::note_item(("Read warning" + number).c_str());
    } else {
        widgets::quiet("read");
    }
    ImGui::PopID();
}

} // namespace

void draw_warnings(InterfaceContext& context) {
    WarningsPanel& panel = context.interface.of<WarningsPanel>();
    const Document& document = context.workspace.document();
    panel.list.follow(document.tree(), document.session().tree.path.string());
    if (!context.interface.left_is<WarningsPanel>()) return;
    begin_left_panel("warnings", context);
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted("Warnings");
    ImGui::SameLine();
    const bool unread = panel.list.unread() > 0;
    const float scale = theme::scale();
    widgets::align_right(ImGui::CalcTextSize(unread ? "Read allClose" : "Close").x + (unread ? 32.0F : 14.0F) * scale);
    bool all = false;
    if (unread) {
        all = widgets::small_button("Read all", "Takes all of them out of the count");
        widgets::note_item("Read all warnings");
        ImGui::SameLine(0.0F, 4.0F * scale);
    }
    if (widgets::small_button("Close", "Hides this list; the status bar shows it again"))
        context.interface.close_left();
    Pressed pressed;
    for (std::size_t index = panel.list.all().size(); index-- > 0;) { // the newest first
        widgets::rule();
        draw_warning(panel.list.all()[index], index, pressed);
    }
    if (panel.list.all().empty()) widgets::quiet_wrapped("No warnings.");
    ImGui::End();
    if (pressed.read) panel.list.mark_read(*pressed.read);
    if (all) context.perform("warnings", {"read"});
    if (!pressed.command.empty()) context.perform(pressed.command, {});
}

float draw_warning_mark(InterfaceContext& context, float right_edge) {
    WarningsPanel& panel = context.interface.of<WarningsPanel>();
    const std::size_t unread = panel.list.unread();
    if (unread == 0) return right_edge;
    const std::string text = counted(unread, "warning", "warnings");
    const float width = ImGui::CalcTextSize(text.c_str()).x + 16.0F * theme::scale();
    const float start = right_edge - width - 16.0F * theme::scale();
    ImGui::SetCursorPosX(start);
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {8.0F * theme::scale(), 0.0F});
    ImGui::PushStyleColor(ImGuiCol_Text, theme::kHighlight);
    const bool pressed = ImGui::Button(text.c_str(), {width, 0.0F});
    ImGui::PopStyleColor();
    ImGui::PopStyleVar();
    widgets::note_item("Warnings");
    widgets::tooltip("Shows what nobody has read yet");
    if (pressed) context.perform("warnings", {});
    return start;
}

} // namespace ramus::app
