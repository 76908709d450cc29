// The options of the surface.
#include "app/actions/arguments.h"
#include "app/actions/groups.h"
#include "app/session/surface_options.h"

namespace ramus::app::actions {

namespace {

Result<void> surface(ActionContext& context, Arguments arguments) {
    const auto refused = fail("surface takes a name and a value", {}, surface_command_help());
    if (arguments.size() != 2) return refused;
    Marks next = context.document.marks();
    if (arguments[0] == "method") {
        const auto method = mesh::method_named(arguments[1]);
        if (!method || !mesh::row_of(*method).of_tree) return refused;
        next.options.method = *method;
    } else {
        const SurfaceOption* option = surface_option(arguments[0]);
        if (option == nullptr || option->label.empty()) return refused;
        const auto value = number_in(arguments[1], option->least, option->most);
        if (!value || !takes(*option, *value)) return refused;
        option->set(next.options, *value);
    }
    context.document.change(std::move(next));
    return {};
}

} // namespace

std::vector<Command> surface_commands() {
    std::string names;
    for (const SurfaceOption& option : surface_options())
        if (!option.label.empty()) names.append(names.empty() ? "" : ", ").append(option.key);
    return {
        Command("surface", "NAME VALUE", "Sets " + names + " or method (cs, cones) of the surface.", surface),
    };
}

} // namespace ramus::app::actions
