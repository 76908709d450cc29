// The section of the vessel that slices follow: its way, the current place with the figures of the section there, the
// picture along it, and a stenosis.
#include "app/panels/along_plot.h"
#include "app/panels/choice_row.h"
#include "app/panels/plan_rows.h"
#include "app/panels/sections.h"
#include "app/panels/widgets.h"
#include "app/picture/along_picture.h"
#include "app/session/numbers.h"
#include "core/base/words.h"

#include <cctype>
#include <cmath>
#include <imgui.h>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace ramus::app {

namespace {

// Null until they are measured.
std::shared_ptr<const VesselSections> shown_sections(InterfaceContext& context) {
    const Assets& assets = context.workspace.current_assets();
    const auto& sections = assets.sections;
    return sections && sections->fits(assets.followed, context.workspace.shown().mesh) ? sections : nullptr;
}

void draw_way(InterfaceContext& context, const AlongVessel& along) {
    std::string words = way_words(along.way);
    words.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(words.front())));
    const int pressed = plan_rows::removable_row(words, theme::kText, "The way that slices follow; the cross ends it");
    if (pressed < 0) context.perform("along", {"off"});
    if (pressed > 0) context.perform("layout", {"along"});
}

void draw_along_place(InterfaceContext& context, const AlongVessel& along, const slice::VesselPath& path) {
    auto at = static_cast<float>(along.at_mm);
    widgets::begin_row("Place",
                       "Where the vessel is cut, from the start of the way; the wheel over its picture "
                       "moves it, too",
                       -64.0F * theme::scale());
    if (ImGui::SliderFloat("##place", &at, 0.0F, static_cast<float>(path.length_mm()), "",
                           ImGuiSliderFlags_AlwaysClamp))
        context.perform("along-at", {exact_text(static_cast<double>(at))});
    ImGui::SameLine();
    widgets::text_right(context.workspace.document().lengths().text(along.at_mm));
    ImGui::PopID();
}

void draw_figures(InterfaceContext& context, const AlongVessel& along, const VesselSections& sections) {
    const Lengths lengths = context.workspace.document().lengths();
    const std::size_t nearest = sections.path->nearest(along.at_mm);
    const auto& lumen = sections.lumens[nearest];
    const auto text = [&](const auto& value) { return lumen ? value(lumen->figures) : std::string("\xE2\x80\x93"); };
    using slice::ShapeFigures;
    widgets::fact("Area", text([&](const ShapeFigures& one) { return lengths.area(one.area_mm2); }));
    widgets::fact("Least, largest \xC3\x98", text([&](const ShapeFigures& one) {
                      return digits(one.least_mm) + ", " + lengths.text(one.largest_mm);
                  }));
    widgets::fact("Equivalent \xC3\x98",
                  text([&](const ShapeFigures& one) { return lengths.text(one.equivalent_mm); }));
    // Rows stay when the place moves.
    std::string state = "no wall around the axis";
    if (lumen && !lumen->closed) state = "wall is open here";
    if (lumen && lumen->closed) state = "closed";
    if (lumen && !lumen->shared_with.empty())
        state = "shared with " + joined(lumen->shared_with, ", ", [](int branch) { return std::to_string(branch); });
    widgets::fact("Section", widgets::fitted(state, 190.0F * theme::scale()));
}

void draw_look(InterfaceContext& context, const AlongVessel& along, const slice::VesselPath& path) {
    std::vector<std::pair<std::string, std::string>> kinds{{"straightened", "Straightened"},
                                                           {"stretched", "Stretched"}};
    if (const auto chosen = widgets::choice_row(
            "Picture",
            "Straightened: across and along the vessel, lengths are true. Stretched: the vessel keeps its bends",
            std::string(slice::name_of(along.kind)), kinds))
        context.perform("along-show", {*chosen});
    auto angle = static_cast<float>(along.angle_deg);
    widgets::begin_row("Rotation", "About the vessel's axis; Shift and dragging the picture turn it, too",
                       -64.0F * theme::scale());
    if (ImGui::SliderFloat("##rotation", &angle, -180.0F, 180.0F, "", ImGuiSliderFlags_AlwaysClamp))
        context.perform("along-show", {"--degrees", exact_text(static_cast<double>(angle))});
    ImGui::SameLine();
    widgets::text_right(rounded(std::round(along.angle_deg)) + "\xC2\xB0");
    ImGui::PopID();
    plan_rows::field_label(context, "Width, mm");
    const std::vector<std::string> typed =
        plan_rows::number_field(context, "along width", digits(along.width_mm.value_or(usual_width_mm(path))), 60.0F);
    if (typed.size() == 1) context.perform("along-show", {"--width", typed[0]});
}

// The arguments of `stenosis` for a choice.
std::vector<std::string> stenosis_arguments(const StenosisChoice& choice) {
    std::vector<std::string> words{exact_text(choice.where.from_mm), exact_text(choice.where.to_mm)};
    if (choice.reference_mm) {
        words.insert(words.end(), {"--diameter", exact_text(*choice.reference_mm)});
    } else if (choice.reference) {
        const std::string from = exact_text(choice.reference->from_mm);
        const bool place = choice.reference->from_mm == choice.reference->to_mm;
        words.insert(words.end(), {"--reference", place ? from : from + ".." + exact_text(choice.reference->to_mm)});
    }
    return words;
}

