// Commands of depth cues.
#include "app/actions/arguments.h"
#include "app/actions/groups.h"
#include "core/base/words.h"

namespace ramus::app::actions {

namespace {

std::string cue_names() { return joined(depth_cues(), ", ", &DepthCue::name); }

Result<void> depth_cue(ActionContext& context, Arguments arguments) {
    const DepthCue* cue = arguments.empty() ? nullptr : depth_cue_named(arguments[0]);
    const auto on =
        cue != nullptr ? switched(arguments.subspan(1), context.document.marks().depth_cues.has(*cue)) : std::nullopt;
    if (!on) return fail("depth-cue takes a name, and on or off", {}, "the names are " + cue_names());
    return edit(context, [&](Marks& marks) { marks.depth_cues.set(*cue, *on); });
}

} // namespace

std::vector<Command> depth_commands() {
    std::vector<Command> commands{
        Command("depth-cue", "NAME [on|off]", "Switches what tells near from far: " + cue_names() + ".", depth_cue)};
    for (const DepthCue& cue : depth_cues())
        commands.push_back(
            Command("depth-cue", "NAME [on|off]", std::string(cue.help), depth_cue)
                .in_menu("View", std::string(cue.label))
                .in_submenu("Depth")
                .giving({std::string(cue.name)})
                .when(has_tree)
                .checked_when([&cue](const Document& document) { return document.marks().depth_cues.has(cue); }));
    return commands;
}

} // namespace ramus::app::actions
