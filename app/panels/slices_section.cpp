// The page of slices: scans, layout of the picture, window, place, and what slices show.
#include "app/panels/choice_row.h"
#include "app/panels/plan_rows.h"
#include "app/panels/sections.h"
#include "app/panels/widgets.h"
#include "app/picture/slices.h"
#include "app/session/numbers.h"

#include <array>
#include <imgui.h>
#include <string>
#include <utility>
#include <vector>

namespace ramus::app {

namespace {

using SliceChoices = std::vector<std::pair<std::string, std::string>>; // values and their labels

SliceChoices choices_of(const auto& names) {
    SliceChoices choices;
    for (const auto& [value, name] : names) {
        std::string label(name);
        label.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(label.front())));
        choices.emplace_back(std::string(name), label);
    }
    return choices;
}

void draw_window(InterfaceContext& context, const Scan& scan, std::size_t index) {
    const auto file = context.workspace.current_assets().scan(scan);
    if (!file) return;
    const slice::Window window = window_of(scan, *file);
    std::string now = scan.window ? "" : "auto";
    SliceChoices choices{{"auto", "Automatic"}};
    for (const slice::WindowPreset& preset : slice::kWindowPresets) {
        choices.emplace_back(preset.name, "CT " + std::string(preset.name));
        if (scan.window == preset.window) now = preset.name;
    }
    const std::string number = std::to_string(index + 1);
    if (const auto chosen = widgets::choice_row("Window",
                                                "The values from black to white; right-drag over a slice "
                                                "changes width (across) and level (up and down)",
                                                now.empty() ? "By hand" : now, choices))
        context.perform("window", {*chosen, number});
    plan_rows::field_label(context, "    width, level");
    const std::vector<std::string> typed = plan_rows::number_field(
        context, ("window" + number).c_str(), rounded(window.width) + ", " + rounded(window.level), 130.0F);
    if (typed.size() == 2) context.perform("window", {typed[0] + "," + typed[1], number});
}

void draw_scan(InterfaceContext& context, const Scan& scan, std::size_t index) {
    plan_rows::object_row(context, plan_rows::row_of(context, scan, index));
    if (!scan.visible) return;
    const auto trouble = context.workspace.current_assets().trouble(scan);
    if (trouble) return widgets::trouble(trouble->message().c_str());
    if (scan.labels || index > 0) plan_rows::object_opacity(context, plan_rows::row_of(context, scan, index));
    if (!scan.labels) draw_window(context, scan, index);
}

void draw_place(InterfaceContext& context) {
    const Session& session = context.workspace.document().session();
    const glm::dvec3 at = crosshair_of(session, context.workspace.current_assets());
    plan_rows::field_label(context, "Place, mm");
    const std::string now = rounded(at.x) + ", " + rounded(at.y) + ", " + rounded(at.z);
    const std::vector<std::string> typed = plan_rows::number_field(context, "crosshair", now, 170.0F);
    if (typed.size() == 3) context.perform("crosshair", {typed[0] + "," + typed[1] + "," + typed[2]});
}

void draw_slab(InterfaceContext& context, const slice::Sampling& sampling) {
    const bool on = sampling.slab_mm > 0.0;
    SliceChoices choices{{"off", "Off"}};
    for (auto& choice : choices_of(slice::kSlabs)) choices.push_back(std::move(choice));
    constexpr double kUsual = 10.0;
    const std::string mm = exact_text(on ? sampling.slab_mm : kUsual);
    if (const auto chosen = widgets::choice_row("Slab", "Makes slices thick: the largest, mean or least value across",
                                                on ? std::string(slice::name_of(sampling.slab)) : "off", choices))
        context.perform("slab", *chosen == "off" ? std::vector<std::string>{"off"} : std::vector{mm, *chosen});
    if (!on) return;
    plan_rows::field_label(context, "    thickness, mm");
    const std::vector<std::string> typed = plan_rows::number_field(context, "slab", mm, 60.0F);
    if (typed.size() == 1) context.perform("slab", {typed[0], std::string(slice::name_of(sampling.slab))});
}

