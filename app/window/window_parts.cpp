#include "app/window/window_parts.h"

#include <imgui.h>

namespace ramus::app {

void WindowParts::toggle(std::string_view part) {
    Interface& interface = state_.interface;
    if (part == "help")
        interface.help_open = !interface.help_open;
    else if (part == "palette")
        interface.palette.toggle();
    else if (part == "menu")
        interface.want_menu = !interface.menu_open, interface.close_menu = interface.menu_open;
    else if (part == "overview")
        interface.overview.open = !interface.overview.open;
    else if (part == "doctor")
        interface.open_left_panel(interface.doctor.open ? nullptr : &interface.doctor.open);
    else if (part == "warnings")
        interface.open_left_panel(interface.warnings.open ? nullptr : &interface.warnings.open);
    else if (part == "orientation")
        show_units_panel(!interface.units_panel.open);
    else if (part == "contacts")
        show_contacts(!interface.contacts.open);
    else if (part == "branches")
        interface.list.apart = !interface.list.apart;
    else if (part == "validation")
        show_validation(!interface.validation.open);
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
    for (const PanelPage page : {PanelPage::kExplore, PanelPage::kSurface, PanelPage::kPlan})
        if (name == key_of(page)) interface.page = page;
}

bool WindowParts::shows(std::string_view part) const {
    const Interface& interface = state_.interface;
    return part == "fly-along"     ? interface.fly.open
           : part == "overview"    ? interface.overview.open
           : part == "help"        ? interface.help_open
           : part == "palette"     ? interface.palette.open
           : part == "doctor"      ? interface.doctor.open
           : part == "orientation" ? interface.units_panel.open
           : part == "warnings"    ? interface.warnings.open
           : part == "contacts"    ? interface.contacts.open
           : part == "branches"    ? interface.list.apart
           : part == "validation"  ? interface.validation.open
                                   : interface.panel_open;
}

void WindowParts::set_overview(std::string_view setting) {
    Overview& overview = state_.interface.overview;
    overview.open = setting != "off";
    if (setting == "generation") overview.depth = OverviewDepth::kGeneration;
    if (setting == "distance") overview.depth = OverviewDepth::kDistance;
    state_.redraw();
}

void WindowParts::open_flight(int branch) {
    Fly& fly = state_.interface.fly;
    fly.open = true;
    fly.playing = false;
    fly.branch = branch;
    fly.fraction = 0.0;
    fly.selection = state_.workspace.document().marks().selection;
    state_.redraw();
}

void WindowParts::close_flight() {
    state_.interface.fly.open = state_.interface.fly.playing = false;
    state_.redraw();
}

void WindowParts::ask_for_name(int branch) {
    const Marks& marks = state_.workspace.document().marks();
    const BranchNames& names = marks.names;
    state_.interface.rename.show(branch, names.contains(branch) ? names.at(branch) : std::string{},
                                 names_subtree(marks, branch));
    state_.redraw();
}

void WindowParts::ask_for_object_name(const std::string& kind, const std::string& number, const std::string& now) {
    state_.interface.rename.show_object(kind, number, now);
    state_.redraw();
}

void WindowParts::ask_for_radius() {
    RadiusDialog& dialog = state_.interface.radius;
    dialog.open = dialog.fresh = true;
    state_.redraw();
}

void WindowParts::show_note(int note) {
    state_.interface.open_left_panel(&state_.interface.doctor.open);
    state_.interface.doctor.current = note;
    state_.redraw();
}

void WindowParts::wrote(const std::filesystem::path& file, const std::string& sentence) {
    state_.interface.written = {state_.watched(), file, sentence};
    state_.redraw();
}

void WindowParts::read_warnings() {
    state_.interface.warnings.list.mark_all_read();
    state_.redraw();
}

void WindowParts::show_units_panel(bool open) {
    Interface& interface = state_.interface;
    interface.open_left_panel(nullptr);
    if (open) interface.units_panel.show(said_of(state_.workspace.document()));
}

void WindowParts::show_contacts(bool open) {
    Interface& interface = state_.interface;
    interface.contacts.open = open;
    if (open) interface.open_left_panel(&interface.contacts.open);
    state_.workspace.want_contacts(open);
}

void WindowParts::show_contact(int contact) {
    show_contacts(true);
    state_.interface.contacts.current = contact;
    state_.interface.contacts.of = state_.workspace.assets().contacts.list;
    state_.redraw();
}

void WindowParts::show_validation(bool open) {
    Interface& interface = state_.interface;
    interface.validation.open = open;
    if (open) interface.open_left_panel(&interface.validation.open);
    state_.workspace.want_validation(open);
}

void WindowParts::show_finding(int finding) {
    show_validation(true);
    state_.interface.validation.current = finding;
    state_.interface.validation.of = state_.workspace.assets().validation.findings;
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
