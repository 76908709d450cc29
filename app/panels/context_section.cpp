// The section of context: a row per item with visibility, colour, removal and opacity.
#include "app/assets/shapes.h"
#include "app/panels/choice_row.h"
#include "app/panels/editing.h"
#include "app/panels/row_buttons.h"
#include "app/panels/sections.h"
#include "app/panels/theme.h"
#include "app/panels/widgets.h"
#include "app/session/colour_by.h"
#include "app/session/numbers.h"
#include "core/io/meshes/mesh_file.h"

#include <array>
#include <cmath>
#include <filesystem>
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

using Trial = Editing::Context;

// The file's name of the label, if known.
std::string label_text(const volume::LabelChoice& label, const ContextShape* shape) {
    if (label.none()) return {};
    if (shape != nullptr && shape->label && !shape->label->name.empty()) return "  " + shape->label->name;
    return label.name.empty() ? "  label " + std::to_string(label.number) : "  " + label.name;
}

void draw_swatch(InterfaceContext& context, const ContextItem& item, int number, Trial& trial) {
    auto colour = trial.of == number ? trial.item.colour : item.colour;
    if (widgets::colour_swatch(colour)) {
        trial = {number, item, -1, 0.0F};
        trial.item.colour = colour;
    } else if (trial.of == number && !ImGui::IsPopupOpen("colour") && trial.item.colour != item.colour) {
        trial.of = -1;
        context.perform("context-colour", {std::to_string(number), colour_text(colour)});
    }
}

void draw_opacity(InterfaceContext& context, const ContextItem& item, int number, Trial& trial) {
    float shown = trial.opacity_of == number ? trial.opacity : static_cast<float>(item.opacity);
    ImGui::SetCursorPosX(ImGui::GetCursorPosX() + ImGui::GetFrameHeight() + 2.0F * theme::scale());
    ImGui::SetNextItemWidth(-44.0F * theme::scale());
    ImGui::SliderFloat("##opacity", &shown, 0.0F, 1.0F, "Opacity", ImGuiSliderFlags_AlwaysClamp);
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
    widgets::text_right(widgets::percent_text(shown));
    if (done) context.perform("context-opacity", {std::to_string(number), digits(static_cast<double>(shown), 3)});
}

void draw_row(InterfaceContext& context, const ContextItem& item, int number, Trial& trial) {
    const std::string n = std::to_string(number);
    const ContextSource source = source_of(item);
    const Assets& assets = context.workspace.assets();
    const auto trouble = item.visible ? assets.trouble(source) : std::nullopt;
    const bool gave_up = trouble && trouble->what == "cancelled";
    const bool waits = item.visible && !trouble && !assets.context_shape(source);
    const float side = ImGui::GetFrameHeight();
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {4.0F * theme::scale(), 2.0F * theme::scale()});
    if (widgets::eye_button(item.visible, item.visible ? "Hide" : "Show"))
        context.perform(item.visible ? "context-hide" : "context-show", {n});
    ImGui::SameLine();
    draw_swatch(context, item, number, trial);
    std::string name = std::filesystem::path(item.file).filename().string();
    name += label_text(item.label, assets.context_shape(source).get());
    if (item.isovalue) name += "  from " + rounded(*item.isovalue);
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
    if (widgets::icon_button("style", item.wireframe, item.wireframe ? "As a surface" : "As a wireframe", draw_net))
        context.perform("context-style", {n, item.wireframe ? "surface" : "wireframe"});
    ImGui::SameLine();
    if (widgets::icon_button("remove", false, "Remove",
                             [](ImDrawList& list, const ImVec2& at, float unit, ImU32 colour) {
                                 const float r = 3.6F * unit;
                                 list.AddLine({at.x - r, at.y - r}, {at.x + r, at.y + r}, colour, 1.4F * unit);
                                 list.AddLine({at.x - r, at.y + r}, {at.x + r, at.y - r}, colour, 1.4F * unit);
                             }))
        context.perform("context-remove", {n});
    ImGui::PopStyleVar();
    if (gave_up) {
        if (ImGui::Button("Read again")) context.workspace.retry(WorkKind::kContext);
    } else if (item.visible && !trouble) {
        draw_opacity(context, item, number, trial);
        const auto shape = assets.context_shape(source);
        if (shape && shape->claims.orientation != tree::SaidBy::kFile && io::names_mesh(item.file))
            if (const auto axes = widgets::mesh_axes_row(item.axes)) context.perform("context-axes", {n, *axes});
    }
}

} // namespace

void draw_context(InterfaceContext& context) {
    Trial& trial = context.interface.of<Editing>().context;
    const bool tree = context.workspace.document().tree() != nullptr;
    const widgets::TitleButton add{"Add\xE2\x80\xA6",
                                   tree ? "Show a mask or a mesh beside the tree: an organ, a bone"
                                        : "Show another mask or mesh: an organ, a bone",
                                   "context"};
    if (tree || !context.workspace.document().has_scene())
        draw_title(context, "Context", {add});
    else
        draw_title(context, "Context", {{"Unit\xE2\x80\xA6", "What one unit of the files' numbers is", "units"}, add});
    if (!context.workspace.document().marks().context.empty())
        widgets::row_headings({"Surface", "Shown or hidden, its colour, its file and label"},
                              {"Net", "As a surface or as a wireframe"},
                              ImGui::GetFrameHeight() + 4.0F * theme::scale());
    // A copy, since actions of rows change the list.
    const std::vector<ContextItem> items = context.workspace.document().marks().context;
    if (trial.of > static_cast<int>(items.size())) trial.of = -1;
    for (std::size_t i = 0; i < items.size(); ++i) {
        ImGui::PushID(static_cast<int>(i));
        draw_row(context, items[i], static_cast<int>(i + 1), trial);
        ImGui::PopID();
    }
    context.interface.tried_context.reset();
    if (trial.of < 1 || context.workspace.document().marks().context != items) return;
    context.interface.tried_context = items;
    (*context.interface.tried_context)[static_cast<std::size_t>(trial.of - 1)] = trial.item;
}

} // namespace ramus::app
