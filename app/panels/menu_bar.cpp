// Menus from the command table at the left, buttons for the anatomical views at the right.
#include "app/panels/menu_bar.h"

#include "app/panels/parts.h"
#include "app/panels/theme.h"
#include "app/panels/widgets.h"
#include "app/session/numbers.h"

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <imgui.h>
#include <string_view>
#include <utility>

namespace ramus::app {

namespace {

void draw_entry(InterfaceContext& context, const Command& command) {
    const Document& document = context.workspace.document();
    const bool enabled = command.enabled == nullptr || command.enabled(document);
    const bool checked = (command.checked != nullptr && command.checked(document)) ||
                         (command.in_use != nullptr && command.in_use(context.actions, command));
    const std::string label = label_of(command, document);
    if (ImGui::MenuItem(label.c_str(), command.keys.empty() ? nullptr : command.keys.front().c_str(), checked, enabled))
        context.perform(command);
    widgets::tooltip(document.lengths().worded(command.help).c_str(), nullptr, widgets::TooltipAt::kMenu);
}

// The last steps, newest first, down to the initial state; the current one is marked.
void draw_history(InterfaceContext& context) {
    const Document& document = context.workspace.document();
    constexpr std::size_t kShown = 20;
    constexpr std::size_t kUndoneShown = 8; // of them
    if (!ImGui::BeginMenu("History", document.step_count() > 0)) return;
    const std::size_t here = document.position();
    const std::size_t last = std::min(document.step_count(), here + kUndoneShown);
    const std::size_t first = last > kShown ? last - kShown : 0;
    std::size_t chosen = here;
    for (std::size_t after = last + 1; after-- > first;) { // the state after this many steps
        const bool undone = after > here;
        std::string label = after == 0 ? "as it was opened" : document.lengths().worded(document.step_name(after - 1));
        if (undone) ImGui::PushStyleColor(ImGuiCol_Text, theme::kQuiet);
        ImGui::PushID(static_cast<int>(after));
        if (ImGui::MenuItem(label.c_str(), undone ? "undone" : nullptr, after == here)) chosen = after;
        ImGui::PopID();
        if (undone) ImGui::PopStyleColor();
    }
    if (first > 0) widgets::quiet((grouped(first) + " earlier").c_str());
    ImGui::EndMenu();
    if (chosen < here) context.perform("undo", {std::to_string(here - chosen)});
    if (chosen > here) context.perform("redo", {std::to_string(chosen - here)});
}

void draw_recent(InterfaceContext& context) {
    const auto& files = context.interface.recent_files;
    if (!ImGui::BeginMenu("Open recent", !files.empty())) return;
    std::filesystem::path chosen;
    for (const auto& file : files) {
        ImGui::PushID(file.c_str());
        if (ImGui::MenuItem(file.filename().c_str())) chosen = file;
        widgets::tooltip(file.c_str());
        ImGui::PopID();
    }
    ImGui::EndMenu();
    if (!chosen.empty()) context.perform("open", {chosen.string()});
}

// Moves between menus by arrow keys, until ImGui handles them inside a menu.
void step_from_menu_to_menu(Interface& interface, const std::vector<std::string>& menus) {
    const auto open = std::ranges::find(menus, interface.of<BarMenus>().open_name);
    const int step = std::exchange(interface.of<BarMenus>().step, 0);
    interface.of<BarMenus>().entry &= interface.of<BarMenus>().by_keys && open != menus.end();
    if (open == menus.end() || step == 0) return;
    const auto at = static_cast<int>(open - menus.begin()), count = static_cast<int>(menus.size());
    ImGui::OpenPopup(menus[static_cast<std::size_t>(((at + step) % count + count) % count)].c_str());
}

// Menus end above the window's lower edge and scroll: ImGui would move a longer menu up over its button, and releasing
// the mouse button would choose an entry.
bool begin_menu(const std::string& name, float top, const InterfaceContext& context) {
    const float room = static_cast<float>(context.layout.window.y) - top - 8.0F * theme::scale();
    ImGui::SetNextWindowSizeConstraints({0.0F, 0.0F}, {FLT_MAX, std::max(room, 80.0F * theme::scale())});
    return ImGui::BeginMenu(name.c_str());
}

// A click goes there; the panel names and deletes them.
void draw_view_list(InterfaceContext& context) {
    const std::vector<SavedView>& views = context.workspace.document().marks().views;
    ImGui::BeginDisabled(views.empty());
    std::string chosen;
    if (begin_menu("Saved views", static_cast<float>(context.layout.bar_height), context)) {
        for (std::size_t i = 0; i < views.size(); ++i) {
            constexpr float kMostPoints = 300.0F;
            const SavedView& view = views[i];
            ImGui::PushID(static_cast<int>(i));
            if (ImGui::MenuItem(widgets::fitted(view.name, kMostPoints * theme::scale()).c_str())) chosen = view.name;
            widgets::tooltip(("Go to " + view.name).c_str(), nullptr, widgets::TooltipAt::kMenu);
            ImGui::PopID();
        }
        ImGui::EndMenu();
    }
    ImGui::EndDisabled();
    if (!chosen.empty()) context.perform("view-go", {chosen});
}

// Arrays of the tree's file, which the command table cannot know.
void draw_data_colours(InterfaceContext& context) {
    const Document& document = context.workspace.document();
    const auto tree = document.tree();
    const bool some = tree && (!tree->point_data.empty() || !tree->branch_data.empty());
    ImGui::BeginDisabled(!some);
    if (begin_menu("Data of the file", static_cast<float>(context.layout.bar_height), context)) {
        for (const tree::DataArrays* arrays : {&tree->point_data, &tree->branch_data})
            for (const tree::DataArray& array : *arrays) {
                const std::string name = name_of(ColourBy::array(array.name));
                ImGui::PushID(name.c_str());
                if (ImGui::MenuItem(array.name.c_str(), nullptr, name_of(document.marks().colour_by) == name))
                    context.perform("colour-by", {name});
                ImGui::PopID();
            }
        ImGui::EndMenu();
    }
    ImGui::EndDisabled();
}

// Entries of a submenu are grouped at the position of the first.
void draw_entries(InterfaceContext& context, const std::string& menu) {
    const std::vector<Command>& table = command_table();
    std::string_view previous;
    std::vector<std::string_view> submenus;
    for (const Command& command : table) {
        if (command.menu != menu) continue;
        if (!command.submenu.empty()) {
            if (std::ranges::find(submenus, command.submenu) != submenus.end()) continue;
            submenus.emplace_back(command.submenu);
            // A submenu may use the menu's space: ImGui moves it next to its entry, never over it.
            if (begin_menu(command.submenu, static_cast<float>(context.layout.bar_height), context)) {
                for (const Command& entry : table)
                    if (entry.menu == menu && entry.submenu == command.submenu) draw_entry(context, entry);
                ImGui::EndMenu();
            }
            continue;
        }
        const bool new_switch =
            previous != command.name && (command.name.starts_with("lasso-") || command.name == "colour-map");
        if (previous != command.name && command.name == "colour-map") draw_data_colours(context);
        if (command.name == "quit" || command.name == "join" || new_switch) ImGui::Separator();
        previous = command.name;
        draw_entry(context, command);
        if (command.name == "open") draw_recent(context);
        if (command.name == "redo") draw_history(context);
        if (command.name == "view-save") draw_view_list(context);
    }
}

void draw_menus(InterfaceContext& context) {
    std::vector<std::string> menus;
    for (const Command& command : command_table())
        if (!command.menu.empty() && std::find(menus.begin(), menus.end(), command.menu) == menus.end())
            menus.push_back(command.menu);
    const bool close = std::exchange(context.interface.of<BarMenus>().close, false);
    context.interface.of<BarMenus>().open = false;
    // Opens the first menu as if it was clicked; arrows work from there.
    if (std::exchange(context.interface.of<BarMenus>().wanted, false)) ImGui::OpenPopup(menus.front().c_str());
    step_from_menu_to_menu(context.interface, menus);
    context.interface.of<BarMenus>().open_name.clear();
    for (const std::string& menu : menus) {
        ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {8.0F * theme::scale(), 8.0F * theme::scale()});
        ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {12.0F * theme::scale(), 8.0F * theme::scale()});
        if (begin_menu(menu, static_cast<float>(context.layout.bar_height), context)) {
            context.interface.of<BarMenus>().open = !close;
            if (!close) context.interface.of<BarMenus>().open_name = menu;
            if (close) ImGui::CloseCurrentPopup();
            draw_entries(context, menu);
            ImGui::EndMenu();
        }
        ImGui::PopStyleVar(2);
    }
}

