// The organ on the planning page: its volume, what the cuts leave of it, the patient's size, its territories.
#include "app/assets/organ_text.h"
#include "app/assets/territories.h"
#include "app/panels/choice_row.h"
#include "app/panels/editing.h"
#include "app/panels/plan_rows.h"
#include "app/panels/row_buttons.h"
#include "app/panels/sections.h"
#include "app/panels/theme.h"
#include "app/panels/widgets.h"
#include "app/picture/territories.h"
#include "app/session/numbers.h"
#include "app/session/systems.h"
#include "app/session/window_words.h"

#include <algorithm>
#include <filesystem>
#include <imgui.h>
#include <string>
#include <utility>
#include <vector>

namespace ramus::app {

namespace {

void draw_mask(InterfaceContext& context, const OrganChoice& choice) {
    const OrganAssets& assets = context.workspace.assets().organ;
    const bool is_read = assets.source == choice.source;
    const bool trouble = is_read && !assets.mask.value;
    std::string name = std::filesystem::path(choice.source.file).filename().string();
    for (const volume::LabelChoice& label : choice.source.labels) name += "  " + spelled(label);
    const std::string help = choice.source.file + (trouble ? "\n" + assets.mask.value.error().message() : "");
    const int done = plan_rows::removable_row(name, trouble ? theme::kTrouble : theme::kText, help.c_str());
    if (done < 0) context.perform("organ-clear", {});
    if (done > 0) context.perform("organ", {});
    if (trouble && ImGui::Button("Read again")) {
        context.workspace.assets().organ = {}; // so that it is missing
        context.workspace.retry(WorkKind::kOrgan);
    }
}

void draw_figures(InterfaceContext& context, const Marks& marks) {
    const Workspace& workspace = context.workspace;
    for (const WorkKind kind : {WorkKind::kOrgan, WorkKind::kSupply, WorkKind::kResectionMeshes, WorkKind::kOperation})
        if (const std::string problem = workspace.problem(kind); !problem.empty())
            return widgets::trouble(window_words(problem).c_str());
    const auto operation = operation_of(workspace.assets(), marks, marks.plans.place, OperationOf::kLast);
    const bool waits = workspace.awaited(WorkKind::kOrgan) || workspace.awaited(WorkKind::kSupply);
    if (!operation || waits) {
        if (workspace.document().tree()) widgets::quiet(waits ? "Dividing the organ\xE2\x80\xA6" : "");
        return;
    }
    for (const OrganFact& fact : organ_facts(*operation, marks)) {
        widgets::fact(fact.label.c_str(), fact.value(Lengths(operation->of.supply->of.mask->claims)));
        widgets::tooltip(fact.help.c_str());
    }
}

void draw_patient(InterfaceContext& context, const OrganChoice& choice) {
    const auto text = [](double number) { return number > 0.0 ? rounded(number) : std::string(); };
    const auto field = [&](const char* label, const char* help, const char* id, double now, double other, bool first) {
        plan_rows::field_label(context, label);
        auto words = plan_rows::number_field(context, id, text(now), 56.0F);
        widgets::tooltip(help);
        if (words.size() != 1) return;
        const std::string rest = rounded(other);
        context.perform("organ-patient", first ? std::vector{words[0], rest} : std::vector{rest, words[0]});
    };
    field("Patient's weight (kg)", "What remains is compared with the body's weight; 0: unknown", "patient-kg",
          choice.weight_kg, choice.height_cm, true);
    field("Patient's height (cm)", "With the weight it gives the standard volume of a liver; 0: unknown", "patient-cm",
          choice.height_cm, choice.weight_kg, false);
}

// What each vessel system does for the organ.
void draw_roles(InterfaceContext& context, const Marks& marks) {
    const tree::VesselTree& tree = *context.workspace.document().tree();
    const std::vector<organ::Role> roles = roles_of(tree, marks);
    const Systems& systems = systems_of(tree, marks);
    for (std::size_t system = 0; system < systems.size(); ++system) {
        const std::string now = roles[system] == organ::Role::kDrains ? "drains" : "supplies";
        const std::string name = system_name(systems, static_cast<int>(system));
        ImGui::PushID(static_cast<int>(system));
        const auto chosen = widgets::choice_row(widgets::fitted(name, 90.0F * theme::scale()).c_str(),
                                                (name + ": what it does for the organ").c_str(), now,
                                                {{"supplies", "Supplies the organ"}, {"drains", "Drains the organ"}});
        ImGui::PopID();
        if (chosen && *chosen != now) context.perform("organ-role", {std::to_string(system + 1), *chosen});
    }
}

constexpr int kMostGenerations = 4; // that the list offers; the command takes any

void draw_choice(InterfaceContext& context, const Marks& marks) {
    std::vector<std::pair<std::string, std::string>> entries{
        {"off", "None"}, {"organ", "Whole organ"}, {"systems", "Of vessel systems"}};
    const auto generation = [](int number) { return "generation " + std::to_string(number); };
    for (int number = 1; number <= kMostGenerations; ++number)
        entries.emplace_back(generation(number), "Of generation " + std::to_string(number));
    entries.insert(entries.end(), {{"names", "Of named branches"},
                                   {"selection", "Of the selected branches"},
                                   {"cuts", "Of cuts"},
                                   {"remnant", "What remains after cuts"}});
    std::string now(name_of(marks.organ.territories));
    if (marks.organ.territories == TerritoriesOf::kGeneration) {
        now = generation(marks.organ.generation);
        if (marks.organ.generation < 1 || marks.organ.generation > kMostGenerations)
            entries.emplace_back(now, "Of generation " + std::to_string(marks.organ.generation));
    }
    const auto chosen =
        widgets::choice_row("Show", "The parts of the organ by the branches that supply or drain them", now, entries);
    if (!chosen || *chosen == now) return;
    const std::size_t blank = chosen->find(' ');
    if (blank == std::string::npos) return context.perform("territories", {*chosen});
    context.perform("territories", {chosen->substr(0, blank), chosen->substr(blank + 1)});
}

// Whose branches divide the organ, where several systems could.
void draw_system(InterfaceContext& context, const Marks& marks) {
    const tree::VesselTree& tree = *context.workspace.document().tree();
    const OrganChoice& choice = marks.organ;
    if (tree.systems.size() < 2 ||
        (choice.territories != TerritoriesOf::kGeneration && choice.territories != TerritoriesOf::kNames &&
         choice.territories != TerritoriesOf::kSelection))
        return;
    const auto& shown = context.workspace.assets().organ.territories;
    std::vector<std::pair<std::string, std::string>> entries;
    for (std::size_t system = 0; system < tree.systems.size(); ++system)
        entries.emplace_back(std::to_string(system + 1),
                             system_name(systems_of(tree, marks), static_cast<int>(system)));
    const int system = choice.system >= 0 ? choice.system : shown ? shown->of.system : 0;
    const auto chosen =
        widgets::choice_row("System", "Whose branches divide the organ", std::to_string(system + 1), entries);
    if (!chosen) return;
    std::vector<std::string> words{std::string(name_of(choice.territories))};
    if (choice.territories == TerritoriesOf::kGeneration) words.push_back(std::to_string(choice.generation));
    words.insert(words.end(), {"--system", *chosen});
    context.perform("territories", words);
}

void draw_parts(InterfaceContext& context, const Marks& marks) {
    if (const std::string problem = context.workspace.problem(WorkKind::kTerritories); !problem.empty())
        return widgets::trouble(window_words(problem).c_str());
    const auto territories = context.workspace.assets().organ.territories;
    if (!territories) return;
    const Lengths lengths(territories->of.supply->of.mask->claims);
    widgets::clipped(territories->parts.size(), [&](std::size_t n) {
        const OrganTerritories::Part& part = territories->parts[n];
        const glm::vec3 colour = territory_colour(*territories, n, marks);
        const float size = ImGui::GetTextLineHeight();
        ImGui::PushID(static_cast<int>(n));
        const bool shown = !std::ranges::binary_search(marks.organ.hidden, part.name);
        if (widgets::eye_button(shown, shown ? "Hide" : "Show"))
            context.perform(shown ? "territory-hide" : "territory-show", {part.name});
        ImGui::PopID();
        ImGui::SameLine(0.0F, 2.0F * theme::scale());
        ImGui::BeginGroup();
        ImGui::AlignTextToFramePadding();
        ImVec2 at = ImGui::GetCursorScreenPos();
        at.y += ImGui::GetStyle().FramePadding.y;
        widgets::patch(at, colour);
        ImGui::SetCursorScreenPos({at.x + size, at.y - ImGui::GetStyle().FramePadding.y});
        ImGui::AlignTextToFramePadding();
        const std::string value =
            lengths.volume(territories->volume_mm3(part)) + ", " + digits(territories->percent(part)) + " %";
        const float room = ImGui::GetContentRegionAvail().x - ImGui::CalcTextSize(value.c_str()).x - size;
        widgets::fact(widgets::fitted(part.name, room).c_str(), value);
        ImGui::EndGroup();
        widgets::tooltip((part.name + ": " + value + " of the organ. Right click for its border").c_str());
        if (ImGui::BeginPopupContextItem(("border " + std::to_string(n)).c_str())) {
            for (const char* kind : {"plane", "sheet"})
                if (ImGui::MenuItem(("Divide the organ by a " + std::string(kind) + " along its border").c_str()))
                    context.perform("resect", {"border", kind, part.name});
            ImGui::EndPopup();
        }
    });
}

// Suggested names of segments; each is taken or left by a click.
void draw_segments(InterfaceContext& context, const Marks& marks) {
    if (marks.organ.territories != TerritoriesOf::kNames) return;
    const Document& document = context.workspace.document();
    Editing::Segments& segments = context.interface.of<Editing>().segments;
    const auto tree = segments.tree.lock();
    if (tree != document.tree()) segments = {};
    if (ImGui::Button("Suggest segments of the liver")) {
        const auto& shown = context.workspace.assets().organ.territories;
        const int system = marks.organ.system >= 0 ? marks.organ.system : shown ? shown->of.system : 0;
        auto found = organ::suggested_segments(*document.tree(), document.dependency(), system);
        segments = {document.tree(), found ? std::move(*found) : std::vector<organ::SegmentSuggestion>(),
                    found ? std::string() : found.error().message()};
    }
    widgets::tooltip("Suggests which branches supply segments 2 to 8, by order, side and direction; you confirm each");
    if (!segments.trouble.empty()) widgets::trouble(window_words(segments.trouble).c_str());
    std::size_t done = segments.list.size();
    for (std::size_t n = 0; n < segments.list.size(); ++n) {
        const organ::SegmentSuggestion& one = segments.list[n];
        const std::string name = "S" + std::to_string(one.segment);
        ImGui::PushID(static_cast<int>(n));
        if (ImGui::Button(("Name " + name).c_str())) {
            done = n;
            context.perform("name", {std::to_string(one.branch), name, "subtree"});
        }
        widgets::tooltip(
            ("Names branch " + std::to_string(one.branch) + " and all that depends on it " + name).c_str());
        if (ImGui::IsItemHovered()) context.interface.listed = one.branch;
        ImGui::SameLine();
        const int clicked =
            plan_rows::removable_row(plan_rows::branch_name(document, one.branch), theme::kText,
                                     "Click to select the branch and look at it", counted(one.tips, "tip", "tips"));
        if (ImGui::IsItemHovered()) context.interface.listed = one.branch;
        ImGui::PopID();
        if (clicked > 0) plan_rows::go_to(context, one.branch);
        if (clicked < 0) done = n;
    }
    if (done < segments.list.size()) segments.list.erase(segments.list.begin() + static_cast<std::ptrdiff_t>(done));
}

// How sure the territories are.
void draw_certainty(const InterfaceContext& context) {
    const auto& territories = context.workspace.assets().organ.territories;
    if (!territories || !territories->expected) return;
    widgets::fact("Expected error", digits(territories->expected->error_percent, 2) + " %, Dice " +
                                        digits(territories->expected->dice, 2));
    widgets::tooltip(
        "Of a territory's volume and its overlap with the true one, on average in grown organs with as many "
        "visible branches; a patient's organ may differ");
}

void draw_opacity(InterfaceContext& context, const OrganChoice& choice) {
    widgets::Slider<float>& slider = context.interface.of<Editing>().territories;
    const bool changed = widgets::share_row("Opacity", "Of the territories; 100 % is solid", slider, choice.opacity);
    if (slider.held) context.interface.tried_territories = slider.value;
    if (changed) context.perform("territories-opacity", {digits(slider.value, 3)});
}

// How far what is removed is pulled away from what remains.
void draw_apart(InterfaceContext& context, const Marks& marks) {
    if (marks.organ.territories != TerritoriesOf::kRemnant || marks.resections.empty()) return;
    plan_rows::field_label(context, "Pulled apart (mm)");
    const auto words = plan_rows::number_field(context, "apart", rounded(marks.organ.apart_mm), 56.0F);
    widgets::tooltip("How far what is removed is drawn from its place; 0: where it is");
    if (words.size() == 1) context.perform("territories-apart", words);
}

} // namespace

void draw_organ(InterfaceContext& context) {
    const Marks& marks = context.workspace.document().marks();
    context.interface.tried_territories.reset();
    const bool open =
        draw_section(context, "Organ",
                     {{"Mask\xE2\x80\xA6",
                       "Choose the mask of the organ: what do the vessels supply, what do cuts cost?", "organ"}});
    if (!open || !marks.organ.any()) return;
    draw_mask(context, marks.organ);
    draw_figures(context, marks);
    draw_patient(context, marks.organ);
    if (!context.workspace.document().tree()) return;
    draw_roles(context, marks);
    draw_choice(context, marks);
    if (marks.organ.territories == TerritoriesOf::kNothing) return;
    draw_system(context, marks);
    draw_segments(context, marks);
    draw_opacity(context, marks.organ);
    draw_apart(context, marks);
    draw_parts(context, marks);
    draw_certainty(context);
}

} // namespace ramus::app
