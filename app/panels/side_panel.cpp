// The side panel: the tree, and pages for exploring, the surface, and planning. Hovering, pressing and selecting move
// nothing: parts that may grow are last, or have reserved space.
#include "app/panels/branch_list.h"
#include "app/panels/choice_row.h"
#include "app/panels/editing.h"
#include "app/panels/parts.h"
#include "app/panels/sections.h"
#include "app/panels/theme.h"
#include "app/panels/widgets.h"
#include "app/session/labels.h"
#include "app/session/numbers.h"
#include "app/session/surface_options.h"
#include "app/session/systems.h"
#include "core/base/words.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <imgui.h>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace ramus::app {

namespace {

void draw_tree(InterfaceContext& context) {
    const Document& document = context.workspace.document();
    const TreeFacts& facts = *context.workspace.facts();
    const tree::VesselTree& tree = *document.tree();
    const std::string name = document.session().tree.path.filename().string();
    ImGui::PushFont(theme::title_font());
    const std::string shown = widgets::fitted(name, ImGui::GetContentRegionAvail().x);
    ImGui::TextUnformatted(shown.c_str());
    ImGui::PopFont();
    widgets::tooltip(document.session().tree.path.c_str());
    ImGui::Dummy({0.0F, 1.0F});
    const Lengths lengths = document.lengths();
    std::vector<widgets::Fact> facts_shown{
        {"Branches", grouped(tree.branches.size())},
        {"Generations", grouped(static_cast<std::uint64_t>(facts.statistics.generations))},
        {"Length", lengths.text(facts.statistics.length_mm)},
        {"Volume", lengths.volume(facts.statistics.volume_mm3)},
        {"Diameter", lengths.range(2.0 * facts.statistics.radius_mm.min, 2.0 * facts.statistics.radius_mm.max)}};
    if (tree.roots.size() > 1) facts_shown.push_back({"Roots", grouped(tree.roots.size())});
    if (tree.loop_count > 0) facts_shown.push_back({"Loops", grouped(static_cast<std::uint64_t>(tree.loop_count))});
    if (const auto& edits = document.marks().edits; !edits.empty())
        facts_shown.push_back({"Edits", grouped(edits.size()), [&] {
                                   widgets::fact("Edits", grouped(edits.size()));
                                   constexpr std::size_t kListed = 12; // the last ones
                                   const auto last = std::span(edits).last(std::min(edits.size(), kListed));
                                   const auto line = [&](const tree::Edit& edit) {
                                       return lengths.worded(sentence(edit));
                                   };
                                   widgets::tooltip(joined(last, "\n", line).c_str());
                               }});
    facts_shown.push_back(contacts_fact(context));
    if (nothing_depends(facts)) facts_shown.push_back({"Dependency", "none: separate vessels"});
    facts_shown.push_back(doctor_fact(context));
    widgets::facts(facts_shown);
}

// The files shown without a tree.
void draw_alone(InterfaceContext& context) {
    const Document& document = context.workspace.document();
    ImGui::PushFont(theme::title_font());
    const std::string shown = widgets::fitted(document.subject().filename().string(), ImGui::GetContentRegionAvail().x);
    ImGui::TextUnformatted(shown.c_str());
    ImGui::PopFont();
    widgets::tooltip(document.subject().c_str());
    ImGui::Dummy({0.0F, 1.0F});
    widgets::quiet_wrapped("There is no vessel tree. One that is opened comes in among what is shown.");
    const tree::Claims& claims = document.claims();
    widgets::fact("Unit of length", claims.has_unit() ? "mm" : "not said");
    widgets::fact("Axes lead to", claims.has_sides() ? "RAS" : "not said");
    draw_context(context);
    draw_slices(context);
}

std::string as_text(const SurfaceOption& option, float value) {
    if (option.whole) return std::to_string(static_cast<int>(value));
    return option.zero_is_off && value <= 0.0F ? "off" : digits(value, 2);
}

void draw_slider(const SurfaceOption& option, float& value) {
    const auto least = static_cast<float>(option.slider_least), most = static_cast<float>(option.slider_most);
    if (!option.whole) {
        ImGui::SliderFloat("##slider", &value, least, most, "", ImGuiSliderFlags_AlwaysClamp);
        return;
    }
    int whole = static_cast<int>(value);
    ImGui::SliderInt("##slider", &whole, static_cast<int>(least), static_cast<int>(most), "",
                     ImGuiSliderFlags_AlwaysClamp);
    value = static_cast<float>(whole);
}

// An option with named values.
void draw_words(InterfaceContext& context, const SurfaceOption& option, const mesh::SurfaceOptions& options) {
    std::vector<std::pair<std::string, std::string>> entries;
    for (const OptionWord& word : option.words) entries.emplace_back(word.key, word.label);
    if (const auto chosen = widgets::choice_row(option.label.data(), option.tooltip.data(),
                                                spelled(option, option.value(options)), entries))
        context.perform("surface", {std::string(option.key), *chosen});
}

// The effect of the option above on this tree.
void draw_smoothing(InterfaceContext& context) {
    const Assets& assets = context.workspace.current_assets();
    if (!assets.centerlines.lines) return;
    const Smoothing& smoothing = assets.centerlines.smoothing;
    const Lengths lengths(assets.tree->claims);
    if (!smoothing.voxels) return widgets::quiet("The points are not from voxels: not smoothed.");
    widgets::fact("    voxels", voxels_text(*smoothing.voxels, lengths));
    if (smoothing.voxels->estimated) widgets::fact("    their size is", "estimated from the points");
    widgets::fact("    moves points by, median", lengths.text(smoothing.moved.median_mm));
    widgets::fact("    at most", lengths.text(smoothing.moved.largest_mm) + ", " +
                                     digits(smoothing.moved.largest_radii, 2) + " radii");
}

void draw_options(InterfaceContext& context) {
    const mesh::SurfaceOptions options = context.workspace.document().marks().options; // a choice changes it
    auto& sliders = context.interface.of<Editing>().options;
    auto& shown = context.interface.of<Editing>().shown_options;
    for (const SurfaceOption& option : surface_options()) {
        if (option.label.empty()) continue;
        if (option.only_when_set && option.value(options) == option.value({}) && !shown.contains(option.key)) continue;
        if (option.only_when_set) shown.insert(option.key);
        if (!option.words.empty()) {
            draw_words(context, option, options);
            continue;
        }
        widgets::Slider<float>& slider = sliders[option.key];
        const bool changed = widgets::slider_row(
            option.label.data(), option.tooltip.data(), slider, static_cast<float>(option.value(options)),
            [&](float& value) { draw_slider(option, value); }, [&](float value) { return as_text(option, value); });
        if (changed) context.perform("surface", {std::string(option.key), spelled(option, slider.value)});
        if (option.key == "smooth") draw_smoothing(context);
    }
    mesh::SurfaceOptions tried = options;
    for (const SurfaceOption& option : surface_options())
        if (option.words.empty() && sliders[option.key].held)
            option.set(tried, std::stod(spelled(option, sliders[option.key].value)));
    context.workspace.try_options(tried == options ? std::nullopt : std::optional(tried));
}

} // namespace

