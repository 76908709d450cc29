// The validation panel at the left edge of the picture: the questions, a row per place, how well the surface follows
// the tree as read, and the radius along the selected branch. A click moves the camera to the place and selects its
// branches.
#include "app/panels/validation_panel.h"

#include "app/panels/left_panel.h"
#include "app/panels/parts.h"
#include "app/panels/theme.h"
#include "app/panels/validation_plot.h"
#include "app/panels/widgets.h"
#include "app/session/numbers.h"
#include "core/base/words.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <imgui.h>
#include <optional>
#include <string>

namespace ramus::app {

namespace {

using Kind = Finding::Kind;

struct Question {
    Kind kind;
    const char* text;
    const char* of_one; // in the list
    const char* help;
};
constexpr std::array<Question, kFindingKinds> kQuestions{
    {{Kind::kLost, "Lost branches", "lost", "Stretches of centerlines that the surface leaves out"},
     {Kind::kFalse, "False branches", "false", "Parts of the surface that are of no vessel"},
     {Kind::kMerged, "Merged branches", "merged", "Vessels that pass each other, and are one in the surface"},
     {Kind::kConstriction, "Changed constrictions", "narrow", "Narrow places whose radius is off by more than 10 %"},
     {Kind::kWidth, "Changed widths", "width",
      "Stretches of a branch that are wider or narrower than in the tree by more than 10 %"},
     {Kind::kPosition, "Moved branches", "position",
      "Stretches whose axis is off the tree's centerline by more than a third of the radius"},
     {Kind::kRadius, "Worst radii", "radius", "Where the radius is farthest off: ten branches at the most"}}};

void draw_answers(const std::vector<Finding>& findings) {
    widgets::row_headings({"Question", "What the surface is asked"}, {"Found", "How many places answer with yes"});
    for (const Question& question : kQuestions) {
        if (question.kind == Kind::kRadius) continue; // not one of the questions
        const auto count = std::ranges::count(findings, question.kind, &Finding::kind);
        ImGui::TextUnformatted(question.text);
        widgets::tooltip(question.help);
        ImGui::SameLine();
        const std::string answer = count == 0 ? "none" : grouped(static_cast<std::uint64_t>(count));
        widgets::align_right(ImGui::CalcTextSize(answer.c_str()).x);
        ImGui::TextColored(count == 0 ? theme::kGood : theme::kHighlight, "%s", answer.c_str());
    }
}

std::string percent(double share) { return digits(100.0 * share, 2) + " %"; }

// How well the surface follows the tree as it was read.
void draw_fidelity(const validate::Validation& found, const Lengths& lengths) {
    const validate::Fidelity& fidelity = found.fidelity;
    widgets::fact("Points outside of the surface", grouped(fidelity.outside) + " of " + grouped(fidelity.points));
    if (found.radius_error.places == 0) return widgets::quiet("No place is alone enough to compare radii and axes.");
    widgets::fact("Axis off the centerline, median", lengths.text(fidelity.offset_median_mm));
    widgets::fact("    95 % below", lengths.text(fidelity.offset_p95_mm));
    widgets::fact("    at most", lengths.text(fidelity.offset_max_mm));
    widgets::fact("Error of the radius, median", percent(found.radius_error.median));
    widgets::fact("    95 % below", percent(found.radius_error.p95));
}

// Where vessels have merged or come apart, numbers of pieces or loops differ from the tree's.
void draw_shape(const std::optional<validate::Shape>& shape) {
    if (!shape) return;
    const auto row = [](const char* label, const char* help, std::int64_t surface, std::int64_t tree) {
        ImGui::TextUnformatted(label);
        widgets::tooltip(help);
        ImGui::SameLine();
        const std::string of_surface = grouped(static_cast<std::uint64_t>(surface));
        const std::string text = surface == tree
                                     ? of_surface + ", as the tree"
                                     : of_surface + "; the tree has " + grouped(static_cast<std::uint64_t>(tree));
        widgets::align_right(ImGui::CalcTextSize(text.c_str()).x);
        ImGui::TextColored(surface == tree ? theme::kGood : theme::kHighlight, "%s", text.c_str());
    };
    row("Pieces", "How many connected pieces the surface has", shape->surface.pieces, shape->tree.pieces);
    row("Loops", "Ways around that the surface has: one more than the tree is a connection that the tree has not",
        shape->surface.loops, shape->tree.loops);
}

std::string branches_text(const Finding& finding) {
    return finding.branches.empty() ? "\xE2\x80\x93"
                                    : joined(finding.branches, " \xC2\xB7 ", [](int id) { return std::to_string(id); });
}

void draw_finding(InterfaceContext& context, const Finding& finding, std::size_t index) {
    const std::string number = std::to_string(index + 1), name = "Finding " + number;
    ImGui::TableNextRow();
    ImGui::TableSetColumnIndex(0);
    const bool current = context.interface.of<ValidationList>().current == static_cast<int>(index);
    if (ImGui::Selectable((number + "##" + name).c_str(), current, ImGuiSelectableFlags_SpanAllColumns))
        context.perform("finding", {number});
    widgets::note_item(name.c_str());
    const Question& question = kQuestions[static_cast<std::size_t>(finding.kind)];
    if (ImGui::IsItemHovered()) {
        if (!finding.branches.empty()) context.interface.listed = finding.branches.front();
        widgets::tooltip((std::string(question.help) + "\n" + text_of(finding, context.workspace.document().lengths()) +
                          "\nClick to look at the place and to select its branches")
                             .c_str());
    }
    ImGui::TableSetColumnIndex(1);
    ImGui::TextUnformatted(question.of_one);
    ImGui::TableSetColumnIndex(2);
    ImGui::TextUnformatted(branches_text(finding).c_str());
    ImGui::TableSetColumnIndex(3);
    ImGui::TextUnformatted(text_of(finding, context.workspace.document().lengths()).c_str());
}

void draw_findings(InterfaceContext& context, const std::vector<Finding>& list, float bottom) {
    constexpr std::array<widgets::ListColumn, 4> kColumns{{{"No.", 0.28F, "The number of the finding"},
                                                           {"What", 0.62F, "Which question it answers"},
                                                           {"Branches", 1.0F, "The ids of its branches"},
                                                           {"Found", 2.1F, "What is wrong there, with its size"}}};
    if (!widgets::begin_list({.id = "findings", .columns = kColumns, .most_rows = 12, .bottom = bottom}, list.size()))
        return;
    widgets::clipped(list.size(), [&](std::size_t n) { draw_finding(context, list[n], n); });
    widgets::end_list();
}

// Whether the list belongs to the current tree and surface, and if not, what happens next.
void draw_state(InterfaceContext& context, bool anything, bool fits) {
    Workspace& workspace = context.workspace;
    if (fits) return;
    if (anything) {
        ImGui::PushStyleColor(ImGuiCol_Text, theme::kHighlight);
        ImGui::TextWrapped("Out of date: the tree or its surface has changed since.");
        ImGui::PopStyleColor();
        widgets::note_item("Out of date");
    }
    if (!workspace.problem(WorkKind::kValidation).empty()) {
        widgets::trouble(("Not validated: " + workspace.problem(WorkKind::kValidation)).c_str());
        if (widgets::small_button("Try again", "Compares the surface with the tree again"))
            workspace.retry(WorkKind::kValidation);
        return;
    }
    const std::string done = workspace.awaited(WorkKind::kValidation)
                                 ? " " + widgets::percent_text(workspace.progress(WorkKind::kValidation))
                                 : "";
    widgets::quiet(("Comparing the surface with the tree\xE2\x80\xA6" + done).c_str());
}

} // namespace

void draw_validation(InterfaceContext& context) {
    ValidationList& panel = context.interface.of<ValidationList>();
    context.workspace.want_validation(context.interface.left_is<ValidationList>());
    if (!context.interface.left_is<ValidationList>() || !context.workspace.document().tree()) return;
    const float bottom = begin_left_panel("validation", context);
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted("Validation");
    widgets::tooltip("The surface of all branches, compared with the tree that it is made of");
    ImGui::SameLine();
    widgets::align_right(ImGui::CalcTextSize("Close").x + 14.0F * theme::scale());
    if (widgets::small_button("Close", "Hides the validation; Shift+V shows it again")) context.interface.close_left();
    widgets::rule();
    const TreeValidation now = context.workspace.current_assets().validation; // a copy: actions may replace it
    if (panel.of != now.findings) panel.current = -1;                         // `current` is an index into the old list
    panel.of = now.findings;
    const Document& document = context.workspace.document();
    const bool fits = now.fits(validation_of(document.tree(), document.marks()));
    draw_state(context, now.found != nullptr, fits);
    if (now.found) {
        ImGui::BeginDisabled(!fits);
        draw_answers(*now.findings);
        draw_shape(now.found->shape);
        draw_fidelity(*now.found, document.lengths());
        widgets::rule();
        draw_radius_plot(document, now, fits, panel.current);
        if (!now.findings->empty()) {
            widgets::rule();
            draw_findings(context, *now.findings, bottom);
        }
        ImGui::EndDisabled();
    }
    ImGui::End();
}

} // namespace ramus::app
