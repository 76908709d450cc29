// The section of comparisons: which surfaces are shown together, and the skeleton.
#include "app/panels/choice_row.h"
#include "app/panels/editing.h"
#include "app/panels/parts.h"
#include "app/panels/sections.h"
#include "app/panels/widgets.h"
#include "app/session/numbers.h"
#include "core/base/words.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <imgui.h>
#include <optional>
#include <string>

namespace ramus::app {

namespace {

using Mode = Comparison::Mode;

constexpr std::array kModes{std::pair{Mode::kOff, "Off"}, std::pair{Mode::kSideBySide, "Side by side"},
                            std::pair{Mode::kBlend, "Blend"}, std::pair{Mode::kSuperimposed, "Superimposed"},
                            std::pair{Mode::kWipe, "Split by a line"}};

const char* label_of_kind(Compared kind) { return row_of(kind).label.data(); } // of a literal: ends in 0

// An entry of an open list.
bool selectable(const char* text, bool chosen) {
    const bool pressed = ImGui::Selectable(text, chosen);
    widgets::note_item(text);
    return pressed;
}

std::string surfaces_word(const std::vector<Compared>& surfaces) {
    return joined(surfaces, ",", [](Compared kind) { return name_of(kind); });
}

// The compared surface at `index`. Choosing one that is compared already swaps the two; the third may be none.
void draw_surface_row(InterfaceContext& context, const Comparison& comparison, std::size_t index, const char* label,
                      const char* help, bool may_be_none) {
    const std::vector<Compared>& now = comparison.surfaces;
    const bool there = index < now.size();
    std::optional<std::vector<Compared>> wanted;
    widgets::begin_row(label, help);
    if (ImGui::BeginCombo("##surface", there ? label_of_kind(now[index]) : "None")) {
        for (const ComparedRow& row : kCompared) {
            const Compared kind = row.kind;
            if (!selectable(label_of_kind(kind), there && now[index] == kind)) continue;
            std::vector<Compared> next = now;
            const auto other = std::ranges::find(next, kind);
            if (!there && other == next.end())
                next.push_back(kind);
            else if (there && other != next.end())
                std::swap(*other, next[index]);
            else if (there)
                next[index] = kind;
            if (next != now) wanted = next;
        }
        if (may_be_none && selectable("None", !there) && there)
            wanted = std::vector<Compared>(now.begin(), now.begin() + static_cast<std::ptrdiff_t>(index));
        ImGui::EndCombo();
    }
    ImGui::PopID();
    if (wanted) context.perform("compare", {std::string(name_of(comparison.mode)), surfaces_word(*wanted)});
}

} // namespace

void draw_mask_row(InterfaceContext& context, const Comparison& comparison) {
    widgets::begin_row("Mask", "The segmentation that the isosurface is of");
    const bool there = !comparison.mask.empty();
    const float available = ImGui::GetContentRegionAvail().x;
    const float clear = ImGui::GetFrameHeight();
    const float width = there ? available - clear - ImGui::GetStyle().ItemSpacing.x : available;
    const std::string name = there ? std::filesystem::path(comparison.mask).filename().string() : "Choose...";
    const std::string shown = widgets::fitted(name, width - 2.0F * ImGui::GetStyle().FramePadding.x);
    if (ImGui::Button((shown + "##mask").c_str(), {width, 0.0F})) context.perform("compare-mask", {});
    widgets::tooltip(there ? comparison.mask.c_str() : "Until a mask is chosen, it is one of the tree's own voxels");
    if (there) {
        ImGui::SameLine();
        if (ImGui::Button("\xC3\x97", {clear, 0.0F})) context.perform("compare-mask", {"none"});
        widgets::tooltip("The tree's own voxels instead");
    }
    ImGui::PopID();
}

void draw_compare(InterfaceContext& context) {
    const Comparison comparison = context.workspace.document().marks().comparison;
    context.interface.tried_blend.reset();
    if (!context.interface.wipe_held) context.interface.tried_wipe.reset();
    widgets::section("Compare");
    widgets::begin_row("Surfaces", "Surfaces of the same vessels, seen together");
    const auto mode = std::ranges::find(kModes, comparison.mode, [](const auto& each) { return each.first; });
    if (ImGui::BeginCombo("##mode", mode == kModes.end() ? "" : mode->second)) {
        for (const auto& [each, label] : kModes)
            if (selectable(label, each == comparison.mode) && each != comparison.mode)
                context.perform("compare", {std::string(name_of(each))});
        ImGui::EndCombo();
    }
    ImGui::PopID();
    if (comparison.mode != Mode::kOff) {
        const bool beside = comparison.mode == Mode::kSideBySide;
        draw_surface_row(context, comparison, 0, "First", "The first surface", false);
        draw_surface_row(context, comparison, 1, "Second",
                         comparison.mode == Mode::kSuperimposed ? "The surface that is drawn as lines over it"
                                                                : "The surface that it is compared with",
                         false);
        if (beside) draw_surface_row(context, comparison, 2, "Third", "A third surface", true);
        const auto shown = compared_surfaces(comparison);
        if (std::ranges::find(shown, Compared::kIsosurface) != shown.end()) draw_mask_row(context, comparison);
        if (comparison.mode == Mode::kBlend) {
            widgets::Slider<float>& blend = context.interface.of<Editing>().blend;
            const bool changed =
                widgets::share_row("Share", "How much there is of the second surface", blend, comparison.blend);
            if (blend.held) context.interface.tried_blend = blend.value;
            if (changed) context.perform("compare-blend", {digits(blend.value, 4)});
        }
        if (comparison.mode == Mode::kWipe) {
            widgets::Slider<float>& wipe = context.interface.of<Editing>().wipe;
            const bool changed = widgets::share_row(
                "Line", "Where the line is, of the picture's width; it is dragged in the picture too", wipe,
                comparison.wipe);
            if (wipe.held) context.interface.tried_wipe = wipe.value;
            if (changed) context.perform("compare-wipe", {digits(wipe.value, 4)});
        }
        if (const std::string problem = context.workspace.problem(WorkKind::kComparison); !problem.empty())
            widgets::trouble(window_words(problem).c_str());
    }
    bool skeleton = context.workspace.document().marks().skeleton;
    if (ImGui::Checkbox("Skeleton with radii", &skeleton)) context.perform("skeleton", {skeleton ? "on" : "off"});
    widgets::tooltip("Centerlines, and rings of the radius, over the vessels");
}

} // namespace ramus::app
