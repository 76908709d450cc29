// Counts of selected, defocused and hidden branches in the status bar, where they are always visible. A click on one
// resets that state.
#include "app/panels/parts.h"
#include "app/panels/theme.h"
#include "app/panels/widgets.h"
#include "app/session/numbers.h"

#include <array>
#include <imgui.h>

namespace ramus::app {

float draw_state_marks(InterfaceContext& context, float right_edge) {
    using tree::BranchState;
    const Marks& marks = context.workspace.document().marks();
    struct Mark {
        std::size_t count;
        const char *word, *help, *key, *command;
        ImVec4 colour;
    };
    const std::array<Mark, 3> all{
        {{branches_in_state(marks, BranchState::kHidden).size(), "hidden", "Shows the hidden branches again", nullptr,
          "show-hidden", theme::kText},
         {branches_in_state(marks, BranchState::kDefocused).size(), "defocused",
          "Brings the defocused branches back into focus", nullptr, "focus-all", theme::kText},
         {marks.selection.size(), "selected", "Selects nothing", "Escape", "select-none", theme::kAccent}}};
    const float scale = theme::scale();
    const char* command = nullptr;
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {8.0F * scale, 0.0F});
    for (const Mark& mark : all) {
        if (mark.count == 0) continue;
        const std::string text = grouped(mark.count) + " " + mark.word + "  \xC3\x97";
        const float width = ImGui::CalcTextSize(text.c_str()).x + 16.0F * scale;
        right_edge -= width + 8.0F * scale;
        ImGui::SetCursorPosX(right_edge);
        ImGui::PushID(mark.word);
        ImGui::PushStyleColor(ImGuiCol_Text, mark.colour);
        if (ImGui::Button(text.c_str(), {width, 0.0F})) command = mark.command;
        ImGui::PopStyleColor();
        ImGui::PopID();
        widgets::tooltip(mark.help, mark.key);
        ImGui::SameLine();
    }
    ImGui::PopStyleVar();
    if (command != nullptr) context.perform(command, {});
    return right_edge;
}

} // namespace ramus::app
