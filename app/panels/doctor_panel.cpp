// The import doctor: a panel at the left edge of the picture that lists assumptions, repairs and suspicions of reading
// the tree's file, moves the camera to each place, and rereads the file with other options.
#include "app/panels/doctor_panel.h"

#include "app/panels/choice_row.h"
#include "app/panels/left_panel.h"
#include "app/panels/parts.h"
#include "app/panels/theme.h"
#include "app/panels/widgets.h"
#include "app/session/numbers.h"
#include "app/session/reading_options.h"
#include "app/session/window_words.h"
#include "core/tree/suspicions.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <imgui.h>

namespace ramus::app {

namespace {

using tree::Note;

struct RepairRow {
    tree::Repair repair;
    const char *label, *help;
};
constexpr std::array kRepairRows{
    RepairRow{tree::Repair::kZeroRadii, "Fill in radii of 0",
              "A radius of 0 is interpolated between its neighbours along the vessel"},
    RepairRow{tree::Repair::kUnmeasuredRadii, "Fill in radii that were not measured",
              "A radius of -1 or NaN is interpolated between its neighbours along the vessel"},
    RepairRow{tree::Repair::kRepeatedPoints, "Merge repeated points", "Connected points at one place become one"},
    RepairRow{tree::Repair::kLonelyPoints, "Leave out points on their own", "Points that are connected to nothing"},
    RepairRow{tree::Repair::kRepeatedTrunks, "Keep repeated trunks once",
              "What several centerlines trace alike becomes one vessel"},
    RepairRow{tree::Repair::kRadiusJumps, "Even out jumps of the radius",
              "A radius far from those on both sides becomes their mean"},
    RepairRow{tree::Repair::kOrphans, "Accept missing parents", "A point whose parent is missing becomes a root"}};

ImVec4 colour_of(Note::Kind kind) {
    return kind == Note::Kind::kSuspect    ? theme::kSuspect
           : kind == Note::Kind::kRepaired ? theme::kHighlight
                                           : theme::kQuiet;
}

const char* heading_of(Note::Kind kind) {
    return kind == Note::Kind::kSuspect ? "Suspicious" : kind == Note::Kind::kRepaired ? "Repaired" : "Assumed";
}

// As a sentence without the file's name, which all notes share; flags of the command line have rows here.
std::string text_of(const Note& note, const std::string& path, bool of_mask) {
    std::string text = note.text;
    if (of_mask) text.erase(std::min(text.find("; --repair"), text.size())); // applies only to tree files
    text = window_words(std::move(text));
    // The note has the path as it was given, which may be the end of the whole one.
    const std::size_t colon = text.find(':');
    if (colon != std::string::npos && colon > 0 && path.ends_with(text.substr(0, colon))) {
        text.erase(0, colon + 1);
        text.erase(0, text.find_first_not_of(' '));
        if (!text.empty() && std::isdigit(static_cast<unsigned char>(text[0])) != 0) text.insert(0, "line ");
    }
    return capitalised(text);
}

// Truncates the end.
std::string cut_to(std::string text, float width) {
    const std::string more = "\xE2\x80\xA6";
    if (ImGui::CalcTextSize(text.c_str()).x <= width) return text;
    while (!text.empty() && ImGui::CalcTextSize((text + more).c_str()).x > width) {
        while (text.size() > 1 && (static_cast<unsigned char>(text.back()) & 0xC0) == 0x80) text.pop_back();
        text.pop_back();
    }
    return text + more;
}

bool says_about(const tree::VesselTree& tree, const char* topic, const char* words) {
    return std::ranges::any_of(tree.notes, [&](const Note& note) {
        return note.kind == Note::Kind::kAssumed && note.topic == topic && note.text.find(words) != std::string::npos;
    });
}

void draw_voxel_row(InterfaceContext& context) {
    Doctor& doctor = context.interface.of<Doctor>();
    ImGui::AlignTextToFramePadding();
    widgets::quiet("Voxel");
    ImGui::SameLine(ImGui::GetStyle().WindowPadding.x + 70.0F * theme::scale());
    ImGui::SetNextItemWidth(-1.0F);
    const bool entered = ImGui::InputTextWithHint("##voxel", "mm: 0.62 or 0.3x0.3x0.6", doctor.voxel.data(),
                                                  doctor.voxel.size(), ImGuiInputTextFlags_EnterReturnsTrue);
    widgets::tooltip("The size of a voxel in mm, or three; Enter takes it");
    if (!entered) return;
    context.perform("read-as", {"units", doctor.voxel.data()});
    doctor.voxels = false;
}

void draw_unit(InterfaceContext& context, const tree::VesselTree& tree, const io::ReadOptions& options) {
    constexpr const char* kVoxels = "voxels";
    const std::string unit_by_itself = tree.claims.has_unit() ? "As the file says" : "Not known";
    Doctor& doctor = context.interface.of<Doctor>();
    const auto unit = widgets::choice_row("Unit", "What one unit of the file's coordinates is",
                                          options.unit ? app::spelled(*options.unit) : "auto",
                                          {{"auto", options.unit ? "By the file" : unit_by_itself},
                                           {"mm", "Millimetres (mm)"},
                                           {"cm", "Centimetres (cm)"},
                                           {"um", "Micrometres (um)"},
                                           {"m", "Metres (m)"},
                                           {kVoxels, "Voxels\xE2\x80\xA6"}});
    if (unit) doctor.voxels = *unit == kVoxels;
    if (unit && !doctor.voxels) context.perform("read-as", {"units", *unit});
    if (doctor.voxels) draw_voxel_row(context);
}

// A radius for points without one; points with radii keep them, so the row appears only if some are missing.
void draw_missing_radius(InterfaceContext& context, const tree::VesselTree& tree, const io::ReadOptions& options) {
    const auto about_missing = [](const Note& note) {
        return note.topic == tree::kInventedRadii || note.topic == name_of(tree::Repair::kUnmeasuredRadii);
    };
    if (!options.radius_mm && std::ranges::none_of(tree.notes, about_missing)) return;
    Doctor& doctor = context.interface.of<Doctor>();
    widgets::begin_row("Radius",
                       "The radius in mm of points whose radius the file does not give; Enter takes it, and an "
                       "empty field takes it back");
    const std::string now = options.radius_mm ? exact_text(*options.radius_mm) + " mm" : "Interpolated; mm to set it";
    const bool entered = ImGui::InputTextWithHint("##radius", now.c_str(), doctor.radius.data(), doctor.radius.size(),
                                                  ImGuiInputTextFlags_EnterReturnsTrue);
    ImGui::PopID();
    if (!entered) return;
    const std::string typed = doctor.radius.data();
    context.perform("read-as", {"radius", typed.empty() ? "auto" : typed});
    doctor.radius = {};
}

// Assumptions other than the unit.
void draw_assumptions(InterfaceContext& context, const tree::VesselTree& tree, const io::ReadOptions& options) {
    const std::string axes_by_itself = tree.claims.has_sides() ? "As the file says" : "Not known";
    const std::string width_by_itself = says_about(tree, "radius-is", "is taken as the radius") ? "Radius (assumed)"
                                        : says_about(tree, "radius-is", "is taken as the diameter")
                                            ? "Diameter (assumed)"
                                            : "As the file says";
    if (const auto width =
            widgets::choice_row("Widths", "Whether the file's widths are radii or diameters",
                                options.radius_is ? std::string(app::spelled(*options.radius_is)) : "auto",
                                {{"auto", options.radius_is ? "By the file" : width_by_itself},
                                 {"radius", "Radii"},
                                 {"diameter", "Diameters"}}))
        context.perform("read-as", {"radius-is", *width});
    draw_missing_radius(context, tree, options);
    constexpr const char* kOther = "other";
    const std::string now = options.orientation ? options.orientation->letters() : "auto";
    std::vector<std::pair<std::string, std::string>> entries{
        {"auto", options.orientation ? "By the file" : axes_by_itself},
        {"RAS", "Right, anterior, superior (RAS)"},
        {"LPS", "Left, posterior, superior (LPS)"}};
    if (now != "auto" && now != "RAS" && now != "LPS") entries.emplace_back(now, options.orientation->words());
    entries.emplace_back(kOther, "Other\xE2\x80\xA6");
    const auto axes = widgets::choice_row("Axes", "Which sides of the patient the file's axes lead to", now, entries);
    if (axes == kOther) context.perform("orientation", {});
    if (axes && axes != kOther) context.perform("read-as", {"orientation", *axes});
}

void draw_repairs(InterfaceContext& context, const io::ReadOptions& options) {
    const bool open = ImGui::TreeNodeEx("Repairs", ImGuiTreeNodeFlags_SpanAvailWidth);
    widgets::tooltip("What may be repaired when the file is read");
    if (!open) return;
    for (const RepairRow& row : kRepairRows) {
        bool allowed = tree::allows(options.repair, row.repair);
        if (ImGui::Checkbox(row.label, &allowed)) {
            const unsigned bits = static_cast<unsigned>(options.repair) ^ static_cast<unsigned>(row.repair);
            context.perform("read-as", {"repair", app::spelled(static_cast<tree::Repair>(bits))});
        }
        widgets::tooltip(row.help);
    }
    ImGui::TreePop();
}

// A note, on several lines (`whole`) or truncated to one. A click moves the camera to its place.
void draw_note(InterfaceContext& context, std::size_t index, bool whole) {
    const Document& document = context.workspace.document();
    const std::shared_ptr<const tree::VesselTree> tree = document.tree();
    const Note& note = tree->notes[index];
    const std::string text =
        text_of(note, document.session().tree.path.string(), context.interface.of<Doctor>().of_mask);
    const float width = ImGui::GetContentRegionAvail().x;
    const std::string shown = whole ? text : cut_to(text, width);
    const ImVec2 size = ImGui::CalcTextSize(shown.c_str(), nullptr, false, width);
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const std::string name = "Note " + std::to_string(index + 1);
    ImGui::PushID(static_cast<int>(index));
    if (note.at) {
        const bool current = context.interface.of<Doctor>().current == static_cast<int>(index);
        if (ImGui::Selectable("##note", current, 0, {width, size.y}))
            context.perform("note", {std::to_string(index + 1)});
        widgets::note_item(name.c_str());
        if (ImGui::IsItemHovered()) widgets::tooltip(whole ? "Click to look at the place" : text.c_str());
    } else {
        ImGui::Dummy({width, size.y});
        widgets::note_item(name.c_str());
    }
    ImGui::PopID();
    ImGui::GetWindowDrawList()->AddText(ImGui::GetFont(), ImGui::GetFontSize(), at, ImGui::GetColorU32(theme::kText),
                                        shown.c_str(), nullptr, whole ? width : 0.0F);
}

void draw_group(InterfaceContext& context, const tree::NoteGroup& group) {
    constexpr std::size_t kShownWhole = 3;
    const bool few = group.notes.size() <= kShownWhole;
    ImGui::PushID(static_cast<int>(group.notes.front()));
    ImGui::PushFont(theme::small_font());
    ImGui::PushStyleColor(ImGuiCol_Text, theme::kQuiet);
    const std::string label = topic_label(group.topic);
    bool open = true;
    if (few) {
        ImGui::TextUnformatted(label.c_str());
    } else {
        open =
            ImGui::TreeNodeEx(label.c_str(), ImGuiTreeNodeFlags_SpanAvailWidth | ImGuiTreeNodeFlags_NoTreePushOnOpen);
        widgets::note_item(label.c_str());
        ImGui::SameLine();
        widgets::quiet_right(grouped(group.notes.size()));
    }
    ImGui::PopStyleColor();
    ImGui::PopFont();
    if (few) {
        for (const std::size_t index : group.notes) draw_note(context, index, true);
    } else if (open) {
        widgets::clipped(
            group.notes.size(), [&](std::size_t n) { draw_note(context, group.notes[n], false); },
            ImGui::GetTextLineHeightWithSpacing());
    }
    ImGui::PopID();
}

void draw_notes(InterfaceContext& context, const tree::VesselTree& tree) {
    const std::vector<tree::NoteGroup> groups = note_groups(tree);
    for (const Note::Kind kind : {Note::Kind::kSuspect, Note::Kind::kRepaired, Note::Kind::kAssumed}) {
        std::size_t count = 0;
        for (const tree::NoteGroup& group : groups) count += group.kind == kind ? group.notes.size() : 0;
        if (count == 0) continue;
        widgets::rule();
        ImGui::TextColored(colour_of(kind), "%s", heading_of(kind));
        ImGui::SameLine();
        widgets::quiet_right(grouped(count));
        for (const tree::NoteGroup& group : groups)
            if (group.kind == kind) draw_group(context, group);
    }
    if (groups.empty()) {
        widgets::rule();
        widgets::quiet_wrapped("The file says all that is needed, and nothing in it is strange.");
    }
}

} // namespace

void draw_doctor(InterfaceContext& context) {
    Doctor& doctor = context.interface.of<Doctor>();
    // Keeps the tree alive: actions may replace the document's.
    const std::shared_ptr<const tree::VesselTree> tree = context.workspace.document().tree();
    if (!context.interface.left_is<Doctor>() || !tree) return;
    const io::ReadOptions options = context.workspace.document().marks().reading;
    begin_left_panel("import doctor", context);
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted("How the file was read");
    ImGui::SameLine();
    io::ReadOptions usual;
    usual.columns = options.columns;
    const bool reset = options != usual;
    const float scale = theme::scale();
    widgets::align_right(ImGui::CalcTextSize(reset ? "ResetClose" : "Close").x + (reset ? 32.0F : 14.0F) * scale);
    if (reset && widgets::small_button("Reset", "Reads the file as usual again")) context.perform("read-as", {"usual"});
    if (reset) ImGui::SameLine(0.0F, 4.0F * scale);
    if (widgets::small_button("Close", "Hides this panel; Shift+D shows it again")) context.interface.close_left();
    ImGui::BeginDisabled(context.commands.busy());
    draw_unit(context, *tree, options);
    if (doctor.of_mask) {
        draw_mask_reading(context, options.mask);
    } else {
        draw_assumptions(context, *tree, options);
        draw_repairs(context, options);
    }
    ImGui::EndDisabled();
    if (std::ranges::any_of(tree->notes, [](const Note& note) { return note.at.has_value(); })) {
        ImGui::Checkbox("Mark places in the picture", &doctor.mark);
        widgets::tooltip("Rings where something was repaired, or looks wrong");
    }
    draw_notes(context, *tree);
    ImGui::End();
}

widgets::Fact doctor_fact(InterfaceContext& context) {
    const tree::VesselTree& tree = *context.workspace.document().tree();
    // Omits the less important kinds of notes if space is short.
    const float room = ImGui::GetContentRegionAvail().x - ImGui::CalcTextSize("Import    ").x;
    std::string found;
    for (const Note::Kind kind : {Note::Kind::kSuspect, Note::Kind::kRepaired, Note::Kind::kAssumed}) {
        const auto count = static_cast<std::size_t>(std::ranges::count(tree.notes, kind, &Note::kind));
        if (count == 0) continue;
        const char* word = kind == Note::Kind::kSuspect ? "suspicious" : tree::name_of(kind).data(); // of a literal
        const std::string more = found + (found.empty() ? "" : ", ") + grouped(count) + " " + word;
        if (found.empty() || ImGui::CalcTextSize(more.c_str()).x <= room) found = more;
    }
    if (found.empty()) found = "nothing to report";
    return {"Import", found, [&context, &tree, found] {
                const bool misleads = could_mislead(tree, context.workspace.document().marks().reading);
                if (widgets::fact_button("Import", found, misleads ? theme::kHighlight : theme::kAccent,
                                         "Shows what reading the file assumed, repaired and finds strange", "Shift+D"))
                    context.perform("doctor", {});
            }};
}

} // namespace ramus::app
