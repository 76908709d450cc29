// The context menu: commands for the object or the branch under the pointer, or for the view.
#include "app/panels/context_menu.h"

#include "app/panels/parts.h"
#include "app/panels/slice_menu.h"
#include "app/panels/theme.h"
#include "app/panels/widgets.h"
#include "app/session/labels.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <imgui.h>
#include <string>
#include <utility>
#include <vector>

namespace ramus::app {

namespace {

// Names of commands in groups, separated by lines.
using Group = std::array<const char*, 5>;
constexpr std::array kForBranch{
    Group{"select-dependents", "select-upstream"},
    Group{"highlight", "defocus", "defocus-others", "hide", "show"},
    Group{"cut", "rename", "fly-along", "along"},
    Group{"show-all", "fit"},
};
constexpr std::array kForBackground{
    Group{"fit", "orthographic"},
    Group{"show-all", "select-none"},
    Group{"palette", "help"},
};

// The menu entry of a command; null: none.
const Command* menu_entry(std::string_view name) {
    const auto& table = command_table();
    const auto at = std::ranges::find_if(
        table, [&](const Command& c) { return c.name == name && !c.menu.empty() && c.preset.empty(); });
    return at == table.end() ? nullptr : &*at;
}

// These entries are not under a menu's title, so selecting commands need the word themselves.
std::string label_here(const Command& command, const Document& document) {
    std::string label = label_of(command, document);
    if (command.menu != "Select") return label;
    label.front() = static_cast<char>(std::tolower(static_cast<unsigned char>(label.front())));
    return "Select " + label;
}

template <std::size_t Count>
const Command* draw_groups(InterfaceContext& context, const std::array<Group, Count>& groups) {
    const Command* chosen = nullptr;
    const Document& document = context.workspace.document();
    for (const Group& group : groups) {
        ImGui::Separator();
        for (const char* name : group) {
            const Command* command = name != nullptr ? menu_entry(name) : nullptr;
            if (command == nullptr) continue;
            const bool enabled = command->enabled == nullptr || command->enabled(document);
            const bool checked = command->checked != nullptr && command->checked(document);
            const std::string label = label_here(*command, document);
            if (ImGui::MenuItem(label.c_str(), command->keys.empty() ? nullptr : command->keys.front().c_str(), checked,
                                enabled))
                chosen = command;
            widgets::note_item(("menu: " + label).c_str());
        }
    }
    return chosen;
}

std::string branch_title(const Document& document, int branch) {
    const std::size_t selected = document.marks().selection.size();
    if (selected > 1) return grouped(selected) + " branches selected";
    const std::string label = label_of(document.dependency(), document.marks(), branch);
    return label.empty() ? "Branch " + std::to_string(branch) : label;
}

// Returns the chosen command line; empty: none.
std::vector<std::string> draw_object_entries(const InterfaceContext& context, const ObjectPlace& object) {
    const Document& document = context.workspace.document();
    const ObjectWords words = words_of(object, document.marks(), context.workspace.assets(), document.lengths());
    ImGui::TextColored(theme::kAccent, "%s", widgets::fitted(words.title, 220.0F * theme::scale()).c_str());
    ImGui::Separator();
    std::vector<std::string> chosen;
    for (const auto& [label, command] : {std::pair("Bring to the middle", "object-centre"),
                                         {"Name\xE2\x80\xA6", "object-name"},
                                         {"Hide", "object-hide"},
                                         {"Remove", "object-remove"}}) {
        if (ImGui::MenuItem(label)) chosen = {command, std::string(object.kind), std::to_string(object.index + 1)};
        widgets::note_item((std::string("menu: ") + label).c_str());
    }
    return chosen;
}

// Names a branch and all that depends on it as a segment of the liver (Couinaud).
std::vector<std::string> draw_segment_names(int branch) {
    constexpr int kSegments = 8;
    std::vector<std::string> chosen;
    const bool open = ImGui::BeginMenu("Name as segment");
    widgets::note_item("menu: Name as segment");
    if (!open) return chosen;
    for (int segment = 1; segment <= kSegments; ++segment) {
        const std::string name = "S" + std::to_string(segment);
        if (ImGui::MenuItem(name.c_str())) chosen = {"name", std::to_string(branch), name, "subtree"};
        widgets::note_item(("menu: " + name).c_str());
    }
    ImGui::EndMenu();
    return chosen;
}

// The commands for a branch under its name, in a menu of several things.
const Command* draw_branch_menu(InterfaceContext& context, int branch) {
    const std::string title =
        widgets::fitted(branch_title(context.workspace.document(), branch), 220.0F * theme::scale());
    const bool open = ImGui::BeginMenu((title + "##branch").c_str());
    widgets::note_item("menu: branch");
    if (!open) return nullptr;
    const Command* chosen = draw_groups(context, kForBranch);
    ImGui::EndMenu();
    return chosen;
}

} // namespace

void draw_context_menu(InterfaceContext& context) {
    ContextMenu& menu = context.interface.of<ContextMenu>();
    constexpr const char* kPopup = "##context-menu";
    const Document& document = context.workspace.document();
    if (std::exchange(menu.wanted, false)) {
        ImGui::OpenPopup(kPopup);
        menu.open = true;
    }
    if (!menu.open) return;
    const float scale = theme::scale();
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {10.0F * scale, 8.0F * scale});
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {12.0F * scale, 7.0F * scale});
    if (menu.branch >= document.branch_count()) menu.close = true;
    if (ImGui::BeginPopup(kPopup, ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings)) {
        const Command* chosen = nullptr;
        std::vector<std::string> line;
        if (menu.object) {
            line = draw_object_entries(context, *menu.object);
        } else if (menu.slice && !menu.close) {
            line = draw_slice_entries(context, *menu.slice, menu.branch);
            if (menu.branch != tree::kNoBranch) chosen = draw_branch_menu(context, menu.branch);
        } else if (menu.branch == tree::kNoBranch) {
            widgets::quiet("View");
            chosen = draw_groups(context, kForBackground);
        } else if (!menu.close) {
            ImGui::TextColored(theme::kAccent, "%s",
                               widgets::fitted(branch_title(document, menu.branch), 220.0F * scale).c_str());
            chosen = draw_groups(context, kForBranch);
            if (document.marks().organ.any()) line = draw_segment_names(menu.branch);
        }
        if (chosen != nullptr || !line.empty() || std::exchange(menu.close, false)) ImGui::CloseCurrentPopup();
        ImGui::EndPopup();
        if (chosen != nullptr) context.perform(*chosen);
        if (!line.empty()) context.perform(line.front(), {line.begin() + 1, line.end()});
    } else {
        menu.open = menu.close = false; // closed by a click outside
    }
    ImGui::PopStyleVar(2);
}

} // namespace ramus::app
