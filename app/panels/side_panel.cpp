// The panel at the right: the tree, its surface, what is selected, and the list of branches.
#include "app/panels/choice_row.h"
#include "app/panels/interface.h"
#include "app/panels/theme.h"
#include "app/panels/widgets.h"
#include "app/session/labels.h"
#include "app/session/numbers.h"
#include "app/session/surface_options.h"
#include "app/session/systems.h"
#include "core/base/words.h"

#include <algorithm>
#include <cmath>
#include <imgui.h>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace ramus::app {

namespace {

std::string range(double least, double most, const Lengths& lengths) {
    const std::string a = digits(least);
    const std::string b = digits(most);
    return (a == b ? a : a + " \xE2\x80\x93 " + b) + " " + lengths.unit();
}

void draw_tree(InterfaceContext& context) {
    const Document& document = context.workspace.document;
    const TreeFacts& facts = *context.workspace.facts();
    const tree::VesselTree& tree = *document.tree();
    const std::string name = document.session().tree.path.filename().string();
    ImGui::PushFont(theme::title_font());
    const std::string shown = widgets::fitted(name, ImGui::GetContentRegionAvail().x);
    ImGui::TextUnformatted(shown.c_str());
    ImGui::PopFont();
    widgets::tooltip(document.session().tree.path.c_str());
    ImGui::Dummy({0.0F, 1.0F});
    widgets::fact("Branches", grouped(tree.branches.size()));
    widgets::fact("Generations", grouped(static_cast<std::uint64_t>(facts.statistics.generations)));
    const Lengths lengths = document.lengths();
    widgets::fact("Length", lengths.text(facts.statistics.length_mm));
    widgets::fact("Volume", lengths.volume(facts.statistics.volume_mm3));
    widgets::fact("Diameter",
                  range(2.0 * facts.statistics.radius_mm.min, 2.0 * facts.statistics.radius_mm.max, lengths));
    if (tree.roots.size() > 1) widgets::fact("Roots", grouped(tree.roots.size()));
    if (nothing_depends(facts)) widgets::fact("Dependency", "none: separate vessels");
    if (tree.loop_count > 0) widgets::fact("Loops", grouped(static_cast<std::uint64_t>(tree.loop_count)));
    if (const auto& edits = document.marks().edits; !edits.empty()) {
        widgets::fact("Edits", grouped(edits.size()));
        constexpr std::size_t kListed = 12; // the last ones
        const auto last = std::span(edits).last(std::min(edits.size(), kListed));
        widgets::tooltip(
            joined(last, "\n", [&](const tree::Edit& edit) { return lengths.worded(sentence(edit)); }).c_str());
    }
    draw_contacts_line(context);
    draw_doctor_line(context);
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

// An option that takes no number.
void draw_words(InterfaceContext& context, const SurfaceOption& option, const mesh::SurfaceOptions& options) {
    std::vector<std::pair<std::string, std::string>> entries;
    for (const OptionWord& word : option.words) entries.emplace_back(word.key, word.label);
    if (const auto chosen = widgets::choice_row(option.label.data(), option.tooltip.data(),
                                                spelled(option, option.value(options)), entries))
        context.perform("surface", {std::string(option.key), *chosen});
}

void draw_options(InterfaceContext& context) {
    const mesh::SurfaceOptions options = context.workspace.document.marks().options; // a choice changes it
    auto& sliders = context.interface.editing.options;
    for (const SurfaceOption& option : surface_options()) {
        if (option.label.empty()) continue;
        if (option.only_when_set && option.value(options) == option.value({})) continue;
        if (!option.words.empty()) {
            draw_words(context, option, options);
            continue;
        }
        widgets::Slider<float>& slider = sliders[option.key];
        const bool changed = widgets::slider_row(
            option.label.data(), option.tooltip.data(), slider, static_cast<float>(option.value(options)),
            [&](float& value) { draw_slider(option, value); }, [&](float value) { return as_text(option, value); });
        if (changed) context.perform("surface", {std::string(option.key), spelled(option, slider.value)});
    }
    mesh::SurfaceOptions tried = options;
    for (const SurfaceOption& option : surface_options())
        if (option.words.empty() && sliders[option.key].held)
            option.set(tried, std::stod(spelled(option, sliders[option.key].value)));
    context.workspace.try_options(tried == options ? std::nullopt : std::optional(tried));
}

void draw_surface(InterfaceContext& context) {
    widgets::section("Surface");
    draw_options(context);
    const std::string& problem = context.workspace.surface_problem();
    if (problem.empty()) return;
    widgets::trouble(problem == "cancelled" ? "Cancelled. Shown are the cones or an older surface." : problem.c_str());
    if (ImGui::Button("Compute again")) context.workspace.retry_surface();
}

void draw_one(const Document& document, const TreeFacts& facts, int id) {
    const auto index = static_cast<std::size_t>(id);
    const BranchFacts& own = facts.branches[index];
    const tree::Branch& branch = document.tree()->branches[index];
    widgets::fact("Branch", std::to_string(id));
    const std::string label = label_of(document.dependency(), document.marks(), id);
    if (!label.empty()) widgets::fact("Name", label);
    const std::string system = system_of(*document.tree(), document.marks(), id);
    if (!system.empty()) widgets::fact("System", system);
    const Lengths lengths = document.lengths();
    widgets::fact("Diameter", lengths.text(own.diameter_mm.mean));
    widgets::fact("  from \xE2\x80\x93 to", range(own.diameter_mm.min, own.diameter_mm.max, lengths));
    widgets::fact("Length", lengths.text(own.length_mm));
    widgets::fact("Generation", std::to_string(branch.generation));
    widgets::fact("Strahler order", std::to_string(branch.strahler));
    widgets::fact("Dependents", nothing_depends(facts) ? kNothingDepends
                                                       : grouped(static_cast<std::uint64_t>(own.dependents.branches)));
    widgets::fact("State", std::string(name_of(state_of(document.marks(), id))));
}

void draw_many(const Document& document, const TreeFacts& facts) {
    double length = 0.0;
    double least = 1e300;
    double most = 0.0;
    for (const int id : document.marks().selection) {
        const BranchFacts& own = facts.branches[static_cast<std::size_t>(id)];
        length += own.length_mm;
        least = std::min(least, own.diameter_mm.mean);
        most = std::max(most, own.diameter_mm.mean);
    }
    const auto selected = document.marks().selection.size();
    widgets::fact("Branches",
                  grouped(selected) + " of " + grouped(static_cast<std::uint64_t>(document.branch_count())));
    const Lengths lengths = document.lengths();
    widgets::fact("Length", lengths.text(length));
    widgets::fact("Mean diameters", range(least, most, lengths));
}

void draw_actions(InterfaceContext& context) {
    const float gap = ImGui::GetStyle().ItemSpacing.x * 0.5F;
    const float width = std::floor((ImGui::GetContentRegionAvail().x - 2.0F * gap) / 3.0F);
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {gap, gap});
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {2.0F * theme::scale(), 4.0F * theme::scale()});
    int column = 0;
    for (const char* name : {"select-dependents", "select-upstream", "highlight", "defocus", "hide", "show"}) {
        const Command& command = *find_command(name);
        if (column++ % 3 != 0) ImGui::SameLine();
        const std::string label = command.name == "show" ? "Show" : command.label;
        if (ImGui::Button(label.c_str(), {width, 0.0F})) context.perform(command);
        widgets::tooltip(command.help.c_str(), command.keys.front().c_str());
    }
    ImGui::PopStyleVar(2);
}

