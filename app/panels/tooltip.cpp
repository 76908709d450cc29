// What lies under the pointer: the branch, its size, and what depends on it.
#include "app/panels/interface.h"
#include "app/panels/theme.h"
#include "app/panels/widgets.h"
#include "app/session/labels.h"
#include "app/session/numbers.h"
#include "app/session/systems.h"

#include <imgui.h>

namespace ramus::app {

void draw_branch_tooltip(const InterfaceContext& context, int id) {
    const Document& document = context.workspace.document;
    if (id < 0 || id >= document.branch_count() || !context.workspace.facts()) return;
    const auto index = static_cast<std::size_t>(id);
    const BranchFacts& facts = context.workspace.facts()->branches[index];
    const tree::Branch& branch = document.tree()->branches[index];
    const float scale = theme::scale();
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {12.0F * scale, 9.0F * scale});
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {16.0F * scale, 3.0F * scale});
    ImGui::BeginTooltip();
    const std::string label = label_of(document.dependency(), document.marks(), id);
    const std::string number = "Branch " + std::to_string(id);
    ImGui::TextColored(theme::kAccent, "%s",
                       label.empty() ? number.c_str() : widgets::fitted(label, 220.0F * scale).c_str());
    if (!label.empty()) {
        ImGui::SameLine();
        widgets::quiet(number.c_str());
    }
    if (ImGui::BeginTable("facts", 2, ImGuiTableFlags_SizingFixedFit)) {
        const auto row = [](const char* name, const std::string& value, const std::string& more = {}) {
            ImGui::TableNextRow();
            ImGui::TableNextColumn();
            widgets::quiet(name);
            ImGui::TableNextColumn();
            ImGui::TextUnformatted(value.c_str());
            if (more.empty()) return;
            ImGui::SameLine(0.0F, 8.0F * theme::scale());
            widgets::quiet(more.c_str());
        };
        const std::string system = system_of(*document.tree(), document.marks(), id);
        if (!system.empty()) row("System", widgets::fitted(system, 180.0F * scale));
        const std::string least = digits(facts.diameter_mm.min);
        const std::string most = digits(facts.diameter_mm.max);
        const Lengths lengths = document.lengths();
        row("Diameter", lengths.text(facts.diameter_mm.mean),
            least == most ? std::string{} : least + " \xE2\x80\x93 " + most);
        row("Length", lengths.text(facts.length_mm));
        row("Generation", std::to_string(branch.generation));
        row("Strahler order", std::to_string(branch.strahler));
        if (nothing_depends(*context.workspace.facts())) {
            row("Depend on it", kNothingDepends);
        } else if (facts.dependents.branches == 0) {
            row("Depend on it", "no branches");
        } else {
            row("Depend on it", counted(static_cast<std::uint64_t>(facts.dependents.branches), "branch", "branches"));
            row("", lengths.text(facts.dependents.length_mm), lengths.volume(facts.dependents.volume_mm3));
        }
        ImGui::EndTable();
    }
    ImGui::EndTooltip();
    ImGui::PopStyleVar(2);
}

void draw_tooltip(InterfaceContext& context) {
    const Interface& interface = context.interface;
    if (interface.tooltip && !interface.menus_have_keys()) draw_branch_tooltip(context, interface.hovered);
}

} // namespace ramus::app
