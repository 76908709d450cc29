// Sections of the planning page: cuts and their cost, thin vessels, measurements, the report. They read assets and act
// through commands.
#include "app/panels/editing.h"
#include "app/panels/plan_rows.h"
#include "app/panels/sections.h"
#include "app/panels/theme.h"
#include "app/panels/widgets.h"
#include "app/session/numbers.h"
#include "app/session/usual_sizes.h"
#include "core/base/words.h"

#include <algorithm>
#include <cmath>
#include <imgui.h>

namespace ramus::app {

void draw_cuts(InterfaceContext& context) {
    const Document& document = context.workspace.document();
    const Marks& marks = document.marks();
    if (!draw_section(context, "Cuts", {{"Cut", "Cut vessels in the picture", "tool", {"cut"}}})) return;
    plan_rows::field_label(context, "Mark cuts above \xC3\x98 (mm)");
    if (const auto words =
            plan_rows::number_field(context, "reconstruct", rounded(marks.planning.reconstruct_mm), 56.0F);
        words.size() == 1)
        context.perform("reconstruct", words);
    widgets::tooltip("Cuts through vessels of a larger diameter are marked in the list");
    const auto plan = context.workspace.current_assets().plan; // keeps it alive: removing a cut replaces it
    const measure::CutReport& report = plan->cuts;
    if (!marks.cuts.empty())
        widgets::row_headings({"Branch that is cut", "Click a line to select the branch and to look at it"},
                              {"Diameter", "The diameter where it is cut"}, ImGui::GetFrameHeight());
    for (std::size_t i = 0; i < std::min(marks.cuts.size(), report.cuts.size()); ++i) {
        const measure::CutFigures& figures = report.cuts[i];
        const int branch = marks.cuts[i].first;
        ImGui::PushID(static_cast<int>(i));
        const int done = plan_rows::removable_row(
            plan_rows::branch_name(document, branch), figures.reconstruct ? theme::kTrouble : theme::kText,
            "Click to select the branch and look at it", "\xC3\x98 " + document.lengths().text(figures.diameter_mm));
        if (ImGui::IsItemHovered()) context.interface.listed = branch;
        if (done > 0) plan_rows::go_to(context, branch);
        if (figures.reconstruct)
            ImGui::TextColored(theme::kTrouble, "%s",
                               over_text(marks.planning.reconstruct_mm, document.lengths()).c_str());
        widgets::quiet_wrapped(("Lost: " + amount_text(figures.lost, document.lengths())).c_str());
        ImGui::PopID();
        if (done < 0) context.perform("cut-remove", {std::to_string(i + 1)});
    }
    if (marks.cuts.size() > 1) {
        ImGui::Dummy({0.0F, 2.0F * theme::scale()});
        widgets::quiet_wrapped(("Lost together: " + amount_text(report.together, document.lengths())).c_str());
    }
}

namespace {

// Side by side over the panel's width.
void draw_buttons(InterfaceContext& context, std::initializer_list<widgets::TitleButton> buttons) {
    const float gap = 4.0F * theme::scale(), count = static_cast<float>(buttons.size());
    const float width = std::floor((ImGui::GetContentRegionAvail().x - (count - 1.0F) * gap) / count);
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {2.0F * theme::scale(), 2.0F * theme::scale()});
    for (const widgets::TitleButton& button : buttons) {
        if (&button != buttons.begin()) ImGui::SameLine(0.0F, gap);
        if (ImGui::Button(button.text, {width, 0.0F})) context.perform(button.command, button.words);
        widgets::tooltip(button.help);
    }
    ImGui::PopStyleVar();
}

} // namespace

// Vessels below an editable diameter.
void draw_thin_vessels(InterfaceContext& context) {
    std::string& typed = context.interface.of<Editing>().thin;
    const auto& facts = context.workspace.facts();
    const std::string usual = rounded(facts ? facts->usual_thin_mm : UsualSizes().thin_mm);
    const std::string below = typed.empty() ? usual : typed;
    widgets::section("Thin vessels");
    plan_rows::field_label(context, "Below \xC3\x98 (mm)");
    if (const auto words = plan_rows::number_field(context, "thin", below, 56.0F); words.size() == 1) typed = words[0];
    widgets::tooltip("Vessels of a smaller mean diameter");
    draw_buttons(
        context,
        {{"Hide", "Hides the vessels below this diameter", "filter-diameter", {below, "hide"}},
         {"Defocus", "Makes the vessels below this diameter grey glass", "filter-diameter", {below, "defocus"}},
         {"Show", "Shows the vessels below this diameter normally", "filter-diameter", {below, "show"}}});
}

void draw_measurements(InterfaceContext& context) {
    widgets::section("Measure");
    draw_buttons(context, {{"Distance", "Straight distance between two places", "tool", {"measure-distance"}},
                           {"Path", "Path along the vessels between two places", "tool", {"measure-path"}},
                           {"Diameter", "Diameter at a place", "tool", {"measure-diameter"}},
                           {"Angle", "Angle between three places", "tool", {"measure-angle"}}});
    const std::vector<Measurement> measurements = context.workspace.document().marks().measurements; // rows change it
    if (!measurements.empty())
        widgets::row_headings({"Measurement", "What was measured; hover a line for the details"},
                              {"Value", "What it measures, with its unit"}, ImGui::GetFrameHeight());
    for (std::size_t i = 0; i < measurements.size(); ++i)
        plan_rows::object_row(context, plan_rows::row_of(context, measurements[i], i));
}

void draw_report_button(InterfaceContext& context) {
    const Marks& marks = context.workspace.document().marks();
    bool some = !marks.cuts.empty() || !marks.selection.empty();
    for_each_object_list(marks, [&](const auto& list) { some = some || !list.empty(); });
    ImGui::Dummy({0.0F, 6.0F * theme::scale()});
    ImGui::BeginDisabled(!some);
    if (ImGui::Button("Report\xE2\x80\xA6", {-1.0F, 0.0F})) context.perform("report", {});
    ImGui::EndDisabled();
    widgets::tooltip("One page with pictures and tables of the selection, the margins, the cuts and the measurements");
}

} // namespace ramus::app