void draw_percents(InterfaceContext& context, const VesselSections& sections, const StenosisChoice& choice) {
    const auto places = narrow_places(sections, choice);
    if (!places) return widgets::quiet_wrapped(places.error().message().c_str());
    const Lengths lengths = context.workspace.document().lengths();
    const auto row = [&](const char* label, const slice::Narrowing& narrowing, const std::string& least,
                         const std::string& reference) {
        widgets::fact(label, digits(narrowing.percent) + " %");
        const std::string details =
            least + " against " + reference + ", at " + lengths.text(sections.path->samples[narrowing.sample].arc_mm);
        widgets::quiet_right(details);
    };
    const auto figures = [&](const slice::Narrowing& narrowing) -> const slice::ShapeFigures& {
        return *sections.figures[narrowing.sample];
    };
    const slice::Stenosis& found = places->found;
    row("Less by least \xC3\x98", found.least_diameter, digits(figures(found.least_diameter).least_mm),
        lengths.text(places->reference.least_mm));
    row("Less by area", found.area, digits(figures(found.area).area_mm2), lengths.area(places->reference.area_mm2));
}

// Without the ends of free vessels, which taper.
Stretch inner_stretch(const slice::VesselPath& path, const VesselSections* sections) {
    if (sections == nullptr) return {0.0, path.length_mm()};
    const std::vector<slice::PathSample>& samples = sections->path->samples;
    return {samples[sections->inner.first].arc_mm, samples[sections->inner.last].arc_mm};
}

void draw_stenosis(InterfaceContext& context, const AlongVessel& along, const slice::VesselPath& path,
                   const VesselSections* sections) {
    widgets::quiet("Stenosis");
    const double here = along.at_mm;
    StenosisChoice choice = along.stenosis.value_or(StenosisChoice{inner_stretch(path, sections)});
    const auto set = [&](const StenosisChoice& next) { context.perform("stenosis", stenosis_arguments(next)); };
    if (widgets::small_button("From here", "The stenosis begins at the current place")) {
        choice.where.from_mm = here;
        set(choice);
    }
    ImGui::SameLine();
    if (widgets::small_button("To here", "The stenosis ends at the current place")) {
        choice.where.to_mm = here;
        set(choice);
    }
    ImGui::SameLine();
    if (widgets::small_button("Reference here", "The section at the current place is what others are compared with")) {
        choice.reference = Stretch{here, here};
        choice.reference_mm.reset();
        set(choice);
    }
    plan_rows::field_label(context, "Or reference \xC3\x98, mm");
    const std::vector<std::string> typed = plan_rows::number_field(
        context, "reference diameter", choice.reference_mm ? digits(*choice.reference_mm) : "", 60.0F);
    if (const auto diameter = typed.size() == 1 ? parsed<double>(typed[0]) : std::nullopt) {
        choice.reference_mm = diameter;
        choice.reference.reset();
        set(choice);
    }
    if (!along.stenosis) return;
    const Lengths lengths = context.workspace.document().lengths();
    const std::string between =
        "Between " + digits(along.stenosis->where.from_mm) + " and " + lengths.text(along.stenosis->where.to_mm);
    if (plan_rows::removable_row(between, theme::kText,
                                 "Where the narrowest section is; the cross ends the comparison") < 0)
        context.perform("stenosis", {"off"});
    if (!along.stenosis->reference && !along.stenosis->reference_mm)
        return widgets::quiet_wrapped("Set a reference: go to a place that is not narrowed.");
    if (sections != nullptr) draw_percents(context, *sections, *along.stenosis);
}

} // namespace

void draw_along(InterfaceContext& context) {
    if (!draw_section(context, "Along a vessel",
                      {{"Selected", "Follow the selected branch in slices", "along"},
                       {"From root", "Follow the way from the root to the selected branch in slices", "along-root"}}))
        return;
    const auto along = context.workspace.document().session().slices.along; // a copy: commands change it
    if (!along)
        return widgets::quiet_wrapped("Select a branch and follow it: sections across the vessel with their figures, "
                                      "and a picture along it.");
    // A person who follows another vessel wants to see its figures. They make the section longer, so that it can be
    // scrolled farther.
    AlongPlot& plot = context.interface.of<AlongPlot>();
    const auto sections = shown_sections(context);
    if (std::exchange(plot.shown, along->way) != along->way) plot.scrolls = 3;
    if (sections && std::exchange(plot.measured, along->way) != along->way) plot.scrolls = 3;
    if (plot.scrolls > 0) {
        --plot.scrolls;
        ImGui::SetScrollHereY(0.05F);
    }
    draw_way(context, *along);
    const FollowedPath followed = context.workspace.current_assets().followed;
    if (!followed.path) return widgets::trouble(followed.problem.c_str());
    draw_along_place(context, *along, *followed.path);
    if (sections) {
        draw_along_plot(context, *sections);
        draw_figures(context, *along, *sections);
    } else if (context.workspace.awaited(WorkKind::kSections)) {
        widgets::quiet(
            ("Measuring sections: " + widgets::percent_text(context.workspace.progress(WorkKind::kSections))).c_str());
    } else if (const std::string problem = context.workspace.problem(WorkKind::kSections); !problem.empty()) {
        widgets::trouble(("No sections: " + problem).c_str());
        if (widgets::small_button("Measure again", "Measure the cross-sections again"))
            context.workspace.retry(WorkKind::kSections);
    }
    draw_look(context, *along, *followed.path);
    draw_stenosis(context, *along, *followed.path, sections.get());
    if (widgets::small_button("Save sections\xE2\x80\xA6", "Write a table of the cross-sections"))
        context.perform("sections", {});
}

} // namespace ramus::app
