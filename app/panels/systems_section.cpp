// The systems of the tree: a row each to show or hide it, to colour, select and name it.
#include "app/panels/editing.h"
#include "app/panels/rename_dialog.h"
#include "app/panels/row_buttons.h"
#include "app/panels/sections.h"
#include "app/panels/theme.h"
#include "app/panels/widgets.h"
#include "app/session/colour_by.h"
#include "app/session/numbers.h"
#include "app/session/systems.h"

#include <imgui.h>
#include <string>

namespace ramus::app {

namespace {

void draw_swatch(InterfaceContext& context, const glm::vec3& now, int system) {
    Editing::System& trial = context.interface.of<Editing>().system;
    auto colour = trial.of == system ? trial.colour : bytes_of(now);
    if (widgets::colour_swatch(colour)) {
        trial = {system, colour};
    } else if (trial.of == system && !ImGui::IsPopupOpen("colour")) {
        trial.of = -1;
        if (colour != bytes_of(now))
            context.perform("colour-system", {std::to_string(system + 1), colour_text(colour)});
    }
}

// The last column; the one before it ends where this one begins.
float length_width() { return 76.0F * theme::scale(); }

void right_cells(const std::string& branches, const std::string& length, const char* branches_help,
                 const char* length_help) {
    widgets::align_right(length_width() + ImGui::CalcTextSize(branches.c_str()).x);
    widgets::quiet(branches.c_str());
    if (*branches_help != '\0') widgets::tooltip(branches_help);
    ImGui::SameLine();
    widgets::quiet_right(length);
    if (*length_help != '\0') widgets::tooltip(length_help);
}

void draw_headings() {
    ImGui::PushFont(theme::small_font());
    widgets::quiet("System");
    widgets::tooltip("Shown or hidden, its colour, and its name");
    ImGui::SameLine();
    right_cells("Branches", "Length", "How many branches it has", "The length of all its vessels");
    ImGui::PopFont();
}

void draw_row(InterfaceContext& context, const Systems& systems, const SystemFacts& facts, int system) {
    const std::string number = std::to_string(system + 1);
    const std::string name = system_name(systems, system);
    const bool visible = facts.visible > 0;
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {4.0F * theme::scale(), 2.0F * theme::scale()});
    if (widgets::eye_button(visible, ((visible ? "Hide " : "Show ") + name).c_str()))
        context.perform(visible ? "hide-system" : "show-system", {number});
    ImGui::SameLine();
    draw_swatch(context, shown_colour(systems, system), system);
    const std::string branches = grouped(static_cast<std::uint64_t>(facts.branches));
    const std::string length = context.workspace.document().lengths().text(facts.length_mm);
    const float width = ImGui::GetContentRegionAvail().x;
    const float room = width - length_width() - ImGui::CalcTextSize(branches.c_str()).x - 10.0F * theme::scale();
    ImGui::PushStyleColor(ImGuiCol_Text, visible ? theme::kText : theme::kQuiet);
    ImGui::AlignTextToFramePadding();
    const ImVec2 from = ImGui::GetCursorPos();
    const bool pressed = ImGui::Selectable("##select", false, ImGuiSelectableFlags_AllowDoubleClick, {width, 0.0F});
    widgets::tooltip((name + ": click selects its " +
                      counted(static_cast<std::uint64_t>(facts.branches), "branch", "branches") +
                      ", a double click names it")
                         .c_str());
    ImGui::SetCursorPos(from);
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted(widgets::fitted(name, room).c_str());
    ImGui::PopStyleColor();
    ImGui::SameLine();
    right_cells(branches, length, "", "");
    ImGui::PopStyleVar();
    if (!pressed) return;
    if (ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left))
        context.interface.of<Rename>().show_system(system, systems[static_cast<std::size_t>(system)].name);
    else
        context.perform("select-system", {number});
}

} // namespace

void draw_systems(InterfaceContext& context) {
    const Document& document = context.workspace.document();
    if (document.tree()->systems.empty()) return;
    draw_title(context, "Systems", {{"Colour", "Colour every branch as its system", "colour-by", {"system"}}});
    draw_headings();
    // Copies, since actions of rows change the session.
    const Systems systems = systems_of(*document.tree(), document.marks());
    const std::vector<SystemFacts> facts = system_facts(*document.tree(), *context.workspace.facts(), document.marks());
    if (context.interface.of<Editing>().system.of >= static_cast<int>(systems.size()))
        context.interface.of<Editing>().system = {};
    for (int system = 0; system < static_cast<int>(systems.size()); ++system) {
        ImGui::PushID(system);
        draw_row(context, systems, facts[static_cast<std::size_t>(system)], system);
        ImGui::PopID();
    }
}

} // namespace ramus::app
