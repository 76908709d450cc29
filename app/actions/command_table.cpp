#include "app/actions/command_table.h"

#include "app/actions/groups.h"

#include <algorithm>
#include <string_view>
#include <utility>

namespace ramus::app {

namespace {

std::vector<Command> make_table() {
    using namespace actions;
    std::vector<Command> table;
    for (auto part : {
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
             lesion_vessel_commands, //
             context_commands,       //
             measure_commands,       //
             report_commands,        //
             reading_commands,       //
             contact_commands,       //
             validation_commands,    //
             camera_commands,        //
             turning_commands,       //
             travel_commands,        //
             depth_commands,         //
             compare_commands,       //
             overview_commands,      //
             colour_commands,        //
             deviation_commands,     //
             surface_commands,       //
             window_commands,        //
         })
        for (Command& command : part()) table.push_back(std::move(command));
    // What adds to a picture stands behind what opens one.
    const auto named = [&](std::string_view name) {
        return std::ranges::find_if(table, [&](const Command& c) { return c.name == name && !c.menu.empty(); });
    };
    for (const std::string_view name : {"data", "context"}) {
        const auto added = named(name);
        std::rotate(named("open") + 1, added, added + 1);
    }
    return table;
}

} // namespace

const std::vector<Command>& command_table() {
    static const std::vector<Command> table = make_table();
    return table;
}

const Command* find_command(std::string_view name) {
    const auto& table = command_table();
    const auto found =
        std::find_if(table.begin(), table.end(), [&](const Command& c) { return c.name == name && c.scripted(); });
    return found == table.end() ? nullptr : &*found;
}

const Command* command_for_key(std::string_view key) {
    for (const Command& command : command_table())
        if (std::find(command.keys.begin(), command.keys.end(), key) != command.keys.end()) return &command;
    return nullptr;
}

std::string label_of(const Command& command, const Document& document) {
    return document.lengths().worded(command.label_now == nullptr ? command.label : command.label_now(document));
}

} // namespace ramus::app
