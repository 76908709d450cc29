// What colours say.
#include "app/actions/arguments.h"
#include "app/actions/groups.h"

#include <algorithm>

namespace ramus::app::actions {

namespace {

Result<void> colour_by(ActionContext& context, Arguments arguments) {
    const auto found = std::find_if(kColourings.begin(), kColourings.end(), [&](ColourBy quantity) {
        return arguments.size() == 1 && name_of(quantity) == arguments[0];
    });
    if (found == kColourings.end())
        return fail("colour-by takes a quantity", {}, "nothing, generation, strahler, diameter or branch");
    Marks next = context.document.marks();
    next.colour_by = *found;
    context.document.change(std::move(next));
    return {};
}

template <ColourBy quantity> bool colours_by(const Document& document) {
    return document.marks().colour_by == quantity;
}

} // namespace

std::vector<Command> colour_commands() {
    return {
        {"colour-by",
         "QUANTITY",
         "Colours branches by nothing, generation, strahler, diameter or branch.",
         "",
         "",
         {},
         colour_by},
        {"colour-by",
         "QUANTITY",
         "One colour for the whole tree.",
         "Colour",
         "One colour",
         {},
         colour_by,
         {"nothing"},
         has_tree,
         colours_by<ColourBy::kNothing>},
        {"colour-by",
         "QUANTITY",
         "Colours by the number of branchings from the root.",
         "Colour",
         "Generation",
         {},
         colour_by,
         {"generation"},
         has_tree,
         colours_by<ColourBy::kGeneration>},
        {"colour-by",
         "QUANTITY",
         "Colours by Strahler order: 1 at the leaves.",
         "Colour",
         "Strahler order",
         {},
         colour_by,
         {"strahler"},
         has_tree,
         colours_by<ColourBy::kStrahler>},
        {"colour-by",
         "QUANTITY",
         "Colours by mean diameter.",
         "Colour",
         "Diameter",
         {},
         colour_by,
         {"diameter"},
         has_tree,
         colours_by<ColourBy::kDiameter>},
        {"colour-by",
         "QUANTITY",
         "Tells neighbouring branches apart.",
         "Colour",
         "Branch",
         {},
         colour_by,
         {"branch"},
         has_tree,
         colours_by<ColourBy::kBranch>},
    };
}

} // namespace ramus::app::actions
