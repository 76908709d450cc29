// What is shown beside the tree: a row each to show or hide it, to colour it and to take it away, and how dense it is.
#include "app/assets/shapes.h"
#include "app/panels/interface.h"
#include "app/panels/theme.h"
#include "app/panels/widgets.h"
#include "app/session/colour_by.h"
#include "app/session/numbers.h"

#include <array>
#include <cmath>
#include <filesystem>
#include <imgui.h>
#include <string>

namespace ramus::app {

namespace {

// A square button without a frame, on which `draw(list, centre, unit, colour)` draws; half as bright when it is off.
template <class Draw> bool icon_button(const char* id, bool on, const char* help, const Draw& draw) {
    const float side = ImGui::GetFrameHeight();
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const bool pressed = ImGui::InvisibleButton(id, {side, side});
    ImVec4 colour = on ? theme::kText : theme::kQuiet;
    if (!on) colour.w = 0.55F;
    ImDrawList& list = *ImGui::GetWindowDrawList();
    if (ImGui::IsItemHovered()) {
        colour = on ? ImVec4(1, 1, 1, 1) : theme::kText;
        list.AddRectFilled(at, {at.x + side, at.y + side}, IM_COL32(255, 255, 255, 16), 3.0F * theme::scale());
    }
    draw(list, ImVec2(std::floor(at.x + 0.5F * side) + 0.5F, std::floor(at.y + 0.5F * side) + 0.5F), theme::scale(),
         ImGui::GetColorU32(colour));
    widgets::tooltip(help);
    return pressed;
}

void draw_eye(ImDrawList& list, const ImVec2& at, float unit, ImU32 colour, bool open) {
    const float half = 7.0F * unit, lid = 5.5F * unit;
    const ImVec2 left(at.x - half, at.y), right(at.x + half, at.y);
    list.AddBezierQuadratic(left, {at.x, at.y - 2.0F * lid}, right, colour, 1.3F * unit, 16);
    list.AddBezierQuadratic(left, {at.x, at.y + 2.0F * lid}, right, colour, 1.3F * unit, 16);
    list.AddCircleFilled(at, 2.3F * unit, colour, 12);
    if (!open)
        list.AddLine({at.x - 5.5F * unit, at.y + 5.5F * unit}, {at.x + 5.5F * unit, at.y - 5.5F * unit}, colour,
                     1.3F * unit);
}

void draw_net(ImDrawList& list, const ImVec2& at, float unit, ImU32 colour) {
    const auto point = [&](float x, float y) { return ImVec2(at.x + x * unit, at.y + y * unit); };
    const std::array<ImVec2, 5> corners{point(-6.5F, 4.5F), point(0.0F, 4.5F), point(6.5F, 4.5F), point(-3.5F, -4.5F),
                                        point(3.5F, -4.5F)};
    for (const auto& [a, b] : {std::pair(0, 2), {0, 3}, {3, 1}, {1, 4}, {4, 2}, {3, 4}})
        list.AddLine(corners[std::size_t(a)], corners[std::size_t(b)], colour, 1.2F * unit);
}

using Trial = Editing::Context;

std::array<std::uint8_t, 3> bytes_of(const std::array<float, 3>& colour) {
    std::array<std::uint8_t, 3> bytes{};
    for (std::size_t k = 0; k < 3; ++k)
        bytes[k] = static_cast<std::uint8_t>(std::lround(255.0F * std::min(std::max(colour[k], 0.0F), 1.0F)));
    return bytes;
}

// The swatch opens a picker; what it ends with is one step of undo.
void draw_swatch(InterfaceContext& context, const ContextItem& item, int number, Trial& trial) {
    const float side = std::round(0.62F * ImGui::GetFrameHeight());
    const float down = 0.5F * (ImGui::GetFrameHeight() - side);
    const auto& shown = trial.of == number ? trial.item.colour : item.colour;
    const auto part = [&](std::size_t k) { return static_cast<float>(shown[k]) / 255.0F; };
    const ImVec4 colour{part(0), part(1), part(2), 1.0F};
    ImGui::SetCursorPosY(ImGui::GetCursorPosY() + down);
    if (ImGui::ColorButton("##swatch", colour, ImGuiColorEditFlags_NoTooltip | ImGuiColorEditFlags_NoBorder,
                           {side, side}))
        ImGui::OpenPopup("colour");
    widgets::tooltip("Colour");
    ImGui::SameLine();
    ImGui::SetCursorPosY(ImGui::GetCursorPosY() - down);
    if (!ImGui::BeginPopup("colour")) {
        if (trial.of == number && trial.item.colour != item.colour) { // the picker was closed
            const auto chosen = trial.item.colour;
            trial.of = -1;
            context.perform("context-colour", {std::to_string(number), colour_text(chosen)});
        }
        return;
    }
    std::array<float, 3> value{colour.x, colour.y, colour.z};
    ImGui::SetNextItemWidth(190.0F * theme::scale());
    constexpr ImGuiColorEditFlags kFlags = ImGuiColorEditFlags_NoAlpha | ImGuiColorEditFlags_NoSidePreview |
                                           ImGuiColorEditFlags_NoSmallPreview | ImGuiColorEditFlags_DisplayHex |
                                           ImGuiColorEditFlags_PickerHueBar | ImGuiColorEditFlags_NoLabel;
    if (ImGui::ColorPicker3("##picker", value.data(), kFlags)) {
        trial = {number, item, -1, 0.0F};
        trial.item.colour = bytes_of(value);
    }
    ImGui::EndPopup();
}

void draw_opacity(InterfaceContext& context, const ContextItem& item, int number, Trial& trial) {
    float shown = trial.opacity_of == number ? trial.opacity : static_cast<float>(item.opacity);
    ImGui::SetCursorPosX(ImGui::GetCursorPosX() + ImGui::GetFrameHeight() + 2.0F * theme::scale());
    ImGui::SetNextItemWidth(-44.0F * theme::scale());
    ImGui::SliderFloat("##opacity", &shown, 0.0F, 1.0F, "", ImGuiSliderFlags_AlwaysClamp);
    widgets::tooltip("Opacity");
    const bool done = ImGui::IsItemDeactivatedAfterEdit();
    if (ImGui::IsItemActive()) {
        trial = {number, item, number, shown};
        trial.item.opacity = static_cast<double>(shown);
    } else if (trial.opacity_of == number) {
        trial.opacity_of = -1;
        if (trial.of == number) trial.of = -1;
    }
    ImGui::SameLine();
    const std::string percent = std::to_string(std::lround(100.0F * shown)) + " %";
    widgets::align_right(ImGui::CalcTextSize(percent.c_str()).x);
    ImGui::TextUnformatted(percent.c_str());
    if (done) context.perform("context-opacity", {std::to_string(number), digits(static_cast<double>(shown), 3)});
}

void draw_row(InterfaceContext& context, const ContextItem& item, int number, Trial& trial) {
    const std::string n = std::to_string(number);
    const ContextSource source = source_of(item);
    const Assets& assets = context.workspace.assets;
    const auto trouble = item.visible ? assets.trouble(source) : std::nullopt;
    const bool gave_up = context.workspace.context.gave_up(source);
    const bool waits = item.visible && !trouble && !gave_up && !assets.context_shape(source);
    const float side = ImGui::GetFrameHeight();
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {4.0F * theme::scale(), 2.0F * theme::scale()});
    if (icon_button("eye", item.visible, item.visible ? "Hide" : "Show",
                    [&](ImDrawList& list, const ImVec2& at, float unit, ImU32 colour) {
                        draw_eye(list, at, unit, colour, item.visible);
                    }))
        context.perform(item.visible ? "context-hide" : "context-show", {n});
    ImGui::SameLine();
    draw_swatch(context, item, number, trial);
    std::string name = std::filesystem::path(item.file).filename().string();
    if (item.label != 0) name += "  label " + std::to_string(item.label);
    const float available = ImGui::GetContentRegionAvail().x - 2.0F * side - 8.0F * theme::scale();
    ImGui::AlignTextToFramePadding();
    ImGui::PushStyleColor(ImGuiCol_Text, trouble || gave_up       ? theme::kTrouble
                                         : waits || !item.visible ? theme::kQuiet
                                                                  : theme::kText);
    ImGui::TextUnformatted(widgets::fitted(name, available).c_str());
    ImGui::PopStyleColor();
    const std::string about = trouble   ? trouble->message()
                              : gave_up ? item.file + "\nNot read: cancelled"
                              : waits   ? item.file + "\nBeing read"
                                        : item.file;
    widgets::tooltip(about.c_str());
    ImGui::SameLine();
    widgets::align_right(2.0F * side + 4.0F * theme::scale());
    if (icon_button("style", item.wireframe, item.wireframe ? "As a surface" : "As a wireframe", draw_net))
        context.perform("context-style", {n, item.wireframe ? "surface" : "wireframe"});
    ImGui::SameLine();
    if (icon_button("remove", false, "Remove", [](ImDrawList& list, const ImVec2& at, float unit, ImU32 colour) {
            const float r = 3.6F * unit;
            list.AddLine({at.x - r, at.y - r}, {at.x + r, at.y + r}, colour, 1.4F * unit);
            list.AddLine({at.x - r, at.y + r}, {at.x + r, at.y - r}, colour, 1.4F * unit);
        }))
        context.perform("context-remove", {n});
    ImGui::PopStyleVar();
    if (gave_up) {
        if (ImGui::Button("Read again")) context.workspace.context.retry();
    } else if (item.visible && !trouble) {
        draw_opacity(context, item, number, trial);
    }
}

} // namespace

void draw_context(InterfaceContext& context) {
    Trial& trial = context.interface.editing.context;
    draw_title(context, "Context",
               {{"Add\xE2\x80\xA6", "Show a mask (NIfTI) or a mesh (STL, PLY, OBJ) beside the tree: an organ, a bone",
                 "context"}});
    // A copy: what a row does changes the list.
    const std::vector<ContextItem> items = context.workspace.document.marks().context;
    if (trial.of > static_cast<int>(items.size())) trial.of = -1;
    for (std::size_t i = 0; i < items.size(); ++i) {
        ImGui::PushID(static_cast<int>(i));
        draw_row(context, items[i], static_cast<int>(i + 1), trial);
        ImGui::PopID();
    }
    context.interface.tried_context.reset();
    if (trial.of < 1 || context.workspace.document.marks().context != items) return;
    context.interface.tried_context = items;
    (*context.interface.tried_context)[static_cast<std::size_t>(trial.of - 1)] = trial.item;
}

} // namespace ramus::app
