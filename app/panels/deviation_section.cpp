// The section of deviation: the reference surface, the colour scale, and the measured values.
#include "app/panels/choice_row.h"
#include "app/panels/parts.h"
#include "app/panels/sections.h"
#include "app/panels/widgets.h"
#include "app/picture/deviation_colours.h"
#include "app/session/numbers.h"

#include <algorithm>
#include <filesystem>
#include <imgui.h>
#include <string>
#include <utility>
#include <vector>

namespace ramus::app {

namespace {

using From = DeviationChoice::From;
using Unit = DeviationChoice::Unit;
using Mode = Comparison::Mode;

void draw_from(InterfaceContext& context, const DeviationChoice& choice) {
    std::vector<std::pair<std::string, std::string>> entries{{"cones", "Truncated cones"}, {"iso", "Isosurface"}};
    if (choice.from == From::kFile)
        entries.emplace_back("this", std::filesystem::path(choice.file).filename().string());
    entries.emplace_back("file", "Choose a file\xE2\x80\xA6");
    const std::string now = choice.from == From::kCones ? "cones" : choice.from == From::kFile ? "this" : "iso";
    const auto chosen = widgets::choice_row("From", "The surface that distances are measured to", now, entries);
    if (!chosen || *chosen == now) return;
    if (*chosen == "file")
        context.perform("deviation-from", {});
    else
        context.perform("deviation-from", {*chosen});
}

std::string words_of(double most, Unit unit) {
    return rounded(most) + (unit == Unit::kMm ? " mm" : most == 1.0 ? " voxel diagonal" : " voxel diagonals");
}

void draw_scale(InterfaceContext& context, const DeviationChoice& choice) {
    using Entry = std::pair<double, Unit>;
    // At most as many as an open list shows without scrolling.
    std::vector<Entry> ends{{0.0, Unit::kMm}, {0.1, Unit::kMm}, {0.5, Unit::kMm}, {1.0, Unit::kMm}};
    if (may_count_voxels(choice.from))
        ends.insert(ends.end(),
                    {{0.0, Unit::kVoxels}, {0.5, Unit::kVoxels}, {1.0, Unit::kVoxels}, {2.0, Unit::kVoxels}});
    const Entry now{choice.most, choice.unit};
    if (std::ranges::find(ends, now) == ends.end()) ends.push_back(now);
    std::vector<std::pair<std::string, std::string>> entries;
    for (const auto& [most, unit] : ends)
        entries.emplace_back(
            (most > 0.0 ? rounded(most) : "auto") + " " + std::string(name_of(unit)),
            most > 0.0 ? "Up to " + words_of(most, unit)
                       : std::string(unit == Unit::kMm ? "Automatic, in mm" : "Automatic, in voxel diagonals"));
    const auto at = static_cast<std::size_t>(std::ranges::find(ends, now) - ends.begin());
    const auto chosen = widgets::choice_row(
        "Scale", "Where the colours end; automatic: 99 % of the distances lie below", entries[at].first, entries);
    if (!chosen || *chosen == entries[at].first) return;
    const std::size_t blank = chosen->find(' ');
    context.perform("deviation-scale", {chosen->substr(0, blank), chosen->substr(blank + 1)});
}

// Surfaces of the session are superimposed by the comparison, a file as context.
void draw_lines(InterfaceContext& context, const Marks& marks) {
    const auto item = std::ranges::find_if(marks.context, [&](const ContextItem& each) {
        return each.file == marks.deviation.file && each.wireframe && each.visible;
    });
    const bool file = marks.deviation.from == From::kFile;
    const Compared other = marks.deviation.from == From::kCones ? Compared::kTruncatedCones : Compared::kIsosurface;
    const Comparison& comparison = marks.comparison;
    bool shown =
        file ? item != marks.context.end() : comparison.mode == Mode::kSuperimposed && comparison.surfaces[1] == other;
    const auto number = item - marks.context.begin() + 1;
    const bool own_is_other = !file && is_own(other, marks.options);
    ImGui::BeginDisabled(own_is_other);
    if (ImGui::Checkbox("As lines over the surface", &shown)) {
        if (!file && shown)
            context.perform("compare",
                            {std::string(name_of(Mode::kSuperimposed)),
                             std::string(name_of(compared(marks.options.method))) + "," + std::string(name_of(other))});
        else if (!file)
            context.perform("compare", {std::string(name_of(Mode::kOff))});
        else if (shown)
            context.perform("context", {marks.deviation.file, "--wireframe"});
        else
            context.perform("context-remove", {std::to_string(number)});
    }
    ImGui::EndDisabled();
    widgets::tooltip("The surface that distances are measured to, superimposed as lines");
}

// Whether the picture still shows the previous legend, whose meaning the new figures would contradict.
bool legend_is_before(const Interface& interface, const Marks& marks, const SurfaceDeviation& found) {
    render::Frame frame;
    show_deviation(frame, marks, &found);
    return !interface.legends.empty() &&
           std::ranges::find(interface.legends, frame.overlays.legend) == interface.legends.end();
}

void draw_found(const InterfaceContext& context, const Marks& marks) {
    const Workspace& workspace = context.workspace;
    const SurfaceDeviation& found = workspace.assets().deviation;
    if (!found.trouble.empty()) return widgets::trouble(window_words(found.trouble).c_str());
    if (!found.fits(deviation_of(workspace.document().tree(), marks, marks.options), workspace.shown().mesh))
        return widgets::quiet("Measuring\xE2\x80\xA6");
    if (legend_is_before(context.interface, marks, found)) return widgets::quiet("Drawing\xE2\x80\xA6");
    const double unit = mm_per_unit(marks.deviation, found);
    const std::string name = unit == 1.0 ? " mm" : " voxel diag.";
    widgets::fact("Mean", digits(found.mean_mm / unit) + name);
    widgets::fact("95 % below", digits(found.percentile_95_mm / unit) + name);
    widgets::fact("Largest", digits(found.most_mm / unit) + name);
}

} // namespace

void draw_deviation(InterfaceContext& context) {
    const Marks marks = context.workspace.document().marks(); // a choice changes it
    if (marks.colour_by != ColourBy::kDeviation) return;
    widgets::section("Deviation");
    draw_from(context, marks.deviation);
    if (marks.deviation.from == From::kIsosurface) draw_mask_row(context, marks.comparison);
    draw_scale(context, marks.deviation);
    draw_found(context, marks);
    draw_lines(context, marks);
}

} // namespace ramus::app
