// What tells near from far in the picture.
#include "app/actions/arguments.h"
#include "app/actions/groups.h"

namespace ramus::app::actions {

namespace {

std::string cue_names() {
    std::string names;
    for (const DepthCue& cue : depth_cues()) names += (names.empty() ? "" : ", ") + std::string(cue.name);
    return names;
}

Result<void> depth_cue(ActionContext& context, Arguments arguments) {
    const bool plain = arguments.size() == 1;
    const bool says = arguments.size() == 2 && (arguments[1] == "on" || arguments[1] == "off");
    const DepthCue* cue = plain || says ? depth_cue_named(arguments[0]) : nullptr;
    if (cue == nullptr) return fail("depth-cue takes a name, and on or off", {}, "the names are " + cue_names());
    return edit(context, [&](Marks& marks) {
        marks.depth_cues.set(*cue, plain ? !marks.depth_cues.has(*cue) : arguments[1] == "on");
    });
}

} // namespace

std::vector<Command> depth_commands() {
    std::vector<Command> commands{
        Command("depth-cue", "NAME [on|off]", "Switches what tells near from far: " + cue_names() + ".", depth_cue)};
    for (const DepthCue& cue : depth_cues())
        commands.push_back(
            Command("depth-cue", "NAME [on|off]", std::string(cue.help), depth_cue)
                .in_menu("View", std::string(cue.label))
                .giving({std::string(cue.name)})
                .when(has_tree)
                .checked_when([&cue](const Document& document) { return document.marks().depth_cues.has(cue); }));
    return commands;
}

} // namespace ramus::app::actions
