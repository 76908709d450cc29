// Declares what draws each part of the interface, and lists dialogs and the panels over the picture's left edge. To add
// a dialog, see app/window/README.md.
#pragma once

#include "app/panels/branch_list.h"
#include "app/panels/command_palette.h"
#include "app/panels/error_dialog.h"
#include "app/panels/help_overlay.h"
#include "app/panels/interface.h"
#include "app/panels/open_dialog.h"
#include "app/panels/radius_dialog.h"
#include "app/panels/recovery_dialogs.h"
#include "app/panels/rename_dialog.h"
#include "app/panels/volume_dialog.h"

namespace ramus::app {

void draw_menu_bar(InterfaceContext& context);
void draw_welcome(InterfaceContext& context);
void draw_tool_drawing(InterfaceContext& context);
void draw_tool_bar(InterfaceContext& context);
void draw_side_panel(InterfaceContext& context);
void draw_mask_row(InterfaceContext& context, const Comparison& comparison); // its mask
// Returns how far down the section wants to reach, from the upper end of what scrolls, in pixels.
float draw_selection(InterfaceContext& context); // as high for one branch, several and none
void draw_branch_list(InterfaceContext& context);
[[nodiscard]] float least_branch_list_height(const BranchList& list); // with its title, in pixels
void draw_branch_window(InterfaceContext& context);                   // the list in a window of its own
void draw_overview(InterfaceContext& context);
void draw_fly(InterfaceContext& context);
void draw_doctor(InterfaceContext& context);
void draw_units_panel(InterfaceContext& context);
void draw_warnings(InterfaceContext& context);
// The mark of warnings in the status bar, left of `right_edge`; returns its own left edge.
[[nodiscard]] float draw_warning_mark(InterfaceContext& context, float right_edge);
// The numbers of selected, defocused and hidden branches, each a button that undoes it, left of `right_edge`; returns
// its own left edge.
[[nodiscard]] float draw_state_marks(InterfaceContext& context, float right_edge);
void draw_contacts(InterfaceContext& context);
void draw_validation(InterfaceContext& context);
[[nodiscard]] widgets::Fact
contacts_fact(InterfaceContext& context); // in the side panel: how many there are, and the way there
void draw_mask_reading(InterfaceContext& context, const io::MaskReading& mask); // in the import doctor's panel
[[nodiscard]] widgets::Fact
doctor_fact(InterfaceContext& context); // in the side panel: what there is to see, and the way there
void draw_rename(InterfaceContext& context);
void draw_radius(InterfaceContext& context);
void draw_status_bar(InterfaceContext& context);
void draw_tooltip(InterfaceContext& context);
void draw_branch_tooltip(InterfaceContext& context, int id); // at the pointer, wherever that is
void draw_help(InterfaceContext& context);
void draw_command_palette(InterfaceContext& context);
void draw_context_menu(InterfaceContext& context);
void draw_open_dialog(InterfaceContext& context);
// What is exported, and how; the name follows the format. As high for every kind, so that the files below stay.
void draw_export_page(InterfaceContext& context, OpenDialog& dialog);
void draw_error_dialog(InterfaceContext& context);
void draw_recovery_dialog(InterfaceContext& context);
void draw_unsaved_dialog(InterfaceContext& context);
void draw_quit_dialog(InterfaceContext& context);
void draw_volume_dialog(InterfaceContext& context);
void draw_written(InterfaceContext& context);

// A state's own open() or `open`, and its own close() or `open`.
template <class State> [[nodiscard]] bool is_open(const State& state) {
    if constexpr (requires { state.open(); })
        return state.open();
    else
        return state.open;
}
template <class State> void close(State& state) {
    if constexpr (requires { state.close(); })
        state.close();
    else
        state.open = false;
}

struct DialogRow {
    void (*draw)(InterfaceContext& context);
    bool (*is_open)(const Interface& interface);
    void (*close)(Interface& interface);
};
template <class State> constexpr DialogRow dialog_row(void (*draw)(InterfaceContext& context)) {
    return {draw, [](const Interface& interface) { return is_open(interface.of<State>()); },
            [](Interface& interface) { close(interface.of<State>()); }};
}
// In drawing order. If several dialogs are open, the first one is shown, and Escape closes it.
inline constexpr DialogRow kDialogs[] = {
    dialog_row<ErrorDialog>(draw_error_dialog),
    dialog_row<UnsavedDialog>(draw_unsaved_dialog),
    dialog_row<QuitDialog>(draw_quit_dialog),
    dialog_row<RecoveryDialog>(draw_recovery_dialog),
    dialog_row<VolumeDialog>(draw_volume_dialog),
    dialog_row<OpenDialog>(draw_open_dialog),
    dialog_row<CommandPalette>(draw_command_palette),
    dialog_row<Help>(draw_help),
    dialog_row<RadiusDialog>(draw_radius),
    dialog_row<Rename>(draw_rename),
};

// Over the picture's left edge, one at a time (Interface::show_left()).
inline constexpr void (*kLeftPanels[])(InterfaceContext& context) = {
    draw_welcome, draw_doctor, draw_units_panel, draw_warnings, draw_contacts, draw_validation,
};

} // namespace ramus::app
