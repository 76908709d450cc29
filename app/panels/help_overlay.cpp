// The help overlay: mouse and keys, from the command table, with a search field.
#include "app/panels/help_overlay.h"

#include "app/panels/parts.h"
#include "app/panels/theme.h"
#include "app/panels/widgets.h"
#include "core/base/words.h"
#include "core/io/text_numbers.h"

#include <algorithm>
#include <array>
#include <imgui.h>

namespace ramus::app {

namespace {

constexpr std::array<std::pair<const char*, const char*>, 11> kMouse{{
    {"Left-drag", "Turns the tree."},
    {"Middle-drag, Shift+left-drag", "Moves the picture."},
    {"Right-drag, wheel", "Zooms; the wheel zooms to the pointer."},
    {"Click", "Selects the branch; on the background, nothing."},
    {"Alt+click, Ctrl+Shift+click", "Selects the branch with all that depends on it."},
    {"Shift+click", "Adds the branch to the selection."},
    {"Ctrl+click", "Adds the branch to the selection, or takes it away."},
    {"Right-click", "Opens a menu for the branch, or for the view."},
    {"Double-click", "Centres the picture on the point."},
    {"Drop a file",
     "Opens a tree, a session or a mask; a mesh is shown beside the tree, while planning it is a lesion. "
     "Asks what a mask becomes when there is a tree."},
    {"Cube", "Shows where the viewer stands: A P L R S I."},
}};

bool contains(std::string_view text, std::string_view wanted) {
    return io::lower_case(text).find(io::lower_case(wanted)) != std::string::npos;
}

class HelpTable {
public:
    explicit HelpTable(std::string_view wanted) : wanted_(wanted) {}
    void group(const char* title) { title_ = title; }
    // Shown if any of its words contains the search text.
    void row(const std::string& keys, const std::string& label, const std::string& name, const std::string& help) {
        if (!wanted_.empty() && !contains(keys, wanted_) && !contains(label, wanted_) && !contains(name, wanted_) &&
            !contains(help, wanted_))
            return;
        if (title_ != nullptr) {
            ImGui::TableNextRow();
            ImGui::TableNextColumn();
            ImGui::Dummy({0.0F, 4.0F * theme::scale()});
            ImGui::TextColored(theme::kAccent, "%s", title_);
            title_ = nullptr;
        }
        ImGui::TableNextRow();
        ImGui::TableNextColumn();
        ImGui::TextUnformatted(keys.empty() ? name.c_str() : keys.c_str());
        ImGui::TableNextColumn();
        if (!label.empty()) ImGui::TextUnformatted(label.c_str());
        if (!label.empty()) ImGui::SameLine(0.0F, 10.0F * theme::scale());
        widgets::quiet_wrapped(help.c_str());
        any_ = true;
    }
    [[nodiscard]] bool any() const { return any_; }

private:
    std::string_view wanted_;
    const char* title_ = nullptr;
    bool any_ = false;
};

void draw_headings_of_help() {
    ImGui::TableNextRow(ImGuiTableRowFlags_Headers);
    ImGui::TableNextColumn();
    widgets::column_heading("Mouse or key", "What the hand does; a dash: the menu alone");
    ImGui::TableNextColumn();
    widgets::column_heading("What it does", "The name in the menu, and what it does");
}

void draw_rows(HelpTable& table) {
    table.group("Mouse");
    for (const auto& [gesture, help] : kMouse) table.row(gesture, "", "", help);
    std::string menu;
    for (const Command& command : command_table()) {
        if (command.keys.empty() && command.menu.empty()) continue;
        const std::string& title = command.menu.empty() ? menu : command.menu;
        if (title != menu) table.group(title.c_str());
        menu = title;
        if (!command.keys.empty())
            table.row(joined(command.keys), command.label, command.name, command.help);
        else
            table.row("\xE2\x80\x93", command.label, command.name, command.help);
    }
    table.group("Only in commands files");
    for (const Command& command : command_table())
        if (command.keys.empty() && command.menu.empty())
            table.row(command.name + " " + command.arguments, "", command.name, command.help);
}

} // namespace

void draw_help(InterfaceContext& context) {
    Interface& interface = context.interface;
    if (!interface.of<Help>().open) return;
    if (!widgets::begin_dialog("help", 760.0F, 640.0F)) return;
    widgets::heading("Mouse and keys");
    ImGui::SameLine();
    const float close_width = 70.0F * theme::scale();
    const float search_width = 220.0F * theme::scale();
    widgets::align_right(search_width + close_width + ImGui::GetStyle().ItemSpacing.x);
    ImGui::SetNextItemWidth(search_width);
    if (ImGui::IsWindowAppearing()) {
        interface.of<Help>().search.fill('\0');
        ImGui::SetKeyboardFocusHere();
    }
    ImGui::InputTextWithHint("##search", "Search", interface.of<Help>().search.data(),
                             interface.of<Help>().search.size());
    ImGui::SameLine();
    bool close = ImGui::Button("Close", {close_width, 0.0F});
    ImGui::Dummy({0.0F, 2.0F * theme::scale()});
    ImGui::BeginChild("rows", {0.0F, 0.0F});
    HelpTable table(interface.of<Help>().search.data());
    if (ImGui::BeginTable("keys", 2, ImGuiTableFlags_SizingFixedFit | ImGuiTableFlags_ScrollY)) {
        ImGui::TableSetupScrollFreeze(0, 1);
        ImGui::TableSetupColumn("keys", ImGuiTableColumnFlags_WidthFixed, 220.0F * theme::scale());
        ImGui::TableSetupColumn("help", ImGuiTableColumnFlags_WidthStretch);
        draw_headings_of_help();
        draw_rows(table);
        ImGui::EndTable();
    }
    if (!table.any()) widgets::quiet("Nothing has these letters in it.");
    ImGui::EndChild();
    if (close) {
        interface.of<Help>().open = false;
        ImGui::CloseCurrentPopup();
    }
    widgets::end_dialog();
}

} // namespace ramus::app
