// Commands of colours.
#include "app/actions/arguments.h"
#include "app/actions/groups.h"
#include "core/base/words.h"
#include "core/io/file_format.h"

#include <algorithm>

namespace ramus::app::actions {

namespace {

Result<void> colour_by(ActionContext& context, Arguments arguments) {
    if (arguments.size() != 1)
        return fail("colour-by takes a quantity", {}, "one of " + joined(colourings(), ", ", &ColouringRow::key));
    const tree::VesselTree none;
    const auto& tree = context.document.tree();
    RAMUS_TRY(found, colouring_of_tree(arguments[0], tree ? *tree : none));
    return edit(context, [&](Marks& marks) { marks.colour_by = found; });
}

Result<void> colour_map(ActionContext& context, Arguments arguments) {
    const auto found = arguments.size() == 1 ? colour_map_named(arguments[0]) : std::nullopt;
    if (!found)
        return fail("colour-map takes a name", {},
                    "one of " + joined(kColourMaps, ", ", [](ColourMap map) { return name_of(map); }));
    return edit(context, [&](Marks& marks) { marks.colour_map = *found; });
}

// Range and logarithm must be compatible.
Result<void> take_look(ActionContext& context, const ColourLook& look) {
    if (auto good = check(look); !good) return good;
    return edit(context, [&](Marks& marks) { marks.colour_look = look; });
}

Result<void> colour_range(ActionContext& context, Arguments arguments) {
    ColourLook look = context.document.marks().colour_look;
    look.range = arguments.size() == 1 ? colour_range_in(arguments[0]) : std::nullopt;
    if (!look.range && !(arguments.size() == 1 && arguments[0] == "auto"))
        return fail("colour-range takes the least and the largest value", {},
                    "colour-range 5,80, or colour-range auto");
    return take_look(context, look);
}

Result<void> colour_log(ActionContext& context, Arguments arguments) {
    ColourLook look = context.document.marks().colour_look;
    look.logarithmic = arguments.size() == 1 ? switched(arguments, false) : std::nullopt;
    if (!look.logarithmic && !(arguments.size() == 1 && arguments[0] == "auto"))
        return fail("colour-log takes on, off or auto", {}, "auto: as is usual for the quantity");
    return take_look(context, look);
}

Result<void> legend(ActionContext& context, Arguments arguments) {
    ColourLook look = context.document.marks().colour_look;
    const auto on = switched(arguments, look.legend);
    if (!on) return fail("legend takes on or off", {}, "without a word it switches");
    look.legend = *on;
    return take_look(context, look);
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
        Command("colour-by", "QUANTITY",
                "Colours by " + io::listed(keys) + "; by data of the tree's file, NAME or file:NAME.", colour_by)};
    for (const ColouringRow& row : colourings()) commands.push_back(colouring_entry(row));
    commands.emplace_back("colour-map", "NAME",
                          "Shows quantities in " +
                              joined(kColourMaps, ", ", [](ColourMap map) { return name_of(map); }) + ".",
                          colour_map);
    for (const auto& [map, label] :
         {std::pair(ColourMap::kViridis, "Viridis"), std::pair(ColourMap::kCividis, "Cividis"),
          std::pair(ColourMap::kMagma, "Magma"), std::pair(ColourMap::kPlasma, "Plasma"),
          std::pair(ColourMap::kCoolwarm, "Cool to warm"), std::pair(ColourMap::kGrey, "Grey")})
        commands.push_back(map_entry(map, label));
    commands.emplace_back("colour-range", "MIN,MAX|auto",
                          "Says which values the colours of a quantity begin and end at; auto: the least and the "
                          "largest.",
                          colour_range);
    commands.emplace_back("colour-log", "on|off|auto",
                          "Lets the colours of a quantity follow its logarithm; auto: as is usual for it.", colour_log);
    commands.push_back(Command("legend", "[on|off]", "Shows or hides the legend of the colours.", legend)
                           .in_menu("Colour", "Legend")
                           .when(has_tree)
                           .checked_when([](const Document& document) { return document.marks().colour_look.legend; }));
    return commands;
}

} // namespace ramus::app::actions
