// Commands for options of the surface.
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
        const auto value = value_in(*option, arguments[1]);
        if (!value) return refused;
        option->set(next.options, *value);
    }
    context.document.change(std::move(next));
    return {};
}

Result<void> blend(ActionContext& context, Arguments arguments) {
    // Without a word the next row.
    const auto now = static_cast<std::size_t>(context.document.marks().options.blend);
    mesh::Blend wanted = mesh::kBlends[(now + 1) % mesh::kBlends.size()].blend;
    if (!arguments.empty()) {
        const auto named = mesh::blend_named(arguments[0]);
        if (!named || arguments.size() > 1)
            return fail("blend is one of " + mesh::blend_keys(), {}, mesh::blend_help());
        wanted = *named;
    }
    return edit(context, [&](Marks& marks) { marks.options.blend = wanted; });
}

} // namespace

std::vector<Command> surface_commands() {
    std::string names;
    for (const SurfaceOption& option : surface_options())
        if (!option.label.empty()) names.append(names.empty() ? "" : ", ").append(option.key);
    return {
        Command("surface", "NAME VALUE", "Sets " + names + " or method (cs, cones) of the surface.", surface),
        Command("blend", "[" + mesh::blend_keys() + "]", "Where vessels blend. " + mesh::blend_help() + ".", blend)
            .when(has_tree),
    };
}

} // namespace ramus::app::actions
