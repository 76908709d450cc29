// The region that a person grows in a scan: its tools, its range of values, what it holds, and saving it.
#include "app/assets/region.h"
#include "app/panels/plan_rows.h"
#include "app/panels/sections.h"
#include "app/panels/theme.h"
#include "app/panels/widgets.h"
#include "app/session/numbers.h"

#include <array>
#include <cmath>
#include <imgui.h>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace ramus::app {

namespace {

struct RegionButton {
    const char *label, *help, *command;
    std::vector<std::string> words{};
    bool possible = true;
};

// Buttons of one width next to each other.
void region_buttons(InterfaceContext& context, const std::array<RegionButton, 2>& buttons) {
    const float gap = 4.0F * theme::scale();
    const float width = std::floor((ImGui::GetContentRegionAvail().x - gap) / 2.0F);
    bool first = true;
    for (const RegionButton& button : buttons) {
        if (!std::exchange(first, false)) ImGui::SameLine(0.0F, gap);
        ImGui::BeginDisabled(!button.possible);
        if (ImGui::Button(button.label, {width, 0.0F})) context.perform(button.command, button.words);
        ImGui::EndDisabled();
        widgets::tooltip(button.help);
    }
}

void draw_range(InterfaceContext& context, const RegionOf& of, const std::string& unit) {
    plan_rows::field_label(context, ("Values" + (unit.empty() ? "" : ", " + unit)).c_str());
    widgets::tooltip(of.suggested ? "Lowest and highest value of the region, as suggested by where you clicked"
                                  : "Lowest and highest value of the region");
    const std::vector<std::string> typed =
        plan_rows::number_field(context, "region-range", rounded(of.low) + ", " + rounded(of.high), 150.0F);
    if (typed.size() == 2) context.perform("region-range", {typed[0] + "," + typed[1]});
    region_buttons(context, {{{"Grow less", "Narrows the range of values; key -", "region-grow", {"less"}},
                              {"Grow more", "Widens the range of values; key +", "region-grow", {"more"}}}});
}

void draw_grown(InterfaceContext& context, const ScanRegion& region, const ScanFile& scan) {
    if (context.workspace.awaited(WorkKind::kRegion)) {
        widgets::quiet("Growing\xE2\x80\xA6");
    } else if (!region.grown.trouble.empty()) {
        widgets::trouble(region.grown.trouble.c_str());
    } else if (region.grown.region) {
        widgets::fact("Region", words_of_region(*region.grown.region, scan));
        for (const std::string& remark : remarks_on(*region.grown.region)) widgets::trouble(remark.c_str());
    }
}

void draw_cut_radius(InterfaceContext& context) {
    plan_rows::field_label(context, "Radius of a cut by a click, mm");
    const std::string now = rounded(context.interface.tool_settings.cut_radius_mm);
    const std::vector<std::string> typed = plan_rows::number_field(context, "region-radius", now, 56.0F);
    if (typed.size() == 1) context.perform("region-radius", {typed[0]});
}

} // namespace

void draw_region(InterfaceContext& context) {
    const auto scan = scan_to_grow_in(context.workspace.document().marks());
    if (!scan) return;
    const widgets::TitleButton grow{
        "Grow", "Click in a vessel on a slice: similar values around it become a mask", "tool", {"region"}};
    const widgets::TitleButton cut{
        "Cut", "Drag across the region where it leaves the vessel, or click there", "tool", {"region-cut"}};
    if (!draw_section(context, "Region of similar values", {cut, grow})) return;
    const ScanRegion region = context.workspace.current_assets().region; // a copy: buttons change it
    const bool grows = region.exists() || context.interface.tool_kind->name.starts_with("region");
    if (grows)
        widgets::quiet_wrapped("A help to get a mask, no segmentation: it leaks where neighbouring tissue has similar "
                               "values. Compare it with the scan on every slice.");
    const auto file = context.workspace.current_assets().scan(*scan);
    if (region.exists() && file && region.now().scan == source_of(*scan)) {
        draw_range(context, region.now(), file->volume->value_unit);
        if (context.interface.tool_kind->name == "region-cut") draw_cut_radius(context);
        draw_grown(context, region, *file);
    }
    if (!region.exists() && !region.can_undo()) return;
    region_buttons(context,
                   {{{"Undo step", "Takes back the last place, range or cut", "region-undo", {}, region.can_undo()},
                     {"Remove", "Removes the region; Undo step brings it back", "region-off", {}, region.exists()}}});
    region_buttons(
        context, {{{"Save mask\xE2\x80\xA6", "Writes the region as NIfTI or NRRD", "region-save", {}, region.exists()},
                   {"Make a tree\xE2\x80\xA6",
                    "Writes the region as a mask, and opens it as a vessel tree",
                    "region-tree",
                    {},
                    region.exists()}}});
}

} // namespace ramus::app
