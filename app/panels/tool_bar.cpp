// The tool bar at the upper left of the picture: a button per tool, and the settings of the current tool.
#include "app/panels/parts.h"
#include "app/panels/theme.h"
#include "app/panels/widgets.h"

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
    if (widgets::button(("##" + kind.name).c_str(), {side, side}, chosen ? theme::kAccentDim : theme::kNothing))
        context.perform("tool", {kind.name});
    draw_icon(kind, at, side, ImGui::GetColorU32(chosen || ImGui::IsItemHovered() ? theme::kText : theme::kQuiet));
    widgets::note_item(kind.label.c_str());
    widgets::tooltip((kind.label + ". " + kind.help).c_str(), kind.keys.empty() ? nullptr : kind.keys.front().c_str());
}

// Toggles the projection; its icon shows parallel or converging lines.
void draw_projection_button(InterfaceContext& context, float side) {
    const bool parallel = context.workspace.document().session().camera.orthographic;
    const ImVec2 at = ImGui::GetCursorScreenPos();
    if (widgets::button("##projection", {side, side}, theme::kNothing)) context.perform("orthographic", {});
    const ImU32 colour = ImGui::GetColorU32(ImGui::IsItemHovered() ? theme::kText : theme::kQuiet);
    ImDrawList* list = ImGui::GetWindowDrawList();
    for (const float x : {0.26F, 0.5F, 0.74F}) {
        const float far = parallel ? x : 0.5F + 0.3F * (x - 0.5F);
        list->AddLine({at.x + far * side, at.y + 0.24F * side}, {at.x + x * side, at.y + 0.76F * side}, colour,
                      1.5F * theme::scale());
    }
    widgets::tooltip(parallel ? "Perspective: what is nearer looks larger"
                              : "Parallel projection: one scale for all of the picture",
                     "O");
}

// Entries of the command table as adjacent texts; the active one is marked.
void draw_switch(InterfaceContext& context, std::string_view name, std::initializer_list<const char*> texts,
                 float height) {
    const char* const* text = texts.begin();
    ImGui::PushFont(theme::small_font());
    for (const Command& command : command_table()) {
        if (command.name != name || command.scripted()) continue;
        const bool chosen = command.in_use(context.actions, command);
        if (widgets::button(*text, {ImGui::CalcTextSize(*text).x + 16.0F * theme::scale(), height},
                            chosen ? theme::kAccentDim : theme::kNothing, chosen ? theme::kText : theme::kQuiet))
            context.perform(command);
        ImGui::PopFont();
        widgets::tooltip(command.help.c_str());
        ImGui::PushFont(theme::small_font());
        ImGui::SameLine();
        ++text;
    }
    ImGui::PopFont();
}

void draw_divider(float height) {
    const float scale = theme::scale();
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float x = std::round(at.x + 4.0F * scale);
    ImGui::GetWindowDrawList()->AddLine({x, at.y + 6.0F * scale}, {x, at.y + height - 6.0F * scale},
                                        ImGui::GetColorU32(theme::kQuiet), 1.0F);
    ImGui::Dummy({8.0F * scale, height});
    ImGui::SameLine();
}

} // namespace

void draw_tool_bar(InterfaceContext& context) {
    if (context.workspace.document().branch_count() == 0) return;
    const float scale = theme::scale();
    const float side = kSide * scale, gap = kGap * scale, padding = 3.0F * scale;
    const float x = static_cast<float>(context.layout.view_at.x) + kMargin * scale;
    const float y = static_cast<float>(context.layout.view_at.y) + kMargin * scale;
    ImVec4 ground = theme::kBar;
    ground.w = 0.82F;
    ImGui::PushStyleColor(ImGuiCol_WindowBg, ground);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {padding, padding});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, {1.0F, 1.0F});
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {gap, 0.0F});
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {0.0F, 0.0F});
    widgets::begin_fixed("tools", std::round(x), std::round(y), 0.0F, 0.0F,
                         ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse |
                             ImGuiWindowFlags_AlwaysAutoResize);
    for (const ToolKind& kind : tool_kinds()) {
        draw_button(context, kind, side);
        ImGui::SameLine();
    }
    draw_divider(side);
    draw_projection_button(context, side);
    ImGui::SameLine();
    if (context.interface.tool_kind->name.starts_with("lasso")) {
        draw_divider(side);
        draw_switch(context, "lasso-mode", {"Half", "Any part"}, side);
        draw_divider(side);
        draw_switch(context, "lasso-depth", {"Through", "Visible"}, side);
    }
    ImGui::NewLine();
    ImGui::End();
    ImGui::PopStyleVar(4);
    ImGui::PopStyleColor();
}

} // namespace ramus::app
