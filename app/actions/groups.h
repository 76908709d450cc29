// The groups of the command table, one file each, with the actions of their commands.
#pragma once

#include "app/actions/command_table.h"

#include <array>
#include <vector>

namespace ramus::app::actions {

[[nodiscard]] std::vector<Command> file_commands();
[[nodiscard]] Command export_command(); // one of file_commands()
[[nodiscard]] std::vector<Command> history_commands();
[[nodiscard]] std::vector<Command> editing_commands();
[[nodiscard]] std::vector<Command> selection_commands();
[[nodiscard]] std::vector<Command> relation_commands();
[[nodiscard]] std::vector<Command> state_commands();
[[nodiscard]] std::vector<Command> system_commands();
[[nodiscard]] std::vector<Command> surgery_commands();
[[nodiscard]] std::vector<Command> organ_commands();
[[nodiscard]] std::vector<Command> resection_commands();
[[nodiscard]] std::vector<Command> plan_commands();
[[nodiscard]] std::vector<Command> lesion_vessel_commands();
[[nodiscard]] std::vector<Command> object_commands();
[[nodiscard]] std::vector<Command> context_commands();
// Rereads all context in this unit; "auto": in the units of the files.
[[nodiscard]] Result<Outcome> read_context_in(ActionContext& context, const std::string& units);
[[nodiscard]] std::vector<Command> measure_commands();
[[nodiscard]] std::vector<Command> pin_commands();
[[nodiscard]] std::vector<Command> scan_commands();
[[nodiscard]] std::vector<Command> slice_commands();
[[nodiscard]] std::vector<Command> region_commands();
[[nodiscard]] std::vector<Command> along_commands();
[[nodiscard]] std::vector<Command> report_commands();
[[nodiscard]] std::vector<Command> page_commands();
[[nodiscard]] std::vector<Command> reading_commands();
[[nodiscard]] std::vector<Command> camera_commands();
[[nodiscard]] std::vector<Command> saved_view_commands();
[[nodiscard]] std::vector<Command> turning_commands();
[[nodiscard]] std::vector<Command> colour_commands();
[[nodiscard]] std::vector<Command> deviation_commands();
[[nodiscard]] std::vector<Command> depth_commands();
[[nodiscard]] std::vector<Command> compare_commands();
[[nodiscard]] std::vector<Command> contact_commands();
[[nodiscard]] std::vector<Command> validation_commands();
[[nodiscard]] std::vector<Command> glass_commands();
[[nodiscard]] std::vector<Command> surface_commands();
[[nodiscard]] std::vector<Command> tool_commands();
[[nodiscard]] std::vector<Command> lasso_commands();
[[nodiscard]] std::vector<Command> travel_commands();
[[nodiscard]] std::vector<Command> overview_commands();
[[nodiscard]] std::vector<Command> window_commands();

// In the order of the menus. A new group of commands is a file, a declaration above and an entry here.
inline constexpr std::array kCommandGroups{
    file_commands,          //
    history_commands,       //
    editing_commands,       //
    selection_commands,     //
    relation_commands,      //
    tool_commands,          //
    lasso_commands,         //
    state_commands,         //
    system_commands,        //
    glass_commands,         //
    surgery_commands,       //
    organ_commands,         //
    resection_commands,     //
    plan_commands,          //
    lesion_vessel_commands, //
    object_commands,        //
    context_commands,       //
    measure_commands,       //
    pin_commands,           //
    scan_commands,          //
    slice_commands,         //
    region_commands,        //
    along_commands,         //
    report_commands,        //
    page_commands,          //
    reading_commands,       //
    contact_commands,       //
    validation_commands,    //
    camera_commands,        //
    saved_view_commands,    //
    turning_commands,       //
    travel_commands,        //
    depth_commands,         //
    compare_commands,       //
    overview_commands,      //
    colour_commands,        //
    deviation_commands,     //
    surface_commands,       //
    window_commands,        //
};

} // namespace ramus::app::actions
