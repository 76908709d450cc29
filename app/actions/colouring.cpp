// What colours say.
#include "app/actions/arguments.h"
#include "app/actions/groups.h"

#include <algorithm>

namespace ramus::app::actions {

namespace {

std::string all_names(const auto& things) {
    std::string names;
    for (const auto thing : things) names += (names.empty() ? "" : ", ") + std::string(name_of(thing));
    return names;
}

Result<void> colour_by(ActionContext& context, Arguments arguments) {
    const auto found = std::ranges::find_if(
        kColourings, [&](ColourBy quantity) { return arguments.size() == 1 && name_of(quantity) == arguments[0]; });
    if (found == kColourings.end()) return fail("colour-by takes a quantity", {}, "one of " + all_names(kColourings));
    Marks next = context.document.marks();
    next.colour_by = *found;
    context.document.change(std::move(next));
    return {};
}

Result<void> colour_map(ActionContext& context, Arguments arguments) {
    const auto found = std::ranges::find_if(
        kColourMaps, [&](ColourMap map) { return arguments.size() == 1 && name_of(map) == arguments[0]; });
    if (found == kColourMaps.end()) return fail("colour-map takes a name", {}, "one of " + all_names(kColourMaps));
    Marks next = context.document.marks();
    next.colour_map = *found;
    context.document.change(std::move(next));
    return {};
}

template <ColourBy quantity> bool colours_by(const Document& document) {
    return document.marks().colour_by == quantity;
}
template <ColourMap map> bool colours_with(const Document& document) { return document.marks().colour_map == map; }

template <ColourBy quantity> Command quantity_entry(const char* label, const char* help) {
    return Command("colour-by", "QUANTITY", help, colour_by)
        .in_menu("Colour", label)
        .giving({std::string(name_of(quantity))})
        .when(has_tree)
        .checked_when(colours_by<quantity>);
}

template <ColourMap map> Command map_entry(const char* label) {
    return Command("colour-map", "NAME", "Shows quantities in this colour map.", colour_map)
        .in_menu("Colour", label)
        .giving({std::string(name_of(map))})
        .when(has_tree)
        .checked_when(colours_with<map>);
}

} // namespace

std::vector<Command> colour_commands() {
    return {
        Command("colour-by", "QUANTITY",
                "Colours by nothing, state, generation, strahler, diameter, root-distance, lesion, label or branch.",
                colour_by),
        quantity_entry<ColourBy::kNothing>("One colour", "One colour for the whole tree."),
        quantity_entry<ColourBy::kState>("State", "Explains what is highlighted, defocused, selected and lost."),
        quantity_entry<ColourBy::kGeneration>("Generation", "Colours by the number of branchings from the root."),
        quantity_entry<ColourBy::kStrahler>("Strahler order", "Colours by Strahler order: 1 at the leaves."),
        quantity_entry<ColourBy::kDiameter>("Diameter", "Colours every place by how wide the vessel is there."),
        quantity_entry<ColourBy::kRootDistance>("Distance from root",
                                                "Colours every place by its way from the root along the vessels."),
        quantity_entry<ColourBy::kLesion>("Distance to lesion", "Colours the margins around the lesions."),
        quantity_entry<ColourBy::kLabel>("Names", "Colours named branches and what depends on them."),
        quantity_entry<ColourBy::kBranch>("Branch", "Tells neighbouring branches apart."),
        Command("colour-map", "NAME", "Shows quantities in viridis, cividis or magma.", colour_map),
        map_entry<ColourMap::kViridis>("Viridis"),
        map_entry<ColourMap::kCividis>("Cividis"),
        map_entry<ColourMap::kMagma>("Magma"),
    };
}

} // namespace ramus::app::actions