void draw_selection(InterfaceContext& context) {
    widgets::section("Selection");
    const Document& document = context.workspace.document;
    const auto& selection = document.marks().selection;
    if (selection.empty()) {
        widgets::quiet_wrapped("Click a vessel to select it; Alt+click takes all that depends on it.");
        return;
    }
    if (selection.size() == 1)
        draw_one(document, *context.workspace.facts(), selection.front());
    else
        draw_many(document, *context.workspace.facts());
    ImGui::Dummy({0.0F, 2.0F * theme::scale()});
    draw_actions(context);
}

// The two halves of the panel: what the tree is, and what is planned on it.
void draw_halves(InterfaceContext& context) {
    const float scale = theme::scale();
    ImGui::Dummy({0.0F, 4.0F * scale});
    const float width = std::floor(0.5F * ImGui::GetContentRegionAvail().x);
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {0.0F, 0.0F});
    for (const bool planning : {false, true}) {
        if (planning) ImGui::SameLine();
        const bool chosen = context.interface.planning == planning;
        const ImVec4 ground = chosen ? theme::kAccentDim : theme::kRaised;
        if (widgets::button(planning ? "Plan" : "Explore", {width, 0.0F}, ground,
                            chosen ? theme::kText : theme::kQuiet))
            context.perform("panel", {planning ? "plan" : "explore"});
        widgets::tooltip(planning ? "Lesions, cuts and measurements" : "Surface, selection and branches", "B");
    }
    ImGui::PopStyleVar();
}

// The edge towards the picture can be dragged.
void draw_edge(InterfaceContext& context, float width) {
    const float scale = theme::scale();
    const ImVec2 at = ImGui::GetWindowPos();
    const ImVec2 cursor = ImGui::GetCursorPos();
    ImGui::SetCursorScreenPos(at);
    ImGui::InvisibleButton("##edge", {6.0F * scale, ImGui::GetWindowHeight()});
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
    if (context.workspace.document.tree() && context.workspace.facts()) {
        draw_tree(context);
        draw_halves(context);
        if (context.interface.planning) {
            draw_plan(context);
        } else {
            draw_systems(context);
            draw_deviation(context); // what colours say, before what they are of
            draw_surface(context);
            draw_glass(context);
            draw_context(context);
            draw_compare(context);
            draw_selection(context);
            widgets::section("Branches");
            draw_branch_list(context);
        }
    } else {
        widgets::quiet_wrapped("What ramus knows of a tree appears here.");
    }
    ImGui::End();
}

} // namespace ramus::app
