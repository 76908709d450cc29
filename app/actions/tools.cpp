// Commands that select the tool of the mouse.
#include "app/actions/groups.h"
#include "app/tools/tool_kinds.h"
#include "core/base/words.h"

namespace ramus::app::actions {

namespace {

Result<void> tool(ActionContext& context, Arguments arguments) {
    const ToolKind* kind = arguments.size() == 1 ? find_tool(arguments[0]) : nullptr;
    if (kind == nullptr) return fail("tool takes the name of a tool", {}, joined(tool_kinds(), ", ", &ToolKind::name));
    if (context.tools == nullptr) return fail("there is no tool without a window");
    context.tools->use_tool(kind->name);
    return {};
}

bool is_in_hand(const ActionContext& context, const Command& entry) {
    return entry.preset.front() == (context.tools != nullptr ? context.tools->tool() : kNavigate);
}

} // namespace

std::vector<Command> tool_commands() {
    std::vector<Command> commands{Command(
        "tool", "NAME", "Gives the mouse a tool over the picture: navigate, lasso, lasso-polygon and others.", tool)};
    for (const ToolKind& kind : tool_kinds())
        commands.push_back(Command("tool", "NAME", kind.help, tool)
                               .in_menu("Tools", kind.label, kind.keys)
                               .giving({kind.name})
                               .in_use_when(is_in_hand));
    return commands;
}

} // namespace ramus::app::actions
