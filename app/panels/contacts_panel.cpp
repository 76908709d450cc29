// The list of contacts: a panel over the picture's left edge with a row for each place where vessels press on each
// other without being connected there. A click goes there and selects both.
#include "app/panels/contacts_panel.h"

#include "app/panels/left_panel.h"
#include "app/panels/parts.h"
#include "app/panels/theme.h"
#include "app/panels/widgets.h"
#include "app/session/labels.h"
#include "app/session/numbers.h"
#include "app/session/window_words.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <imgui.h>

namespace ramus::app {

namespace {

using tree::Contact;
using tree::ContactSide;

constexpr const char* kAnd = " \xC2\xB7 "; // separates two branches, or their values

std::string side_text(const Document& document, const ContactSide& side) {
    std::string text = "Branch " + std::to_string(side.branch);
    if (const std::string label = label_of(document.dependency(), document.marks(), side.branch); !label.empty())
        text += ", " + label;
    if (side.branches.size() > 1) text += ", and " + grouped(side.branches.size() - 1) + " more";
    const Lengths lengths = document.lengths();
    return text + "\n    radius " + lengths.text(side.radius) + ", its surface flattened by " +
           lengths.text(side.narrowed) + "\n    along " + lengths.text(side.length);
}

// The full text for a tooltip.
std::string whole_text(const Document& document, const Contact& contact) {
    std::string text = capitalised(gap_text(contact, document.lengths()));
    for (const ContactSide& side : contact.sides) text.append("\n").append(side_text(document, side));
    return text + "\nClick to look at the place and to select both";
}

// Toggles the wipe between vessels apart and merged at the contact.
void draw_wipe_button(InterfaceContext& context, const std::string& number, bool current) {
    const Comparison::Mode mode = context.workspace.document().marks().comparison.mode;
    const bool wiped = current && mode == Comparison::Mode::kWipe;
    ImGui::PushStyleColor(ImGuiCol_Text, wiped ? theme::kAccent : theme::kQuiet);
    const bool pressed = ImGui::SmallButton(("Both##" + number).c_str());
    ImGui::PopStyleColor();
    widgets::note_item(("Wipe contact " + number).c_str());
    widgets::tooltip(wiped ? "Shows one surface again"
                           : "Looks at the place with the vessels merged left of a line, and apart right of it");
    if (!pressed) return;
    if (wiped)
        context.perform("compare", {"off"});
    else
        context.perform("contact", {number, "wipe"});
}

void draw_row(InterfaceContext& context, const Contact& contact, std::size_t index) {
    const auto& [first, second] = contact.sides;
    const std::string number = std::to_string(index + 1), name = "Contact " + number;
    ImGui::TableNextRow();
    const bool current = context.interface.of<ContactList>().current == static_cast<int>(index);
    ImGui::TableSetColumnIndex(4); // first: the row-wide item below must not take its clicks
    draw_wipe_button(context, number, current);
    ImGui::TableSetColumnIndex(0);
    if (ImGui::Selectable((number + "##" + name).c_str(), current, ImGuiSelectableFlags_SpanAllColumns))
        context.perform("contact", {number});
    widgets::note_item(name.c_str());
    if (ImGui::IsItemHovered()) {
        context.interface.listed = first.branch;
        widgets::tooltip(whole_text(context.workspace.document(), contact).c_str());
    }
    ImGui::TableSetColumnIndex(1);
    ImGui::TextUnformatted((std::to_string(first.branch) + kAnd + std::to_string(second.branch)).c_str());
    ImGui::TableSetColumnIndex(2);
    const bool overlap = contact.gap < 0.0;
    ImGui::TextColored(overlap ? theme::kOverlap : theme::kGap, "%s %s",
                       contact.crossing() ? "crossing"
                       : overlap          ? "overlap"
                                          : "gap",
                       digits(std::abs(contact.gap)).c_str());
    ImGui::TableSetColumnIndex(3);
    ImGui::TextUnformatted((digits(first.narrowed, 2) + kAnd + digits(second.narrowed, 2)).c_str());
}

void draw_rows(InterfaceContext& context, const std::vector<Contact>& list, float bottom) {
    const Lengths lengths = context.workspace.document().lengths();
    const std::string between = lengths.worded("Gap mm"), narrowed = lengths.worded("Flat mm");
    const std::string between_help = lengths.worded("The gap between the walls, or how far they overlap, in mm");
    const std::string narrowed_help = lengths.worded("By how much the drawn surface of each of the two vessels is "
                                                     "flattened toward the other, in mm. That is how the "
                                                     "surface is made, and says nothing of a stenosis");
    const std::array<widgets::ListColumn, 5> columns{{{"No.", 0.4F, "The number of the contact, the closest first"},
                                                      {"Branches", 1.25F, "The ids of the two branches"},
                                                      {between.c_str(), 1.3F, between_help.c_str()},
                                                      {narrowed.c_str(), 1.05F, narrowed_help.c_str()},
                                                      {"View", 0.6F, "Looks at the place with both surfaces"}}};
    if (!widgets::begin_list({.id = "contacts", .columns = columns, .most_rows = 18, .bottom = bottom}, list.size()))
        return;
    widgets::clipped(list.size(), [&](std::size_t n) { draw_row(context, list[n], n); });
    widgets::end_list();
}

std::string summary_of(const std::vector<Contact>& list) {
    const auto overlaps = std::ranges::count_if(list, [](const Contact& each) { return each.gap < 0.0; });
    return counted(list.size(), "contact", "contacts") + ", " +
           counted(static_cast<std::uint64_t>(overlaps), "overlap", "overlaps");
}

} // namespace

void draw_contacts(InterfaceContext& context) {
    ContactList& panel = context.interface.of<ContactList>();
    context.workspace.want_contacts(context.interface.left_is<ContactList>());
    const auto tree = context.workspace.document().tree();
    if (!context.interface.left_is<ContactList>() || !tree) return;
    const Marks& marks = context.workspace.document().marks();
    const float bottom = begin_left_panel("contacts", context);
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted("Vessels that touch");
    ImGui::SameLine();
    widgets::align_right(ImGui::CalcTextSize("Close").x + 14.0F * theme::scale());
    if (widgets::small_button("Close", "Hides this list; Shift+T shows it again")) context.interface.close_left();
    const auto list = context.workspace.current_assets().contacts.list; // keeps it alive: actions may replace it
    if (panel.of != list) panel.current = -1;                           // `current` is an index into the old list
    panel.of = list;
    bool mark = marks.contact_marks;
    if (ImGui::Checkbox("Mark them in the picture", &mark)) context.perform("contact-marks", {mark ? "on" : "off"});
    widgets::tooltip("Rings where vessels press on each other: yellow where they overlap, else blue");
    widgets::rule();
    if (!list) {
        widgets::quiet(context.workspace.awaited(WorkKind::kContacts) ? "Looking for contacts\xE2\x80\xA6"
                                                                      : "They could not be looked for.");
    } else if (list->empty()) {
        widgets::quiet_wrapped("No vessels press on each other without being connected there.");
    } else {
        widgets::quiet(summary_of(*list).c_str());
        draw_rows(context, *list, bottom);
    }
    ImGui::End();
}

widgets::Fact contacts_fact(InterfaceContext& context) {
    const auto list = context.workspace.current_assets().contacts.list;
    if (!list || list->empty()) return {"Contacts", list ? "none" : "\xE2\x80\xA6"};
    const std::string count = grouped(list->size());
    return {"Contacts", count, [&context, count] {
                if (widgets::fact_button("Contacts", count, theme::kAccent,
                                         "Lists where vessels press on each other without being connected there",
                                         "Shift+T"))
                    context.perform("contacts", {});
            }};
}

} // namespace ramus::app
