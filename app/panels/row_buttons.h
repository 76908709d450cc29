// Small controls at the ends of rows in the side panel: icon buttons, an eye, a colour swatch.
#pragma once

#include "app/panels/theme.h"
#include "app/panels/widgets.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <imgui.h>

namespace ramus::app::widgets {

// A square button without frame; `draw(list, centre, unit, colour)` draws its icon. Dimmed if not `on`.
template <class Draw> bool icon_button(const char* id, bool on, const char* help, const Draw& draw) {
    const float side = ImGui::GetFrameHeight();
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const bool pressed = ImGui::InvisibleButton(id, {side, side});
    ImVec4 colour = on ? theme::kText : theme::kQuiet;
    if (!on) colour.w = 0.55F;
    ImDrawList& list = *ImGui::GetWindowDrawList();
    if (ImGui::IsItemHovered()) {
        colour = theme::kText;
        list.AddRectFilled(at, {at.x + side, at.y + side}, ImGui::GetColorU32(theme::kRaised), 3.0F * theme::scale());
    }
    draw(list, ImVec2(std::floor(at.x + 0.5F * side) + 0.5F, std::floor(at.y + 0.5F * side) + 0.5F), theme::scale(),
         ImGui::GetColorU32(colour));
    widgets::tooltip(help);
    return pressed;
}

bool eye_button(bool open, const char* help);

// A swatch that opens a colour picker (the popup "colour" of the row). True: `colour` changed. The row must commit the
// final colour as one step of undo after the popup has closed.
[[nodiscard]] bool colour_swatch(std::array<std::uint8_t, 3>& colour);

} // namespace ramus::app::widgets
