#include "app/panels/along_plot.h"

#include "app/panels/theme.h"
#include "app/panels/widgets.h"
#include "app/session/numbers.h"

#include <algorithm>
#include <array>
#include <imgui.h>
#include <string>
#include <utility>
#include <vector>

namespace ramus::app {

namespace {

using slice::ShapeFigures;

struct DiameterLine {
    const char* name;
    ImVec4 colour;
    float width; // points
    double ShapeFigures::*diameter;
};

std::array<DiameterLine, 2> diameter_lines() {
    return {{{"equivalent \xC3\x98", theme::kAccent, 2.0F, &ShapeFigures::equivalent_mm},
             {"least \xC3\x98", theme::kText, 1.2F, &ShapeFigures::least_mm}}};
}

struct PlotFrame {
    ImVec2 corner, size;
    double length_mm, top_mm;
    [[nodiscard]] float x_of(double arc_mm) const { return corner.x + size.x * static_cast<float>(arc_mm / length_mm); }
    [[nodiscard]] float y_of(double mm) const { return corner.y + size.y * static_cast<float>(1.0 - mm / top_mm); }
    [[nodiscard]] float bottom() const { return corner.y + size.y; }
};

// Sections that are shared with other vessels are much wider; the axis covers the others.
double top_of(const VesselSections& sections) {
    double top = 0.0;
    double any = 0.0;
    for (std::size_t n = 0; n < sections.figures.size(); ++n) {
        if (!sections.figures[n]) continue;
        any = std::max(any, sections.figures[n]->equivalent_mm);
        if (sections.lumens[n]->shared_with.empty()) top = std::max(top, sections.figures[n]->equivalent_mm);
    }
    return 1.15 * (top > 0.0 ? top : any);
}

// Interrupted where no section is closed.
void draw_diameters(ImDrawList& list, const PlotFrame& frame, const VesselSections& sections,
                    const DiameterLine& line) {
    std::vector<ImVec2> points;
    const auto flush = [&] {
        if (points.size() > 1)
            list.AddPolyline(points.data(), static_cast<int>(points.size()), ImGui::GetColorU32(line.colour),
                             ImDrawFlags_None, line.width * theme::scale());
        points.clear();
    };
    for (std::size_t n = 0; n < sections.figures.size(); ++n) {
        if (!sections.figures[n]) {
            flush();
            continue;
        }
        points.push_back(
            {frame.x_of(sections.path->samples[n].arc_mm), frame.y_of((*sections.figures[n]).*line.diameter)});
    }
    flush();
}

void draw_stretch(ImDrawList& list, const PlotFrame& frame, const Stretch& stretch, const ImVec4& colour) {
    const auto [first, last] = std::minmax(stretch.from_mm, stretch.to_mm);
    const float least = 2.0F * theme::scale();
    const float left = frame.x_of(first);
    list.AddRectFilled({left, frame.bottom() - 4.0F * theme::scale()},
                       {std::max(frame.x_of(last), left + least), frame.bottom()}, ImGui::GetColorU32(colour));
}

void draw_curves(const PlotFrame& frame, const VesselSections& sections, const AlongVessel& along) {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const ImVec2 opposite{frame.corner.x + frame.size.x, frame.bottom()};
    list.PushClipRect(frame.corner, opposite, true);
    list.AddRectFilled(frame.corner, opposite, ImGui::GetColorU32(theme::kBar));
    for (const double diameter : round_numbers(0.0, frame.top_mm))
        list.AddLine({frame.corner.x, frame.y_of(diameter)}, {opposite.x, frame.y_of(diameter)},
                     ImGui::GetColorU32(theme::kLine));
    for (const DiameterLine& line : diameter_lines()) draw_diameters(list, frame, sections, line);
    if (along.stenosis) {
        draw_stretch(list, frame, along.stenosis->where, theme::kOverlap);
        if (along.stenosis->reference) draw_stretch(list, frame, *along.stenosis->reference, theme::kGap);
    }
    const float x = frame.x_of(along.at_mm);
    list.AddLine({x, frame.corner.y}, {x, frame.bottom()}, ImGui::GetColorU32(theme::kHighlight),
                 1.4F * theme::scale());
    list.PopClipRect();
}

// Moves the slice with the pointer.
void follow_pointer(InterfaceContext& context, const PlotFrame& frame, double now_mm) {
    AlongPlot& plot = context.interface.of<AlongPlot>();
    const bool over = ImGui::IsItemHovered() || ImGui::IsItemActive();
    if (!over) {
        if (const auto before = std::exchange(plot.before_mm, std::nullopt))
            context.perform("along-at", {exact_text(*before)});
        return;
    }
    if (!plot.before_mm) plot.before_mm = now_mm;
    const double share = (ImGui::GetMousePos().x - frame.corner.x) / frame.size.x;
    const double arc = frame.length_mm * std::clamp(share, 0.0, 1.0);
    const ImVec2 by = ImGui::GetIO().MouseDelta;
    if (by.x != 0.0F || by.y != 0.0F || ImGui::IsItemActive()) context.perform("along-at", {exact_text(arc)});
    if (ImGui::IsItemActive()) plot.before_mm = arc;
}

void draw_plot_legend() {
    for (const DiameterLine& line : diameter_lines()) {
        const ImVec2 at = ImGui::GetCursorScreenPos();
        const float length = 12.0F * theme::scale();
        const float y = at.y + 0.55F * ImGui::GetTextLineHeight();
        ImGui::GetWindowDrawList()->AddLine({at.x, y}, {at.x + length, y}, ImGui::GetColorU32(line.colour),
                                            line.width * theme::scale());
        ImGui::Dummy({length, ImGui::GetTextLineHeight()});
        ImGui::SameLine(0.0F, 5.0F * theme::scale());
        widgets::quiet(line.name);
        ImGui::SameLine(0.0F, 10.0F * theme::scale());
    }
}

} // namespace

void draw_along_plot(InterfaceContext& context, const VesselSections& sections) {
    const AlongVessel along = *context.workspace.document().session().slices.along;
    const double top = top_of(sections);
    if (!(top > 0.0)) return widgets::quiet_wrapped("No section of this way is closed.");
    const Lengths lengths = context.workspace.document().lengths();
    ImGui::PushFont(theme::small_font());
    const PlotFrame frame{ImGui::GetCursorScreenPos(),
                          {ImGui::GetContentRegionAvail().x, 84.0F * theme::scale()},
                          sections.path->length_mm(),
                          top};
    ImGui::InvisibleButton("##plot", frame.size);
    widgets::note_item("Diameters along the vessel");
    follow_pointer(context, frame, along.at_mm);
    draw_curves(frame, sections, along);
    draw_plot_legend();
    widgets::quiet_right("to " + lengths.text(frame.top_mm));
    ImGui::PopFont();
}

} // namespace ramus::app
