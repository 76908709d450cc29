// What lies under the pointer in the picture: the branch, its size, and what depends on it.
#include "app/numbers.h"
#include "app/panels/interface.h"
#include "app/panels/widgets.h"
#include "app/window/theme.h"

#include <imgui.h>

namespace ramus::app {

void draw_tooltip(InterfaceContext& context) {
    const Interface& interface = context.interface;
    const Document& document = context.workspace.document;
    const int id = interface.hovered;
    if (!interface.tooltip || id < 0 || id >= document.branch_count() || !context.workspace.facts()) return;
    const auto index = static_cast<std::size_t>(id);
    const BranchFacts& facts = context.workspace.facts()->branches[index];
    const float scale = theme::scale();
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {12.0F * scale, 9.0F * scale});
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {16.0F * scale, 3.0F * scale});
    ImGui::BeginTooltip();
    const auto name = document.marks().names.find(id);
    ImGui::PushStyleColor(ImGuiCol_Text, theme::kAccent);
    ImGui::TextUnformatted(name == document.marks().names.end() ? ("Branch " + std::to_string(id)).c_str()
                                                                : name->second.c_str());
    ImGui::PopStyleColor();
    if (ImGui::BeginTable("facts", 2, ImGuiTableFlags_SizingFixedFit)) {
        const auto row = [](const char* label, const std::string& value) {
            ImGui::TableNextRow();
            ImGui::TableNextColumn();
            widgets::quiet(label);
            ImGui::TableNextColumn();
            ImGui::TextUnformatted(value.c_str());
        };
        row("Diameter", digits(facts.mean_diameter_mm) + " mm");
        row("Length", digits(facts.length_mm) + " mm");
        row("Generation", std::to_string(document.tree()->branches[index].generation));
        row("Dependents", facts.dependents == 0 ? "none" : grouped(static_cast<std::uint64_t>(facts.dependents)));
        ImGui::EndTable();
    }
    ImGui::EndTooltip();
    ImGui::PopStyleVar(2);
}

} // namespace ramus::app