void draw_planes(InterfaceContext& context, const SliceViews& views) {
    widgets::quiet("Among the vessels");
    constexpr int kInRow = 2;
    int n = 0;
    for (const auto& [name, label] : choices_of(slice::kDirections)) {
        const slice::Direction direction = *slice::direction_named(name);
        const glm::vec3 colour = slice_colour(direction);
        if (n++ % kInRow != 0) ImGui::SameLine(0.5F * ImGui::GetContentRegionAvail().x);
        bool shown = views.in_picture[slice_index(direction)];
        ImGui::PushStyleColor(ImGuiCol_CheckMark, {colour.x, colour.y, colour.z, 1.0F});
        const bool changed = ImGui::Checkbox(label.c_str(), &shown);
        ImGui::PopStyleColor();
        widgets::note_item((label + " among the vessels").c_str());
        if (changed) context.perform("slice-plane", {name, shown ? "on" : "off"});
    }
    SliceChoices choices{{"off", "Nothing"}};
    for (auto& [name, label] : choices_of(slice::kDirections)) choices.emplace_back(name, "Before the " + name);
    const std::string now = views.cut_away ? std::string(slice::name_of(*views.cut_away)) : "off";
    if (const auto chosen = widgets::choice_row("Cut away", "Leaves out what lies before a slice", now, choices))
        context.perform("cut-away", {*chosen});
    if (!views.cut_away) return;
    bool behind = views.cut_behind;
    if (ImGui::Checkbox("Behind the slice instead", &behind))
        context.perform("cut-away", behind ? std::vector<std::string>{now, "--behind"} : std::vector{now});
}

void draw_switches(InterfaceContext& context, const SliceViews& views) {
    widgets::quiet("On slices");
    const auto box = [&](const char* label, const char* name, bool now) {
        if (ImGui::Checkbox(label, &now)) context.perform("slice-show", {name, now ? "on" : "off"});
    };
    const float middle = 0.5F * ImGui::GetContentRegionAvail().x;
    box("Outlines", "outlines", views.outlines);
    ImGui::SameLine(middle);
    box("Centerlines", "axes", views.axes);
    box("Crosshair", "crosshair", views.crosshair_lines);
    ImGui::SameLine(middle);
    box("Smooth values", "smooth", views.sampling.interpolation == slice::Interpolation::kLinear);
}

} // namespace

void draw_slices(InterfaceContext& context) {
    const widgets::TitleButton add{"Scan\xE2\x80\xA6", "Show a scan, or the labels of a segmentation, in slices",
                                   "scan"};
    if (!draw_section(context, "Slices", {add})) return;
    // Copies, since actions of rows change the session.
    const std::vector<Scan> scans = context.workspace.document().marks().scans;
    for (std::size_t i = 0; i < scans.size(); ++i) {
        ImGui::PushID(static_cast<int>(i));
        draw_scan(context, scans[i], i);
        ImGui::PopID();
    }
    const SliceViews views = context.workspace.document().session().slices;
    const SliceChoices layouts{{"picture", "Vessels alone"}, {"slices", "Vessels and slices"},
                               {"large", "Vessels large"},   {"axial", "Axial alone"},
                               {"coronal", "Coronal alone"}, {"sagittal", "Sagittal alone"},
                               {"oblique", "Oblique alone"}, {"along", "Along a vessel"}};
    if (const auto chosen = widgets::choice_row("Layout", "What the picture is divided into: keys 1 to 8",
                                                std::string(name_of(views.layout)), layouts))
        context.perform("layout", {*chosen});
    draw_place(context);
    draw_slab(context, views.sampling);
    draw_planes(context, views);
    draw_switches(context, views);
}

} // namespace ramus::app