void draw_surface(InterfaceContext& context) {
    widgets::section("Surface");
    draw_options(context);
}

// Last, so that it moves nothing when it appears.
void draw_surface_problem(InterfaceContext& context) {
    const std::string& problem = context.workspace.surface_problem();
    if (problem.empty()) return;
    widgets::rule();
    widgets::trouble(problem == "cancelled" ? "Cancelled. Shown are the cones or an older surface."
                                            : window_words(problem).c_str());
    if (ImGui::Button("Compute again")) context.workspace.retry_surface();
}

namespace {

struct Page {
    PanelPage page;
    const char *label, *help;
};
constexpr std::array<Page, 4> kPages{{{PanelPage::kExplore, "Explore", "Systems, selection and branches"},
                                      {PanelPage::kSurface, "Surface", "Surface, glass, context and comparison"},
                                      {PanelPage::kSlices, "Slices", "Scans, and slices through them"},
                                      {PanelPage::kPlan, "Plan", "Lesions, cuts and measurements"}}};

void draw_pages(InterfaceContext& context) {
    const float scale = theme::scale();
    ImGui::Dummy({0.0F, 4.0F * scale});
    const float width = std::floor(ImGui::GetContentRegionAvail().x / static_cast<float>(kPages.size()));
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {0.0F, 0.0F});
    for (const Page& page : kPages) {
        if (&page != kPages.data()) ImGui::SameLine();
        const bool chosen = context.interface.page == page.page;
        const ImVec4 ground = chosen ? theme::kAccentDim : theme::kRaised;
        if (widgets::button(page.label, {width, 0.0F}, ground, chosen ? theme::kText : theme::kQuiet))
            context.perform("panel", {key_of(page.page)});
        widgets::tooltip(page.help,
                         page.page == PanelPage::kSurface || page.page == PanelPage::kSlices ? nullptr : "B");
    }
    ImGui::PopStyleVar();
}

