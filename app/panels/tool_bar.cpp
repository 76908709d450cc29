// A small row of buttons at the upper left of the picture, one for each tool, and beside it how the tool in use works.
#include "app/panels/interface.h"
#include "app/panels/widgets.h"
#include "app/window/theme.h"

#include <cmath>
#include <imgui.h>

namespace ramus::app {

namespace {

constexpr float kSide = 28.0F; // points
constexpr float kGap = 2.0F;
constexpr float kMargin = 10.0F;

void draw_icon(const ToolKind& kind, ImVec2 at, float side, ImU32 colour) {
    ImDrawList* list = ImGui::GetWindowDrawList();
    const float inset = 0.2F * side, size = side - 2.0F * inset;
    for (const auto& stroke : kind.icon) {
        std::vector<ImVec2> points;
        for (const glm::vec2& point : stroke)
            points.emplace_back(at.x + inset + size * point.x, at.y + inset + size * point.y);
        list->AddPolyline(points.data(), static_cast<int>(points.size()), colour, ImDrawFlags_None,
                          1.5F * theme::scale());
    }
}

void draw_button(InterfaceContext& context, const ToolKind& kind, float side) {
    const bool chosen = context.interface.tool_kind == &kind;
    const ImVec2 at = ImGui::GetCursorScreenPos();
    ImGui::PushStyleColor(ImGuiCol_Button, chosen ? theme::kAccentDim : ImVec4(0.0F, 0.0F, 0.0F, 0.0F));
    if (ImGui::Button(("##" + kind.name).c_str(), {side, side})) context.perform("tool", {kind.name});
    ImGui::PopStyleColor();
    draw_icon(kind, at, side, ImGui::GetColorU32(chosen || ImGui::IsItemHovered() ? theme::kText : theme::kQuiet));
    widgets::tooltip(kind.label.c_str(), kind.keys.empty() ? nullptr : kind.keys.front().c_str());
}

} // namespace

void draw_tool_bar(InterfaceContext& context) {
    if (context.workspace.document.branch_count() == 0) return;
    const float scale = theme::scale();
    const float side = kSide * scale, gap = kGap * scale, padding = 3.0F * scale;
    const auto count = static_cast<float>(tool_kinds().size());
    const float width = count * side + (count - 1.0F) * gap + 2.0F * padding;
    const float x = static_cast<float>(context.layout.view_at.x) + kMargin * scale;
    const float y = static_cast<float>(context.layout.view_at.y) + kMargin * scale;
    ImVec4 ground = theme::kBar;
    ground.w = 0.82F;
    ImGui::PushStyleColor(ImGuiCol_WindowBg, ground);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {padding, padding});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, {1.0F, 1.0F});
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {gap, 0.0F});
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {0.0F, 0.0F});
    widgets::begin_fixed("tools", std::round(x), std::round(y), width, side + 2.0F * padding,
                         ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse);
    for (const ToolKind& kind : tool_kinds()) {
        draw_button(context, kind, side);
        ImGui::SameLine();
    }
    ImGui::End();
    ImGui::PopStyleVar(4);
    ImGui::PopStyleColor();
}

} // namespace ramus::app
