#include "app/panels/validation_plot.h"

#include "app/panels/theme.h"
#include "app/panels/widgets.h"
#include "app/session/numbers.h"

#include <algorithm>
#include <array>
#include <functional>
#include <imgui.h>
#include <string>
#include <vector>

namespace ramus::app {

namespace {

using validate::RadiusPlace;

// One curve: the radii at the places of a branch.
struct RadiusLine {
    const char* name;
    ImVec4 colour;
    float width; // points
    std::function<double(std::size_t)> radius_mm;
};

struct BranchPlot {
    const std::vector<RadiusPlace>& places;
    std::size_t first = 0, end = 0;
    std::vector<RadiusLine> lines;
    double length_mm = 0.0, top_mm = 0.0;
    ImVec2 corner{}, size{};

    [[nodiscard]] float x_of(double along_mm) const {
        return corner.x + size.x * static_cast<float>(along_mm / length_mm);
    }
    [[nodiscard]] float y_of(double radius_mm) const {
        return corner.y + size.y * static_cast<float>(1.0 - radius_mm / top_mm);
    }
};

// In drawing order: the thin line of the tree's radii is on top.
std::vector<RadiusLine> lines_of(const TreeValidation& validation) {
    const std::vector<RadiusPlace>& places = validation.found->radii;
    std::vector<RadiusLine> lines;
    if (!validation.mask_mm.empty())
        lines.push_back({"mask", theme::kGood, 1.4F, [&](std::size_t i) { return validation.mask_mm[i]; }});
    if (!validation.cones_mm.empty())
        lines.push_back({"cones", theme::kHighlight, 1.4F, [&](std::size_t i) { return validation.cones_mm[i]; }});
    lines.push_back({"surface", theme::kAccent, 2.4F, [&](std::size_t i) { return places[i].surface_mm; }});
    lines.push_back({"read", theme::kText, 1.0F, [&](std::size_t i) { return places[i].input_mm; }});
    return lines;
}

BranchPlot plot_of(const TreeValidation& validation, int branch) {
    const std::vector<RadiusPlace>& places = validation.found->radii;
    const auto begin = std::ranges::lower_bound(places, branch, {}, &RadiusPlace::branch);
    const auto end = std::ranges::upper_bound(places, branch, {}, &RadiusPlace::branch);
    BranchPlot plot{places, static_cast<std::size_t>(begin - places.begin()),
                    static_cast<std::size_t>(end - places.begin()), lines_of(validation)};
    if (plot.end - plot.first < 2) return plot;
    plot.length_mm = places[plot.end - 1].along_mm;
    // At joints surfaces are as wide as the joint; the axis covers only the tree's radii and places away from joints.
    for (std::size_t i = plot.first; i < plot.end; ++i) {
        plot.top_mm = std::max(plot.top_mm, places[i].input_mm);
        if (places[i].alone)
            for (const RadiusLine& line : plot.lines) plot.top_mm = std::max(plot.top_mm, line.radius_mm(i));
    }
    plot.top_mm *= 1.15;
    return plot;
}

void draw_line(ImDrawList& list, const BranchPlot& plot, const RadiusLine& line) {
    std::vector<ImVec2> points;
    for (std::size_t i = plot.first; i < plot.end; ++i)
        points.push_back({plot.x_of(plot.places[i].along_mm), plot.y_of(line.radius_mm(i))});
    list.AddPolyline(points.data(), static_cast<int>(points.size()), ImGui::GetColorU32(line.colour), ImDrawFlags_None,
                     line.width * theme::scale());
}

// Where joints, free ends or other vessels are near.
void shade_joints(ImDrawList& list, const BranchPlot& plot) {
    for (std::size_t i = plot.first; i < plot.end;) {
        std::size_t end = i;
        while (end < plot.end && !plot.places[end].alone) ++end;
        if (end > i) {
            const float from = i == plot.first ? plot.corner.x : plot.x_of(plot.places[i].along_mm);
            const float to = end == plot.end ? plot.corner.x + plot.size.x : plot.x_of(plot.places[end].along_mm);
            list.AddRectFilled({from, plot.corner.y}, {to, plot.corner.y + plot.size.y},
                               ImGui::GetColorU32(theme::kFrame));
        }
        i = end + 1;
    }
}

// Marks a finding's place if it is on this branch.
void mark_finding(ImDrawList& list, const BranchPlot& plot, const TreeValidation& validation, int current) {
    if (current < 0 || static_cast<std::size_t>(current) >= validation.findings->size()) return;
    const Finding& finding = (*validation.findings)[static_cast<std::size_t>(current)];
    if (std::ranges::find(finding.branches, plot.places[plot.first].branch) == finding.branches.end()) return;
    const auto squared = [&](const RadiusPlace& place) {
        const glm::dvec3 way = place.at - finding.at;
        return way.x * way.x + way.y * way.y + way.z * way.z;
    };
    const auto begin = plot.places.begin() + static_cast<std::ptrdiff_t>(plot.first);
    const auto nearest =
        std::ranges::min_element(begin, plot.places.begin() + static_cast<std::ptrdiff_t>(plot.end), {}, squared);
    const float x = plot.x_of(nearest->along_mm);
    list.AddLine({x, plot.corner.y}, {x, plot.corner.y + plot.size.y}, ImGui::GetColorU32(theme::kHighlight),
                 1.4F * theme::scale());
}

// Shows the values of all curves at the pointer.
void tell_values(const BranchPlot& plot, const Lengths& lengths) {
    if (!ImGui::IsItemHovered()) return;
    const double along = plot.length_mm * (ImGui::GetMousePos().x - plot.corner.x) / plot.size.x;
    std::size_t at = plot.first;
    while (at + 1 < plot.end && plot.places[at + 1].along_mm <= along) ++at;
    std::string text = lengths.text(plot.places[at].along_mm) + " from its first point";
    for (auto line = plot.lines.rbegin(); line != plot.lines.rend(); ++line)
        text.append("\n").append(line->name).append(": ").append(lengths.text(line->radius_mm(at)));
    ImGui::SetTooltip("%s", text.c_str());
}

void draw_legend(const BranchPlot& plot) {
    for (auto line = plot.lines.rbegin(); line != plot.lines.rend(); ++line) {
        if (line != plot.lines.rbegin()) ImGui::SameLine(0.0F, 10.0F * theme::scale());
        const ImVec2 at = ImGui::GetCursorScreenPos();
        const float length = 12.0F * theme::scale(), y = at.y + 0.55F * ImGui::GetTextLineHeight();
        ImGui::GetWindowDrawList()->AddLine({at.x, y}, {at.x + length, y}, ImGui::GetColorU32(line->colour),
                                            line->width * theme::scale());
        ImGui::Dummy({length, ImGui::GetTextLineHeight()});
        ImGui::SameLine(0.0F, 5.0F * theme::scale());
        widgets::quiet(line->name);
    }
}

} // namespace

void draw_radius_plot(const Document& document, const TreeValidation& validation, bool fits, int current_finding) {
    const std::vector<int>& selection = document.marks().selection;
    const bool same_tree = fits || validation.of.tree == document.tree();
    if (selection.empty() || !same_tree) return widgets::quiet_wrapped("Select a branch to see the radius along it.");
    BranchPlot plot = plot_of(validation, selection.front());
    if (!(plot.top_mm > 0.0) || !(plot.length_mm > 0.0))
        return widgets::quiet_wrapped("The selected branch is too short for a plot of its radius.");
    const Lengths lengths = document.lengths();
    ImGui::Text("Radius along branch %d", selection.front());
    ImGui::PushFont(theme::small_font());
    plot.corner = ImGui::GetCursorScreenPos();
    plot.size = {ImGui::GetContentRegionAvail().x, 92.0F * theme::scale()};
    ImGui::Dummy(plot.size);
    widgets::note_item("Radius along the branch");
    const ImVec2 opposite{plot.corner.x + plot.size.x, plot.corner.y + plot.size.y};
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.PushClipRect(plot.corner, opposite, true);
    list.AddRectFilled(plot.corner, opposite, ImGui::GetColorU32(theme::kBar));
    shade_joints(list, plot);
    for (const double radius : round_numbers(0.0, plot.top_mm))
        list.AddLine({plot.corner.x, plot.y_of(radius)}, {opposite.x, plot.y_of(radius)},
                     ImGui::GetColorU32(theme::kLine));
    mark_finding(list, plot, validation, current_finding);
    for (const RadiusLine& line : plot.lines) draw_line(list, plot, line);
    list.PopClipRect();
    tell_values(plot, lengths);
    draw_legend(plot);
    widgets::quiet(
        ("Along 0 to " + lengths.text(plot.length_mm) + ", radius 0 to " + lengths.text(plot.top_mm)).c_str());
    ImGui::PopFont();
    if (!validation.mask_trouble.empty()) widgets::trouble(("No line of the mask: " + validation.mask_trouble).c_str());
}

} // namespace ramus::app
