// The section of colours: the coloured quantity or data, and the mapping of values to colours.
#include "app/panels/choice_row.h"
#include "app/panels/editing.h"
#include "app/panels/sections.h"
#include "app/panels/widgets.h"
#include "app/session/numbers.h"

#include <algorithm>
#include <imgui.h>
#include <string>
#include <utility>
#include <vector>

namespace ramus::app {

namespace {

using Choices = std::vector<std::pair<std::string, std::string>>; // values and their labels

void draw_colour_by(InterfaceContext& context, const tree::VesselTree& tree, const ColourBy& now) {
    Choices choices;
    for (const ColouringRow& row : colourings()) choices.emplace_back(row.key, row.label);
    for (const tree::DataArrays* arrays : {&tree.point_data, &tree.branch_data})
        for (const tree::DataArray& array : *arrays)
            choices.emplace_back(name_of(ColourBy::array(array.name)), array.name);
    if (const auto chosen = widgets::choice_row("By", "What colours say: quantities, and data of the tree's file",
                                                name_of(now), choices))
        context.perform("colour-by", {*chosen});
}

void draw_map(InterfaceContext& context, const Marks& marks) {
    Choices choices;
    for (const ColourMap map : kColourMaps) choices.emplace_back(name_of(map), name_of(map));
    if (const auto chosen = widgets::choice_row("Map", "The colours from the least value to the largest",
                                                std::string(name_of(marks.colour_map)), choices))
        context.perform("colour-map", {*chosen});
}

void draw_logarithm(InterfaceContext& context, const ColourLook& look) {
    const std::string now = !look.logarithmic ? "auto" : *look.logarithmic ? "on" : "off";
    if (const auto chosen = widgets::choice_row("Scale", "Whether the colours follow the value or its logarithm", now,
                                                {{"auto", "As is usual"}, {"off", "Linear"}, {"on", "Logarithmic"}}))
        context.perform("colour-log", {*chosen});
}

// Two numbers; empty: the least and the largest value.
void draw_range(InterfaceContext& context, const ColourLook& look) {
    constexpr const char *kField = "colour-range", *kHelp = "Values that the colours begin and end at, as 5,80; empty: "
                                                            "the least and the largest. Enter takes them";
    auto& [owner, typed] = context.interface.of<Editing>().numbers;
    const std::string current = look.range ? exact_text((*look.range)[0]) + "," + exact_text((*look.range)[1]) : "";
    std::array<char, 64> shown{};
    std::copy_n(current.begin(), std::min(current.size(), shown.size() - 1), shown.begin());
    const bool mine = owner == kField;
    widgets::begin_row("Range", kHelp);
    const bool entered =
        ImGui::InputTextWithHint("##range", "automatic", mine ? typed.data() : shown.data(), typed.size(),
                                 ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_AutoSelectAll);
    const bool activated = ImGui::IsItemActivated(), left = ImGui::IsItemDeactivated(),
               edited = ImGui::IsItemDeactivatedAfterEdit();
    ImGui::PopID();
    if (activated) owner = kField, typed = shown;
    const std::string range(typed.data());
    if (mine && left) owner.clear();
    if (mine && (entered || edited) && range != current)
        context.perform("colour-range", {range.empty() ? "auto" : range});
}

} // namespace

void draw_colours(InterfaceContext& context) {
    const Document& document = context.workspace.document();
    const Marks marks = document.marks(); // a choice changes it
    const tree::VesselTree& tree = *document.tree();
    const bool of_values = marks.colour_by.kind == ColourBy::kQuantity || marks.colour_by.kind == ColourBy::kData;
    if (!of_values && tree.point_data.empty() && tree.branch_data.empty()) return;
    widgets::section("Colours");
    draw_colour_by(context, tree, marks.colour_by);
    if (!of_values) return;
    draw_map(context, marks);
    draw_logarithm(context, marks.colour_look);
    draw_range(context, marks.colour_look);
    bool legend = marks.colour_look.legend;
    if (ImGui::Checkbox("Legend", &legend)) context.perform("legend", {legend ? "on" : "off"});
}

} // namespace ramus::app
