// What rows of the side panel have at their ends: buttons with a small drawing, an eye, a swatch with its colour.
#pragma once

#include "app/panels/theme.h"
#include "app/panels/widgets.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <imgui.h>

namespace ramus::app::widgets {

// A square button without a frame, on which `draw(list, centre, unit, colour)` draws; half as bright when it is off.
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

// A swatch that opens a picker, the popup "colour" of the row; true: `colour` was changed in it. What the picker ends
// with, once the popup has closed, is for the row to take over as one step of undo.
[[nodiscard]] bool colour_swatch(std::array<std::uint8_t, 3>& colour);

} // namespace ramus::app::widgets
