#include "app/window/window_parts.h"

#include "app/panels/branch_list.h"
#include "app/panels/command_palette.h"
#include "app/panels/contacts_panel.h"
#include "app/panels/doctor_panel.h"
#include "app/panels/fly_panel.h"
#include "app/panels/help_overlay.h"
#include "app/panels/menu_bar.h"
#include "app/panels/overview.h"
#include "app/panels/radius_dialog.h"
#include "app/panels/rename_dialog.h"
#include "app/panels/units_panel.h"
#include "app/panels/validation_panel.h"
#include "app/panels/warnings_panel.h"
#include "app/panels/written_notice.h"

#include <imgui.h>

namespace ramus::app {

void WindowParts::toggle(std::string_view part) {
    Interface& interface = state_.interface;
    auto& menus = interface.of<BarMenus>();
    if (part == "help")
        interface.of<Help>().open = !interface.of<Help>().open;
    else if (part == "palette")
        interface.of<CommandPalette>().toggle();
    else if (part == "menu")
        menus.wanted = !menus.open, menus.close = menus.open;
    else if (part == "overview")
        interface.of<Overview>().open = !interface.of<Overview>().open;
    else if (part == "doctor")
        interface.show_left<Doctor>(!interface.left_is<Doctor>());
    else if (part == "warnings")
        interface.show_left<WarningsPanel>(!interface.left_is<WarningsPanel>());
    else if (part == "orientation")
        show_units_panel(!interface.left_is<UnitsPanel>());
    else if (part == "contacts")
        show_contacts(!interface.left_is<ContactList>());
    else if (part == "branches")
        interface.of<BranchList>().apart = !interface.of<BranchList>().apart;
    else if (part == "validation")
        show_validation(!interface.left_is<ValidationList>());
    else if (part == "panel")
        interface.panel_open = !interface.panel_open;
    else
        open_page(part);
    state_.redraw();
}

void WindowParts::open_page(std::string_view name) {
    Interface& interface = state_.interface;
    interface.panel_open = true;
    const bool plans = interface.page == PanelPage::kPlan;
    if (name == "other") interface.page = plans ? PanelPage::kExplore : PanelPage::kPlan;
    for (const PanelPage page : kPanelPages)
        if (name == key_of(page)) interface.page = page;
}

bool WindowParts::shows(std::string_view part) const {
    const Interface& interface = state_.interface;
    return part == "fly-along"     ? interface.of<Fly>().open
           : part == "overview"    ? interface.of<Overview>().open
           : part == "help"        ? interface.of<Help>().open
           : part == "palette"     ? interface.of<CommandPalette>().open
           : part == "doctor"      ? interface.left_is<Doctor>()
           : part == "orientation" ? interface.left_is<UnitsPanel>()
           : part == "warnings"    ? interface.left_is<WarningsPanel>()
           : part == "contacts"    ? interface.left_is<ContactList>()
           : part == "branches"    ? interface.of<BranchList>().apart
           : part == "validation"  ? interface.left_is<ValidationList>()
                                   : interface.panel_open;
}

void WindowParts::set_overview(std::string_view setting) {
    Overview& overview = state_.interface.of<Overview>();
    overview.open = setting != "off";
    if (setting == "generation") overview.depth = OverviewDepth::kGeneration;
    if (setting == "distance") overview.depth = OverviewDepth::kDistance;
    state_.redraw();
}

void WindowParts::open_flight(int branch) {
    Fly& fly = state_.interface.of<Fly>();
    fly.open = true;
    fly.playing = false;
    fly.branch = branch;
    fly.fraction = 0.0;
    fly.selection = state_.workspace.document().marks().selection;
    state_.redraw();
}

void WindowParts::close_flight() {
    state_.interface.of<Fly>().close();
    state_.redraw();
}

void WindowParts::ask_for_name(int branch) {
    const Marks& marks = state_.workspace.document().marks();
    const BranchNames& names = marks.names;
    state_.interface.of<Rename>().show(branch, names.contains(branch) ? names.at(branch) : std::string{},
                                       names_subtree(marks, branch));
    state_.redraw();
}

void WindowParts::ask_for_object_name(const std::string& kind, const std::string& number, const std::string& now) {
    state_.interface.of<Rename>().show_object(kind, number, now);
    state_.redraw();
}

void WindowParts::ask_for_view_name(const std::string& now) {
    const std::vector<SavedView>& views = state_.workspace.document().marks().views;
    state_.interface.of<Rename>().show_view(now, now.empty() ? free_view_name(views) : now);
    state_.redraw();
}

void WindowParts::ask_for_radius() {
    RadiusDialog& dialog = state_.interface.of<RadiusDialog>();
    dialog.open = dialog.fresh = true;
    state_.redraw();
}

void WindowParts::show_note(int note) {
    state_.interface.show_left<Doctor>();
    state_.interface.of<Doctor>().current = note;
    state_.redraw();
}

void WindowParts::wrote(const std::filesystem::path& file, const std::string& sentence) {
    state_.interface.of<Written>() = {state_.watched(), file, sentence};
    state_.redraw();
}

void WindowParts::read_warnings() {
    state_.interface.of<WarningsPanel>().list.mark_all_read();
    state_.redraw();
}

void WindowParts::show_units_panel(bool open) {
    Interface& interface = state_.interface;
    interface.close_left();
    if (!open) return;
    interface.show_left<UnitsPanel>();
    interface.of<UnitsPanel>().show(said_of(state_.workspace.document()));
}

void WindowParts::show_contacts(bool open) {
    state_.interface.show_left<ContactList>(open);
    state_.workspace.want_contacts(open);
}

void WindowParts::show_contact(int contact) {
    show_contacts(true);
    state_.interface.of<ContactList>().current = contact;
    state_.interface.of<ContactList>().of = state_.workspace.assets().contacts.list;
    state_.redraw();
}

void WindowParts::show_validation(bool open) {
    state_.interface.show_left<ValidationList>(open);
    state_.workspace.want_validation(open);
}

void WindowParts::show_finding(int finding) {
    show_validation(true);
    state_.interface.of<ValidationList>().current = finding;
    state_.interface.of<ValidationList>().of = state_.workspace.assets().validation.findings;
    state_.redraw();
}

bool WindowParts::dismiss() {
    if (state_.interface.dismiss()) return true;
    const auto& tool = state_.interface.tool;
    if (!tool) return false;
    if (!tool->escape()) state_.actions->tools->use_tool(kNavigate);
    return true;
}

void WindowParts::set_ui_scale(double pixels_per_point) {
    state_.interface.settings.ui_scale = pixels_per_point;
    state_.redraw();
}

void WindowParts::set_light_theme(bool light) {
    state_.interface.settings.light_theme = light;
    state_.redraw();
}

void WindowParts::set_ground(Ground ground) {
    state_.interface.settings.ground = ground;
    state_.redraw();
}

void WindowParts::copy_text(const std::string& text) { ImGui::SetClipboardText(text.c_str()); }

Result<std::string> WindowParts::pasted_text() const {
    const char* text = ImGui::GetClipboardText();
    if (text == nullptr || *text == '\0') return fail("there is no text on the clipboard");
    return std::string(text);
}

} // namespace ramus::app
