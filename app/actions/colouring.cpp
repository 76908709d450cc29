// What colours say.
#include "app/actions/arguments.h"
#include "app/actions/groups.h"
#include "core/base/words.h"
#include "core/io/file_format.h"

#include <algorithm>

namespace ramus::app::actions {

namespace {

Result<void> colour_by(ActionContext& context, Arguments arguments) {
    const auto found = arguments.size() == 1 ? colouring_named(arguments[0]) : std::nullopt;
    if (!found)
        return fail("colour-by takes a quantity", {}, "one of " + joined(colourings(), ", ", &ColouringRow::key));
    return edit(context, [&](Marks& marks) { marks.colour_by = *found; });
}

Result<void> colour_map(ActionContext& context, Arguments arguments) {
    const auto found = arguments.size() == 1 ? colour_map_named(arguments[0]) : std::nullopt;
    if (!found)
        return fail("colour-map takes a name", {},
                    "one of " + joined(kColourMaps, ", ", [](ColourMap map) { return name_of(map); }));
    return edit(context, [&](Marks& marks) { marks.colour_map = *found; });
}

Command colouring_entry(const ColouringRow& row) {
    return Command("colour-by", "QUANTITY", std::string(row.help), colour_by)
        .in_menu("Colour", std::string(row.label))
        .giving({std::string(row.key)})
        .when(has_tree)
        .checked_when([by = row.by](const Document& document) { return document.marks().colour_by == by; });
}

Command map_entry(ColourMap map, const char* label) {
    return Command("colour-map", "NAME", "Shows quantities in this colour map.", colour_map)
        .in_menu("Colour", label)
        .giving({std::string(name_of(map))})
        .when(has_tree)
        .checked_when([map](const Document& document) { return document.marks().colour_map == map; });
}

} // namespace

std::vector<Command> colour_commands() {
    std::vector<std::string_view> keys;
    for (const ColouringRow& row : colourings()) keys.push_back(row.key);
    std::vector<Command> commands = {
        Command("colour-by", "QUANTITY", "Colours by " + io::listed(keys) + ".", colour_by)};
    for (const ColouringRow& row : colourings()) commands.push_back(colouring_entry(row));
    commands.emplace_back("colour-map", "NAME", "Shows quantities in viridis, cividis or magma.", colour_map);
    commands.push_back(map_entry(ColourMap::kViridis, "Viridis"));
    commands.push_back(map_entry(ColourMap::kCividis, "Cividis"));
    commands.push_back(map_entry(ColourMap::kMagma, "Magma"));
    return commands;
}

} // namespace ramus::app::actions
