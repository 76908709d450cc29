// The section of context: a row per item with visibility, colour, removal and opacity.
#include "app/assets/shapes.h"
#include "app/panels/choice_row.h"
#include "app/panels/plan_rows.h"
#include "app/panels/row_buttons.h"
#include "app/panels/sections.h"
#include "app/panels/theme.h"
#include "app/panels/widgets.h"
#include "core/io/meshes/mesh_file.h"

#include <array>
#include <imgui.h>
#include <string>

namespace ramus::app {

namespace {

void draw_net(ImDrawList& list, const ImVec2& at, float unit, ImU32 colour) {
    const auto point = [&](float x, float y) { return ImVec2(at.x + x * unit, at.y + y * unit); };
    const std::array<ImVec2, 5> corners{point(-6.5F, 4.5F), point(0.0F, 4.5F), point(6.5F, 4.5F), point(-3.5F, -4.5F),
                                        point(3.5F, -4.5F)};
    for (const auto& [a, b] : {std::pair(0, 2), {0, 3}, {3, 1}, {1, 4}, {4, 2}, {3, 4}})
        list.AddLine(corners[std::size_t(a)], corners[std::size_t(b)], colour, 1.2F * unit);
}

void draw_row(InterfaceContext& context, const ContextItem& item, std::size_t index) {
    const plan_rows::ObjectRow row = plan_rows::row_of(context, item, index);
    const std::string number = std::to_string(index + 1);
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {4.0F * theme::scale(), 2.0F * theme::scale()});
    plan_rows::object_row(context, row);
    if (item.visible && !row.words.trouble) {
        if (widgets::icon_button("style", item.wireframe, item.wireframe ? "As a surface" : "As a wireframe", draw_net))
            context.perform("context-style", {number, item.wireframe ? "surface" : "wireframe"});
        ImGui::SameLine();
        plan_rows::object_opacity(context, row);
    }
    ImGui::PopStyleVar();
    const Assets& assets = context.workspace.assets();
    const auto trouble = assets.trouble(source_of(item));
    if (item.visible && trouble && trouble->what == "cancelled" && ImGui::Button("Read again"))
        context.workspace.retry(WorkKind::kContext);
    const auto shape = item.visible && !trouble ? assets.context_shape(source_of(item)) : nullptr;
    if (shape && shape->claims.orientation != tree::SaidBy::kFile && io::names_mesh(item.file))
        if (const auto axes = widgets::mesh_axes_row(item.axes)) context.perform("context-axes", {number, *axes});
}

} // namespace

void draw_context(InterfaceContext& context) {
    const bool tree = context.workspace.document().tree() != nullptr;
    const widgets::TitleButton add{"Add\xE2\x80\xA6",
                                   tree ? "Show a mask or a mesh beside the tree: an organ, a bone"
                                        : "Show another mask or mesh: an organ, a bone",
                                   "context"};
    const widgets::TitleButton unit{"Unit\xE2\x80\xA6", "What one unit of the files' numbers is", "units"};
    const bool open = tree || !context.workspace.document().has_scene() ? draw_section(context, "Context", {add})
                                                                        : draw_section(context, "Context", {unit, add});
    if (!open) return;
    // A copy, since actions of rows change the list.
    const std::vector<ContextItem> items = context.workspace.document().marks().context;
    for (std::size_t i = 0; i < items.size(); ++i) {
        ImGui::PushID(static_cast<int>(i));
        draw_row(context, items[i], i);
        ImGui::PopID();
    }
}

} // namespace ramus::app
