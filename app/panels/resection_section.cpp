// The plans and resections of the planning page: what each removes, the vessels it cuts, and the plans compared.
#include "app/assets/organ_text.h"
#include "app/panels/choice_row.h"
#include "app/panels/editing.h"
#include "app/panels/flat_map_view.h"
#include "app/panels/plan_rows.h"
#include "app/panels/sections.h"
#include "app/panels/theme.h"
#include "app/panels/widgets.h"
#include "app/session/numbers.h"
#include "app/session/systems.h"

#include <algorithm>
#include <imgui.h>
#include <set>
#include <string>
#include <vector>

namespace ramus::app {

namespace {

using ResectionKind = Resection::Kind;

bool has_margin(const Resection& resection) {
    return resection.kind == ResectionKind::kCuts || resection.kind == ResectionKind::kLesion;
}

// Of a plane or a sheet that is made, from Editing::FlatMaps::of, which is then not null.
const FlatMap* flat_map(InterfaceContext& context, const Marks& marks, std::size_t index) {
    Editing::FlatMaps& maps = context.interface.of<Editing>().maps;
    const auto operation = operation_of(context.workspace.assets(), marks, marks.plans.place, OperationOf::kLast);
    if (!operation) return nullptr;
    const Systems& systems = systems_of(*operation->of.supply->of.tree, marks);
    if (maps.of != operation || maps.systems != systems) maps = {std::move(maps.open), operation, systems, {}};
    auto found = maps.made.find(index);
    if (found == maps.made.end()) found = maps.made.emplace(index, flat_map_of(*operation, index, marks)).first;
    return found->second ? &*found->second : nullptr;
}

// Its margin or a button for its other side, its opacity, and its surface laid flat.
void draw_resection(InterfaceContext& context, const Resection& resection, std::size_t index) {
    const plan_rows::ObjectRow row = plan_rows::row_of(context, resection, index);
    const std::string number = std::to_string(index + 1);
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {4.0F * theme::scale(), 2.0F * theme::scale()});
    plan_rows::object_row(context, row);
    ImGui::PushID(static_cast<int>(index));
    if (has_margin(resection)) {
        plan_rows::field_label(context, "Margin (mm)");
        const auto words =
            plan_rows::number_field(context, ("margin " + number).c_str(), rounded(resection.margin_mm), 56.0F);
        widgets::tooltip("How far around it tissue is removed, too");
        if (words.size() == 1) context.perform("resection-margin", {number, words[0]});
    } else {
        if (ImGui::Button("Other side")) context.perform("resection-flip", {number});
        widgets::tooltip("Removes the other side of it");
        bool open = context.interface.of<Editing>().maps.open.contains(resection.id);
        if (resection.kind != ResectionKind::kSurface) {
            ImGui::SameLine();
            if (ImGui::Checkbox("Map", &open)) {
                std::set<int>& all = context.interface.of<Editing>().maps.open;
                if (open)
                    all.insert(resection.id);
                else
                    all.erase(resection.id);
            }
            widgets::tooltip("Lays its surface flat: distances to lesions, and the vessels that it cuts");
        }
        if (row.visible) plan_rows::object_opacity(context, row);
        const Marks& marks = context.workspace.document().marks();
        if (const FlatMap* map = open ? flat_map(context, marks, index) : nullptr)
            draw_flat_map(context, *map, context.interface.of<Editing>().maps.of->of.supply->of.mask->claims);
    }
    ImGui::PopID();
    ImGui::PopStyleVar();
}

// The thickest vessels that the resections cut.
void draw_vessels_cut(InterfaceContext& context, const Operation& operation, const Marks& marks) {
    constexpr std::size_t kMostRows = 8;
    const Document& document = context.workspace.document();
    const auto in_organ = static_cast<std::size_t>(
        std::ranges::count_if(operation.vessels, [](const organ::CutVessel& vessel) { return vessel.in_organ; }));
    if (in_organ == 0) return;
    const double limit = marks.planning.reconstruct_mm;
    const auto thick = std::ranges::count_if(operation.vessels, [limit](const organ::CutVessel& vessel) {
        return vessel.in_organ && vessel.diameter_mm > limit;
    });
    widgets::row_headings({"Vessel that is cut", "Click a line to select the branch and to look at it"},
                          {"Diameter", "The diameter where the resection cuts it"});
    std::size_t shown = 0;
    for (std::size_t n = 0; n < operation.vessels.size() && shown < kMostRows; ++n) {
        const organ::CutVessel& vessel = operation.vessels[n];
        const int branch = vessel.place.branch;
        if (!vessel.in_organ || branch >= document.branch_count()) continue;
        ++shown;
        ImGui::PushID(static_cast<int>(n));
        const std::string system = system_of(*document.tree(), marks, branch);
        const std::string name = plan_rows::branch_name(document, branch) + (system.empty() ? "" : ", " + system);
        const std::string value = "\xC3\x98 " + document.lengths().text(vessel.diameter_mm);
        const float room = ImGui::GetContentRegionAvail().x, of_value = ImGui::CalcTextSize(value.c_str()).x;
        const ImVec2 at = ImGui::GetCursorPos();
        ImGui::PushStyleColor(ImGuiCol_Text, vessel.diameter_mm > limit ? theme::kTrouble : theme::kText);
        if (ImGui::Selectable(widgets::fitted(name, room - of_value - 8.0F * theme::scale()).c_str()))
            plan_rows::go_to(context, branch);
        widgets::tooltip(
            (name + ", cut at " + digits(vessel.angle_deg, 2) + "\xC2\xB0 to its axis. Click to go there").c_str());
        if (ImGui::IsItemHovered()) context.interface.listed = branch;
        ImGui::SameLine();
        ImGui::SetCursorPosX(at.x + room - of_value);
        ImGui::TextUnformatted(value.c_str());
        ImGui::PopStyleColor();
        ImGui::PopID();
    }
    widgets::quiet_wrapped((counted(in_organ, "vessel is cut", "vessels are cut") + ", " + grouped(std::size_t(thick)) +
                            " " + over_text(limit, document.lengths()))
                               .c_str());
}

// The figures of all plans, a column each.
void draw_comparison(const InterfaceContext& context, const Marks& marks, const std::vector<OperationPlan>& plans) {
    if (!marks.organ.any()) return;
    const int columns = static_cast<int>(plans.size()) + 1;
    if (!ImGui::BeginTable("plans", columns, ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingStretchProp)) return;
    ImGui::TableSetupColumn("");
    for (const OperationPlan& plan : plans) ImGui::TableSetupColumn(plan.name.c_str());
    ImGui::PushFont(theme::small_font());
    ImGui::TableHeadersRow();
    for (const PlanFigure& figure : plan_figures(context.workspace.assets(), marks, OperationOf::kLast)) {
        ImGui::TableNextRow();
        ImGui::TableNextColumn();
        widgets::quiet(figure.label.c_str());
        for (const std::string& value : figure.values) {
            ImGui::TableNextColumn();
            ImGui::TextUnformatted(value.empty() ? "\xE2\x80\x93" : value.c_str());
        }
    }
    ImGui::PopFont();
    ImGui::EndTable();
}

} // namespace

