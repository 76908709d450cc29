// A mask was dropped on a window that shows a tree: another tree is made of it, or it is shown beside this one.
#include "app/panels/interface.h"
#include "app/panels/theme.h"
#include "app/panels/widgets.h"

#include <cmath>
#include <imgui.h>

namespace ramus::app {

namespace {

// A button with a line below that says what it does. `key`: a letter that does the same.
bool draw_choice(const char* text, const char* words, const char* key, bool marked) {
    const float scale = theme::scale();
    const float height = 2.0F * ImGui::GetTextLineHeight() + 18.0F * scale;
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float width = ImGui::GetContentRegionAvail().x;
    const ImVec4 ground = marked ? theme::kAccentDim : ImGui::GetStyleColorVec4(ImGuiCol_Button);
    ImGui::PushID(text);
    const bool pressed = widgets::button("##choice", {width, height}, ground);
    ImGui::PopID();
    widgets::note_item(text);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const float left = std::round(at.x + 12.0F * scale), top = std::round(at.y + 8.0F * scale);
    list.AddText({left, top}, ImGui::GetColorU32(theme::kText), text);
    const ImU32 quiet = ImGui::GetColorU32(marked ? theme::kText : theme::kQuiet);
    list.AddText({left, top + ImGui::GetTextLineHeight() + 2.0F * scale}, quiet, words);
    list.AddText({std::round(at.x + width - 12.0F * scale - ImGui::CalcTextSize(key).x), top}, quiet, key);
    return pressed;
}

// A key that brought the dialog does not answer it.
bool pressed(int key) { return !ImGui::IsWindowAppearing() && ImGui::IsKeyPressed(key, false); }

} // namespace

void draw_drop_dialog(InterfaceContext& context) {
    DropDialog& dialog = context.interface.drop;
    if (!dialog.open() || !context.interface.errors.empty() || context.interface.unsaved.open()) return;
    if (!widgets::begin_dialog("drop", 460.0F, 0.0F)) return;
    const float scale = theme::scale();
    const std::string name = dialog.file.filename().string();
    const std::string shown = context.workspace.document.session().tree.path.filename().string();
    const float width = ImGui::GetContentRegionAvail().x;
    ImGui::PushFont(theme::title_font());
    const std::string title = widgets::fitted(name, width - ImGui::CalcTextSize(" is a mask").x) + " is a mask";
    ImGui::PopFont();
    widgets::heading(title.c_str());
    ImGui::Dummy({0.0F, 4.0F * scale});
    // What was chosen last stands first.
    std::optional<bool> beside;
    const bool first = context.interface.settings.drop_beside;
    for (const bool this_beside : {first, !first}) {
        const bool marked = dialog.beside == this_beside;
        const std::string words =
            this_beside ? "As a surface around " + shown : "A tree is made of it, in the place of " + shown;
        if (draw_choice(this_beside ? "Show beside the tree" : "Open as a new tree",
                        widgets::fitted(words, width - 24.0F * scale).c_str(), this_beside ? "B" : "T", marked))
            beside = this_beside;
    }
    ImGui::Dummy({0.0F, 4.0F * scale});
    const float cancel_width = 90.0F * scale;
    widgets::align_right(cancel_width);
    const bool cancelled = ImGui::Button("Cancel", {cancel_width, 0.0F});
    widgets::tooltip("Nothing is opened", "Escape");
    for (const ImGuiKey key : {ImGuiKey_UpArrow, ImGuiKey_DownArrow, ImGuiKey_Tab})
        if (pressed(ImGui::GetKeyIndex(key))) dialog.beside = !dialog.beside;
    constexpr int kB = 'B', kT = 'T'; // as GLFW numbers them
    if (pressed(kB)) beside = true;
    if (pressed(kT)) beside = false;
    if (pressed(ImGui::GetKeyIndex(ImGuiKey_Enter)) || pressed(ImGui::GetKeyIndex(ImGuiKey_KeyPadEnter)))
        beside = dialog.beside;
    if (beside || cancelled) {
        ImGui::CloseCurrentPopup();
        const std::filesystem::path file = std::exchange(dialog.file, {});
        if (beside) context.interface.settings.drop_beside = *beside;
        if (beside) context.perform(*beside ? "context" : "open", {file.string()});
    }
    widgets::end_dialog();
}

} // namespace ramus::app
