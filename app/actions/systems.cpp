// Commands of vessel systems: select, show and hide as a whole, name and colour.
#include "app/session/systems.h"

#include "app/actions/arguments.h"
#include "app/actions/groups.h"
#include "app/session/colour_by.h"

#include <algorithm>

namespace ramus::app::actions {

namespace {

using tree::BranchState;

// The branches of all systems in the arguments, in any order.
Result<std::vector<int>> named_branches(const Document& document, Arguments arguments, const std::string& command) {
    if (!has_tree(document)) return fail("there is no tree");
    if (arguments.empty()) return fail(command + " takes names of systems", {}, "put quotes around one with blanks");
    const Systems& systems = systems_of(*document.tree(), document.marks());
    std::vector<int> ids;
    for (const std::string& word : arguments) {
        RAMUS_TRY(system, find_system(systems, word));
        const std::vector<int> found = branches_in_system(*document.tree(), system);
        ids.insert(ids.end(), found.begin(), found.end());
    }
    return ids;
}

Result<void> select_system(ActionContext& context, Arguments arguments) {
    RAMUS_TRY(ids, named_branches(context.document, arguments, "select-system"));
    return select_these(context, std::move(ids));
}

Result<void> hide_system(ActionContext& context, Arguments arguments) {
    RAMUS_TRY(ids, named_branches(context.document, arguments, "hide-system"));
    return edit(context, [&](Marks& marks) { set_state(marks, ids, BranchState::kHidden); });
}

// Highlighted and defocused branches keep their state.
Result<void> show_system(ActionContext& context, Arguments arguments) {
    RAMUS_TRY(ids, named_branches(context.document, arguments, "show-system"));
    return edit(context, [&](Marks& marks) {
        std::erase_if(ids, [&](int id) { return state_of(marks, id) != BranchState::kHidden; });
        set_state(marks, ids, BranchState::kNormal);
    });
}

// Changes one system by change(systems, index), which fails for invalid values.
template <class Change>
Result<void> change_system(ActionContext& context, Arguments arguments, const char* usage, const Change& change) {
    if (!has_tree(context.document)) return fail("there is no tree");
    if (arguments.size() != 2) return fail(usage, {}, "put quotes around a name with blanks");
    const tree::VesselTree& tree = *context.document.tree();
    Systems systems = systems_of(tree, context.document.marks());
    RAMUS_TRY(system, find_system(systems, arguments[0]));
    if (Result<void> changed = change(systems, static_cast<std::size_t>(system)); !changed) return changed;
    return edit(context, [&](Marks& marks) { set_systems(marks, systems, tree); });
}

Result<void> name_system(ActionContext& context, Arguments arguments) {
    return change_system(context, arguments, "name-system takes a system and its new name",
                         [&](Systems& systems, std::size_t index) -> Result<void> {
                             const std::string& name = arguments[1];
                             if (name.empty()) return fail("a system needs a name");
                             for (std::size_t i = 0; i < systems.size(); ++i)
                                 if (i != index && systems[i].name == name)
                                     return fail("there is a system \"" + name + "\" already");
                             systems[index].name = name;
                             return {};
                         });
}

Result<void> colour_system(ActionContext& context, Arguments arguments) {
    return change_system(context, arguments, "colour-system takes a system and a colour: RRGGBB",
                         [&](Systems& systems, std::size_t index) -> Result<void> {
                             const auto colour = colour_in(arguments[1]);
                             if (!colour)
                                 return fail("\"" + arguments[1] + "\" is not a colour", {}, "RRGGBB: 3d6cb0, say");
                             systems[index].colour = *colour;
                             return {};
                         });
}

bool has_systems(const Document& document) { return document.tree() && !document.tree()->systems.empty(); }

} // namespace

std::vector<Command> system_commands() {
    return {
        Command("select-system", "NAME...",
                "Selects the branches of these systems and no others; a system is meant by its name or number.",
                select_system)
            .when(has_systems),
        Command("hide-system", "NAME...", "Hides all branches of these systems.", hide_system).when(has_systems),
        Command("show-system", "NAME...", "Shows what is hidden of these systems.", show_system).when(has_systems),
        Command("name-system", "NAME TEXT", "Gives a system another name.", name_system).when(has_systems),
        Command("colour-system", "NAME RRGGBB", "Gives a system another colour.", colour_system).when(has_systems),
    };
}

} // namespace ramus::app::actions