// A P L R S I in one row, or +y -y -x +x +z -z if sides are unknown, and Fit.
void draw_views(InterfaceContext& context) {
    const float scale = theme::scale();
    const float side = 26.0F * scale;
    const float gap = 2.0F * scale;
    const float wide = 44.0F * scale;
    const float total = 6.0F * side + 7.0F * gap + wide + 8.0F * scale;
    const float at = static_cast<float>(context.layout.window.x) - total - 8.0F * scale;
    if (at < ImGui::GetCursorPosX() + 12.0F * scale) return; // a narrow window shows only the menus
    const Document& document = context.workspace.document();
    const bool enabled = document.has_scene();
    const bool sides = document.claims().has_sides();
    ImGui::SetCursorPosX(std::round(at));
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {gap, 0.0F});
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {0.0F, 0.0F});
    ImGui::PushStyleColor(ImGuiCol_Button, theme::kRaised);
    ImGui::BeginDisabled(!enabled);
    const auto button = [&](const Command& command, const std::string& text, float width) {
        ImGui::SetCursorPosY(std::round(0.5F * (static_cast<float>(context.layout.bar_height) - side)));
        if (ImGui::Button(text.c_str(), {width, side})) context.perform(command);
        widgets::tooltip(label_of(command, document).c_str(), command.keys.front().c_str());
    };
    for (const Command& command : command_table())
        if (command.name == "view" && !command.scripted())
            button(command,
                   sides ? command.keys.front()
                         : std::string(render::axis_name_of(*render::view_named(command.preset[0]))),
                   side);
    ImGui::SetCursorPosX(ImGui::GetCursorPosX() + 6.0F * scale);
    button(*find_command("fit"), "Fit", wide);
    ImGui::EndDisabled();
    ImGui::PopStyleColor();
    ImGui::PopStyleVar(2);
}

} // namespace

void draw_menu_bar(InterfaceContext& context) {
    // The main menu bar is as high as its frames: pad those to the bar of the layout.
    const float padding = 0.5F * (static_cast<float>(context.layout.bar_height) - ImGui::GetFontSize());
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {10.0F * theme::scale(), padding});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 0.0F);
    const bool shown = ImGui::BeginMainMenuBar();
    ImGui::PopStyleVar(2);
    if (!shown) return;
    draw_menus(context);
    context.interface.of<BarMenus>().focused = ImGui::IsWindowFocused();
    draw_views(context);
    ImGui::EndMainMenuBar();
}

} // namespace ramus::app
