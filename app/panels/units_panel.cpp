// "What this file does not say": a panel at the left edge of the picture that asks for the file's unit and orientation.
// The cube in the picture previews the choice.
#include "app/panels/units_panel.h"

#include "app/panels/choice_row.h"
#include "app/panels/doctor_panel.h"
#include "app/panels/left_panel.h"
#include "app/panels/parts.h"
#include "app/panels/theme.h"
#include "app/panels/widgets.h"
#include "app/session/numbers.h"
#include "app/session/reading_options.h"
#include "app/session/window_words.h"

#include <algorithm>
#include <array>
#include <imgui.h>

namespace ramus::app {

namespace {

using Entries = std::vector<std::pair<std::string, std::string>>;

constexpr const char *kOpen = "open", *kVoxelSize = "voxels";

std::string side_words(io::Side side) {
    return std::string(io::name_of(side)) + " (" + std::string(1, io::letter_of(side)) + ")";
}

void draw_unit_row(UnitsPanel& units_panel, const tree::Claims& claims) {
    const char* by_itself = claims.unit == tree::SaidBy::kFile ? "As the file says" : "Not known";
    if (const auto unit = widgets::choice_row("Unit", "What one unit of the file's numbers is", units_panel.unit,
                                              {{kOpen, by_itself},
                                               {"mm", "Millimetres (mm)"},
                                               {"cm", "Centimetres (cm)"},
                                               {"um", "Micrometres (um)"},
                                               {"m", "Metres (m)"},
                                               {kVoxelSize, "Voxels\xE2\x80\xA6"}}))
        units_panel.unit = *unit;
    if (units_panel.unit != kVoxelSize) return;
    widgets::begin_row("Voxel", "The size of a voxel in mm, or three");
    ImGui::InputTextWithHint("##size", "mm: 0.62 or 0.3x0.3x0.6", units_panel.voxel.data(), units_panel.voxel.size());
    ImGui::PopID();
}

// Omits sides on an axis that is taken already, so that every choice is valid.
void draw_axis_row(UnitsPanel& units_panel, std::size_t axis, const tree::Claims& claims) {
    constexpr std::array kNames{"x", "y", "z"};
    Entries entries{{kOpen, claims.orientation == tree::SaidBy::kFile ? "As the file says" : "Not known"}};
    for (const io::Side side : io::kSides) {
        const bool taken = [&] {
            for (std::size_t other = 0; other < units_panel.sides.size(); ++other)
                if (other != axis && units_panel.sides.at(other) &&
                    io::line_of(*units_panel.sides.at(other)) == io::line_of(side))
                    return true;
            return false;
        }();
        if (!taken) entries.emplace_back(std::string(1, io::letter_of(side)), side_words(side));
    }
    std::optional<io::Side>& mine = units_panel.sides.at(axis);
    const std::string now = mine ? std::string(1, io::letter_of(*mine)) : kOpen;
    const std::string help = "Which side of the patient " + std::string(kNames.at(axis)) + " leads to";
    const auto chosen = widgets::choice_row(kNames.at(axis), help.c_str(), now, entries);
    if (!chosen) return;
    const auto* const side = std::ranges::find(io::kSides, chosen->front(), io::letter_of);
    mine = *chosen == kOpen || side == io::kSides.end() ? std::nullopt : std::optional(*side);
}

void draw_axes(UnitsPanel& units_panel, const tree::Claims& claims) {
    for (std::size_t axis = 0; axis < units_panel.sides.size(); ++axis) draw_axis_row(units_panel, axis, claims);
    const auto chosen = units_panel.orientation();
    if (!chosen) {
        const bool none = std::ranges::none_of(units_panel.sides, [](const auto& side) { return side.has_value(); });
        widgets::quiet_wrapped(none ? "Without sides the cube shows the axes x, y, z."
                                    : "Choose a side for each of the three axes.");
    } else if (chosen->mirrors()) {
        ImGui::PushStyleColor(ImGuiCol_Text, theme::kHighlight);
        ImGui::TextWrapped(
            "%s leads to a left-handed patient: the tree becomes the mirror image of the file's numbers. "
            "That is right only if the program that wrote the file says so.",
            chosen->letters().c_str());
        ImGui::PopStyleColor();
    } else {
        widgets::quiet_wrapped("The cube in the picture shows this choice.");
    }
}

// Arguments of read-as; empty: nothing changes.
std::vector<std::string> answers(const UnitsPanel& units_panel, const io::ReadOptions& options) {
    std::vector<std::string> words;
    const auto add = [&](const char* key, std::string value) { words.insert(words.end(), {key, std::move(value)}); };
    const std::string unit = units_panel.unit == kVoxelSize ? std::string(units_panel.voxel.data())
                             : units_panel.unit == kOpen    ? "auto"
                                                            : units_panel.unit;
    if (unit != (options.unit ? spelled(*options.unit) : "auto")) add("units", unit);
    const auto orientation = units_panel.orientation();
    if (orientation && orientation != options.orientation) add("orientation", orientation->letters());
    if (!orientation && options.orientation) add("orientation", "auto");
    return words;
}

bool is_whole(const UnitsPanel& units_panel) {
    const auto chosen = std::ranges::count_if(units_panel.sides, [](const auto& side) { return side.has_value(); });
    return (chosen == 0 || chosen == 3) &&
           (units_panel.unit != kVoxelSize || io::length_unit(units_panel.voxel.data()));
}

} // namespace

io::ReadOptions said_of(const Document& document) {
    if (document.tree()) return document.marks().reading;
    io::ReadOptions said;
    const auto& context = document.marks().context;
    const auto other = [&](const ContextItem& item) { return item.units != context.front().units; };
    if (!context.empty() && std::ranges::none_of(context, other)) said.unit = io::length_unit(context.front().units);
    return said;
}

std::optional<io::Orientation> UnitsPanel::orientation() const {
    if (!sides[0] || !sides[1] || !sides[2]) return std::nullopt;
    return io::Orientation::leading_to({*sides[0], *sides[1], *sides[2]});
}

void UnitsPanel::show(const io::ReadOptions& options) {
    unit = options.unit ? spelled(*options.unit) : kOpen;
    voxel = {};
    if (options.unit && !io::named_unit_mm(unit)) {
        std::copy_n(unit.begin(), std::min(unit.size(), voxel.size() - 1), voxel.begin());
        unit = kVoxelSize;
    }
    sides = {};
    for (int axis = 0; axis < 3 && options.orientation; ++axis)
        sides.at(static_cast<std::size_t>(axis)) = options.orientation->side(axis);
}

std::optional<render::AxisNames> UnitsPanel::axes(const tree::Claims& claims, const io::ReadOptions& options) const {
    const auto chosen = orientation();
    if (!chosen || claims.orientation == tree::SaidBy::kFile) return std::nullopt;
    const io::Orientation now = options.orientation.value_or(io::Orientation::ras());
    render::AxisNames names;
    for (int axis = 0; axis < 3; ++axis)
        for (int way = 0; way < 2; ++way) {
            glm::dvec3 direction(0.0);
            direction[axis] = way == 0 ? 1.0 : -1.0;
            const glm::dvec3 there = chosen->to_patient(now.to_file(direction));
            for (int line = 0; line < 3; ++line)
                if (there[line] != 0.0)
                    names.at(static_cast<std::size_t>(2 * axis + way)) =
                        render::side_letters().at(static_cast<std::size_t>(2 * line + (there[line] < 0.0 ? 1 : 0)));
        }
    return names;
}

void draw_units_panel(InterfaceContext& context) {
    UnitsPanel& units_panel = context.interface.of<UnitsPanel>();
    const Document& document = context.workspace.document();
    if (!context.interface.left_is<UnitsPanel>() || !document.has_scene()) return;
    const tree::Claims& claims = document.claims();
    const io::ReadOptions options = said_of(document);
    begin_left_panel("what the file does not say", context);
    const bool tree = document.tree() != nullptr;
    ImGui::TextUnformatted(!tree               ? "Unit of what is shown"
                           : claims.complete() ? "Orientation and unit"
                                               : "What this file does not say");
    ImGui::Dummy({0.0F, 2.0F * theme::scale()});
    ImGui::BeginDisabled(context.commands.busy());
    draw_unit_row(units_panel, claims);
    if (tree && !claims.has_unit())
        for (const tree::Note& note : document.tree()->notes)
            if (note.kind == tree::Note::Kind::kSuspect && note.topic == "units")
                widgets::quiet_wrapped(capitalised(window_words(note.text)).c_str());
    if (!tree)
        widgets::quiet_wrapped("The axes of masks and meshes are those of their files.");
    else if (context.interface.of<Doctor>().of_mask)
        widgets::quiet_wrapped("The axes of a mask are those of its file.");
    else
        draw_axes(units_panel, claims);
    ImGui::Dummy({0.0F, 4.0F * theme::scale()});
    const float width = 104.0F * theme::scale();
    widgets::align_right(2.0F * width + ImGui::GetStyle().ItemSpacing.x);
    const std::vector<std::string> words = answers(units_panel, options);
    const bool later = ImGui::Button(words.empty() ? "Close" : "Leave open", {width, 0.0F});
    widgets::note_item("Leave open");
    widgets::tooltip("Nothing is claimed that nobody has said; View, Orientation and unit asks again", "Escape");
    ImGui::SameLine();
    ImGui::BeginDisabled(words.empty() || !is_whole(units_panel));
    const auto chosen = units_panel.orientation();
    const bool mirrored = chosen && chosen->mirrors() && chosen != options.orientation;
    const bool taken = widgets::button(mirrored ? "Apply mirrored" : "Apply", {width, 0.0F}, theme::kAccentDim);
    widgets::note_item("Take");
    widgets::tooltip("Reads the file so; one step of undo, and part of the session");
    ImGui::EndDisabled();
    ImGui::EndDisabled();
    ImGui::End();
    if (!later && !taken) return;
    context.interface.close_left();
    if (tree && could_mislead(*document.tree(), options)) context.interface.show_left<Doctor>();
    if (taken && tree) context.perform("read-as", words);
    if (taken && !tree) context.perform("units", {words.back()});
}

} // namespace ramus::app