void draw_plans(InterfaceContext& context) {
    const Marks& marks = context.workspace.document().marks();
    if (!marks.organ.any() && marks.plans == Plans{}) return;
    if (!draw_section(context, "Plans", {{"Copy", "Begin another plan as a copy of this one", "plan-copy"}})) return;
    const std::vector<OperationPlan> plans = all_plans(marks);
    if (plans.size() > 1) {
        std::vector<std::pair<std::string, std::string>> entries;
        for (std::size_t plan = 0; plan < plans.size(); ++plan)
            entries.emplace_back(std::to_string(plan + 1), plans[plan].name);
        const std::string now = std::to_string(marks.plans.place + 1);
        const auto chosen = widgets::choice_row("Plan", "The plan whose cuts and resections are shown", now, entries);
        entries.erase(entries.begin() + static_cast<std::ptrdiff_t>(marks.plans.place));
        entries.insert(entries.begin(), {"off", "None"});
        const auto& compared = marks.plans.compared;
        const std::string next = compared ? std::to_string(*compared + 1) : "off";
        const auto other = widgets::choice_row(
            "Side by side", "Another plan next to this one, with one camera. Tools act on the one they are used in",
            next, entries);
        if (chosen && *chosen != now) context.perform("plan-use", {*chosen});
        if (other && *other != next) context.perform("plan-compare", {*other});
        if (ImGui::Button("Remove this plan")) context.perform("plan-remove", {now});
        if (marks.plans.count() == plans.size()) draw_comparison(context, marks, plans); // none was removed
    }
}

void draw_resections(InterfaceContext& context) {
    const Marks& marks = context.workspace.document().marks();
    if (!marks.organ.any()) return;
    const bool open = draw_section(
        context, "Resections",
        {{"Plane", "Draw a line across the picture: a plane behind it divides the organ", "tool", {"resect-plane"}},
         {"3 points",
          "Click three places on vessels: the plane through them divides the organ",
          "tool",
          {"resect-points"}},
         {"Sheet", "Draw a stroke across the picture: a sheet behind it divides the organ", "tool", {"resect-sheet"}}});
    if (!open) return;
    const auto offer = [&](const char* label, const char* help, const std::vector<std::string>& words) {
        if (ImGui::Button(label)) context.perform("resect", words);
        widgets::tooltip(help);
    };
    if (!marks.cuts.empty()) offer("Beyond the cuts", "Remove all that depends on the cuts", {"cuts", "0"});
    if (!marks.cuts.empty() && marks.lesions.size() == 1) ImGui::SameLine();
    constexpr const char* kAround = "Remove a lesion with a margin of 10 mm, which can be changed";
    if (marks.lesions.size() == 1) offer("Around lesion 1", kAround, {"lesion", "1", "10"});
    if (marks.lesions.size() > 1) {
        std::vector<std::pair<std::string, std::string>> lesions{{"", "Choose\xE2\x80\xA6"}};
        for (std::size_t n = 1; n <= marks.lesions.size(); ++n)
            lesions.emplace_back(std::to_string(n), "Lesion " + std::to_string(n));
        const auto chosen = widgets::choice_row("Around a lesion", kAround, "", lesions);
        if (chosen && !chosen->empty()) context.perform("resect", {"lesion", *chosen, "10"});
    }
    const std::vector<Resection> resections = marks.resections; // rows change it
    for (std::size_t i = 0; i < resections.size(); ++i) draw_resection(context, resections[i], i);
    const bool dragged = std::ranges::any_of(resections, [](const Resection& one) {
        return one.kind == ResectionKind::kPlane || one.kind == ResectionKind::kSheet;
    });
    if (dragged && ImGui::Button("Move points")) context.perform("tool", {"resection"});
    if (resections.empty()) return; // the section of the cuts lists theirs
    if (const auto operation = operation_of(context.workspace.assets(), marks, marks.plans.place, OperationOf::kLast))
        draw_vessels_cut(context, *operation, marks);
}

} // namespace ramus::app
