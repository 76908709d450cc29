#include "app/panels/row_buttons.h"

#include <algorithm>

namespace ramus::app::widgets {

static void draw_eye(ImDrawList& list, const ImVec2& at, float unit, ImU32 colour, bool open) {
    const float half = 7.0F * unit, lid = 5.5F * unit;
    const ImVec2 left(at.x - half, at.y), right(at.x + half, at.y);
    list.AddBezierQuadratic(left, {at.x, at.y - 2.0F * lid}, right, colour, 1.3F * unit, 16);
    list.AddBezierQuadratic(left, {at.x, at.y + 2.0F * lid}, right, colour, 1.3F * unit, 16);
    list.AddCircleFilled(at, 2.3F * unit, colour, 12);
    if (!open)
        list.AddLine({at.x - 5.5F * unit, at.y + 5.5F * unit}, {at.x + 5.5F * unit, at.y - 5.5F * unit}, colour,
                     1.3F * unit);
}

bool eye_button(bool open, const char* help) {
    return icon_button("eye", open, help, [open](ImDrawList& list, const ImVec2& at, float unit, ImU32 colour) {
        draw_eye(list, at, unit, colour, open);
    });
}

bool colour_swatch(std::array<std::uint8_t, 3>& colour) {
    const float side = std::round(0.62F * ImGui::GetFrameHeight());
    const float down = 0.5F * (ImGui::GetFrameHeight() - side);
    const auto part = [&](std::size_t k) { return static_cast<float>(colour[k]) / 255.0F; };
    const ImVec4 shown{part(0), part(1), part(2), 1.0F};
    ImGui::SetCursorPosY(ImGui::GetCursorPosY() + down);
    if (ImGui::ColorButton("##swatch", shown, ImGuiColorEditFlags_NoTooltip | ImGuiColorEditFlags_NoBorder,
                           {side, side}))
        ImGui::OpenPopup("colour");
    widgets::tooltip("Colour");
    ImGui::SameLine();
    ImGui::SetCursorPosY(ImGui::GetCursorPosY() - down);
    if (!ImGui::BeginPopup("colour")) return false;
    std::array<float, 3> value{shown.x, shown.y, shown.z};
    ImGui::SetNextItemWidth(190.0F * theme::scale());
    constexpr ImGuiColorEditFlags kFlags = ImGuiColorEditFlags_NoAlpha | ImGuiColorEditFlags_NoSidePreview |
                                           ImGuiColorEditFlags_NoSmallPreview | ImGuiColorEditFlags_DisplayHex |
                                           ImGuiColorEditFlags_PickerHueBar | ImGuiColorEditFlags_NoLabel;
    const bool changed = ImGui::ColorPicker3("##picker", value.data(), kFlags);
    if (changed)
        for (std::size_t k = 0; k < 3; ++k)
            colour[k] = static_cast<std::uint8_t>(std::lround(255.0F * std::clamp(value[k], 0.0F, 1.0F)));
    ImGui::EndPopup();
    return changed;
}

} // namespace ramus::app::widgets
