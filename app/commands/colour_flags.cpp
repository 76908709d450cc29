#include "app/commands/colour_flags.h"

#include "app/commands/command.h"
#include "app/session/colour_by.h"
#include "core/io/file_format.h"

#include <string_view>
#include <vector>

namespace ramus::app {

void add_colour_flags(CLI::App& command, ColourFlags& colours) {
    std::vector<std::string_view> keys;
    for (const ColouringRow& row : colourings()) keys.push_back(row.key);
    add_option(command, "--colour-by", "QUANTITY", colours.by,
               "Quantity that colours show: " + io::listed(keys) +
                   "; or data of the tree's file, by name or as file:NAME (default: the session's; system where a tree "
                   "has several, else nothing)");
    std::vector<std::string> maps;
    for (const ColourMap map : kColourMaps) maps.emplace_back(name_of(map));
    add_option(command, "--colour-map", "NAME", colours.map,
               "Colours of quantities: " + io::listed(std::vector<std::string_view>(maps.begin(), maps.end())))
        ->check(CLI::IsMember(maps).description(""));
    add_option(command, "--colour-range", "MIN,MAX", colours.range,
               "Values that the colours of a quantity begin and end at; auto: the least and the largest")
        ->check(expecting(" is not MIN,MAX, two numbers that ascend, or auto",
                          [](const std::string& text) { return text == "auto" || colour_range_in(text).has_value(); }));
    add_option(command, "--colour-log", "on|off", colours.logarithm,
               "Whether the colours of a quantity follow its logarithm; auto: as is usual for it")
        ->expected(0, 1)
        ->default_str("on")
        ->check(CLI::IsMember({"on", "off", "auto"}).description(""));
    add_option(command, "--legend", "on|off", colours.legend, "Whether the legend of the colours is shown")
        ->check(CLI::IsMember({"on", "off"}).description(""));
}

Result<void> apply(const ColourFlags& flags, const tree::VesselTree& tree, Marks& marks) {
    if (!flags.by.empty()) {
        RAMUS_TRY(by, colouring_of_tree(flags.by, tree));
        marks.colour_by = by;
    }
    marks.colour_map = colour_map_named(flags.map).value_or(marks.colour_map);
    ColourLook& look = marks.colour_look;
    if (!flags.range.empty()) look.range = colour_range_in(flags.range); // none: "auto"
    if (flags.logarithm == "auto") look.logarithmic.reset();
    if (flags.logarithm == "on" || flags.logarithm == "off") look.logarithmic = flags.logarithm == "on";
    if (!flags.legend.empty()) look.legend = flags.legend == "on";
    return check(look);
}

} // namespace ramus::app
