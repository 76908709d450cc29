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
    for (const auto group : kCommandGroups)
        for (Command& command : group()) table.push_back(std::move(command));
    // Commands that add to a picture follow those that open one.
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
