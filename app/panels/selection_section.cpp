// The section of the selection: facts and actions, always at the same places.
#include "app/panels/parts.h"
#include "app/panels/theme.h"
#include "app/panels/widgets.h"
#include "app/session/labels.h"
#include "app/session/numbers.h"
#include "app/session/systems.h"

#include <algorithm>
#include <cmath>
#include <imgui.h>
#include <string>

namespace ramus::app {

namespace {

constexpr int kMostFacts = 10; // lines, of one branch

void draw_one(const Document& document, const TreeFacts& facts, int id) {
    const auto index = static_cast<std::size_t>(id);
    const BranchFacts& own = facts.branches[index];
    const tree::Branch& branch = document.tree()->branches[index];
    widgets::fact("Branch", std::to_string(id));
    const std::string label = label_of(document.dependency(), document.marks(), id);
    if (!label.empty()) widgets::fact("Name", label);
    const std::string system = system_of(*document.tree(), document.marks(), id);
    if (!system.empty()) widgets::fact("System", system);
    const Lengths lengths = document.lengths();
    widgets::fact("Diameter", lengths.text(own.diameter_mm.mean));
    widgets::fact("  from \xE2\x80\x93 to", lengths.range(own.diameter_mm.min, own.diameter_mm.max));
    widgets::fact("Length", lengths.text(own.length_mm));
    widgets::fact("Generation", std::to_string(branch.generation));
    widgets::fact("Strahler order", std::to_string(branch.strahler));
    widgets::fact("Dependents", nothing_depends(facts) ? kNothingDepends
                                                       : grouped(static_cast<std::uint64_t>(own.dependents.branches)));
    widgets::fact("State", std::string(name_of(state_of(document.marks(), id))));
}

void draw_many(const Document& document, const TreeFacts& facts) {
    double length = 0.0;
    double least = 1e300;
    double most = 0.0;
    for (const int id : document.marks().selection) {
        const BranchFacts& own = facts.branches[static_cast<std::size_t>(id)];
        length += own.length_mm;
        least = std::min(least, own.diameter_mm.mean);
        most = std::max(most, own.diameter_mm.mean);
    }
    const auto selected = document.marks().selection.size();
    widgets::fact("Branches",
                  grouped(selected) + " of " + grouped(static_cast<std::uint64_t>(document.branch_count())));
    const Lengths lengths = document.lengths();
    widgets::fact("Length", lengths.text(length));
    widgets::fact("Mean diameters", lengths.range(least, most));
}

void draw_actions(InterfaceContext& context) {
    const float gap = ImGui::GetStyle().ItemSpacing.x * 0.5F;
    const float width = std::floor((ImGui::GetContentRegionAvail().x - 2.0F * gap) / 3.0F);
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {gap, gap});
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {2.0F * theme::scale(), 4.0F * theme::scale()});
    int column = 0;
    for (const char* name : {"select-dependents", "select-upstream", "highlight", "defocus", "hide", "show"}) {
        const Command& command = *find_command(name);
        if (column++ % 3 != 0) ImGui::SameLine();
        const std::string label = command.name == "show" ? "Show" : command.label;
        if (ImGui::Button(label.c_str(), {width, 0.0F})) context.perform(command);
        widgets::tooltip(command.help.c_str(), command.keys.front().c_str());
    }
    ImGui::PopStyleVar(2);
}

void draw_facts_of_selection(const Document& document, const TreeFacts& facts) {
    const auto& selection = document.marks().selection;
    if (selection.empty())
        widgets::quiet_wrapped(
            "Click a vessel to select it; Alt+click or Ctrl+Shift+click takes all that depends on it.");
    else if (selection.size() == 1)
        draw_one(document, facts, selection.front());
    else
        draw_many(document, facts);
}

} // namespace

float draw_selection(InterfaceContext& context) {
    widgets::section("Selection");
    const Document& document = context.workspace.document();
    ImGui::BeginDisabled(document.marks().selection.empty());
    draw_actions(context);
    ImGui::EndDisabled();
    ImGui::Dummy({0.0F, 2.0F * theme::scale()});
    // Reserves space for the facts of one branch, so that the selection moves nothing; less if there is no space.
    const std::size_t selected = document.marks().selection.size();
    const int most = document.tree()->systems.size() > 1 ? kMostFacts : kMostFacts - 1;
    const float line = ImGui::GetTextLineHeightWithSpacing(), room = ImGui::GetContentRegionAvail().y;
    const float wanted = static_cast<float>(most) * line, needed = selected == 1 ? wanted : 3.0F * line;
    const float end = ImGui::GetCursorPosY() + wanted + ImGui::GetStyle().ItemSpacing.y;
    ImGui::BeginChild("selection", {0.0F, std::max(needed, std::min(wanted, room))}, false,
                      ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse);
    draw_facts_of_selection(document, *context.workspace.facts());
    ImGui::EndChild();
    return end;
}

} // namespace ramus::app
