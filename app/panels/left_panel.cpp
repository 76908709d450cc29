#include "app/panels/left_panel.h"

#include "app/panels/theme.h"

#include <algorithm>
#include <imgui.h>

namespace ramus::app {

namespace {

// The viewport that the panel covers: the isosurface's, since edits affect the tree's surface.
std::size_t viewport_below(const Layout& layout, const Comparison& comparison) {
    if (comparison.mode != Comparison::Mode::kSideBySide) return 0;
    const auto at = static_cast<std::size_t>(std::ranges::find(comparison.surfaces, Compared::kIsosurface) -
                                             comparison.surfaces.begin());
    return at < layout.viewports_at.size() && layout.viewports_at[at].y == 0 ? at : 0;
}

} // namespace

float begin_left_panel(const char* name, InterfaceContext& context) {
    const Layout& layout = context.layout;
    const float scale = theme::scale();
    const std::size_t viewport = viewport_below(layout, context.workspace.document().marks().comparison);
    const float heading = layout.viewports_at.size() > 1 ? 28.0F : 0.0F;
    const float top = (56.0F + heading) * scale, margin = 10.0F * scale;
    const float below = (viewport > 0 ? 128.0F : 68.0F) * scale;
    // Keeps the middle of the picture free, where places are shown with a ring, if there is room for both.
    const auto view_width = static_cast<float>(viewport > 0 ? layout.viewport_size.x : layout.view_size.x);
    const float free_width = viewport > 0 ? view_width : 0.5F * view_width - 40.0F * scale;
    const float width =
        std::min(std::clamp(free_width - 2.0F * margin, 260.0F * scale, 330.0F * scale), view_width - 2.0F * margin);
    const float most = std::max(140.0F * scale, static_cast<float>(layout.view_size.y) - top - below);
    ImGui::SetNextWindowPos({static_cast<float>(layout.view_at.x + layout.viewports_at[viewport].x) + margin,
                             static_cast<float>(layout.view_at.y) + top});
    ImGui::SetNextWindowSizeConstraints({width, 0.0F}, {width, most});
    ImGui::SetNextWindowBgAlpha(0.97F);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {12.0F * scale, 9.0F * scale});
    ImGui::Begin(name, nullptr,
                 ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                     ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoNavInputs |
                     ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoFocusOnAppearing);
    ImGui::PopStyleVar();
    context.interface.note_covered();
    return ImGui::GetWindowPos().y + most - 9.0F * scale;
}

} // namespace ramus::app