// The table, or a button to return it to the panel.
void draw_branches(InterfaceContext& context) {
    const bool apart = context.interface.of<BranchList>().apart;
    draw_title(
        context, "Branches",
        {{apart ? "Back" : "Window",
          apart ? "Shows the table of branches here again" : "Shows the table of branches in a window of its own",
          "branches"}});
    if (apart)
        widgets::quiet_wrapped("The table is in a window of its own.");
    else
        draw_branch_list(context);
}

} // namespace

// The part above the table scrolls if the panel is too low: the table keeps its rows.
void draw_explore(InterfaceContext& context) {
    float& height = context.interface.explore_height;
    const float room = ImGui::GetContentRegionAvail().y - least_branch_list_height(context.interface.of<BranchList>());
    const float least = 3.0F * ImGui::GetFrameHeightWithSpacing();
    ImGui::BeginChild("above the table", {0.0F, std::max(std::min(height, room), least)});
    draw_systems(context);
    height = draw_selection(context);
    ImGui::EndChild();
    draw_branches(context);
}

namespace {

// The edge towards the picture can be dragged.
void draw_edge(InterfaceContext& context, float width) {
    const float scale = theme::scale();
    const ImVec2 at = ImGui::GetWindowPos();
    const ImVec2 cursor = ImGui::GetCursorPos();
    ImGui::SetCursorScreenPos(at);
    ImGui::InvisibleButton("##edge", {6.0F * scale, ImGui::GetWindowHeight() - ImGui::GetStyle().WindowPadding.y});
    const bool held = ImGui::IsItemActive();
    if (held || ImGui::IsItemHovered()) {
        ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
        ImGui::GetWindowDrawList()->AddRectFilled(at, {at.x + 2.0F * scale, at.y + ImGui::GetWindowHeight()},
                                                  ImGui::GetColorU32(held ? theme::kAccentDim : theme::kLine));
    }
    if (held) context.interface.panel_points = (at.x + width - ImGui::GetIO().MousePos.x) / scale;
    ImGui::SetCursorPos(cursor);
}

} // namespace

void draw_side_panel(InterfaceContext& context) {
    const Layout& layout = context.layout;
    if (layout.panel_width == 0) return;
    const auto width = static_cast<float>(layout.panel_width);
    widgets::begin_fixed("side panel", static_cast<float>(layout.window.x) - width,
                         static_cast<float>(layout.bar_height), width,
                         static_cast<float>(layout.window.y - layout.bar_height - layout.status_height));
    draw_edge(context, width);
    if (context.workspace.document().tree() && context.workspace.facts()) {
        draw_tree(context);
        draw_pages(context);
        for (const Section& section : kSections) {
            ImGui::PushID(&section); // controls of different sections may have the same text
            if (section.page == context.interface.page) section.draw(context);
            ImGui::PopID();
        }
    } else if (context.workspace.document().has_scene()) {
        draw_alone(context);
    } else {
        widgets::quiet_wrapped("What ramus knows of a tree appears here.");
    }
    ImGui::End();
}

} // namespace ramus::app
