// The part of ViewerInput that is about tools.
#include "app/assets/measured.h"
#include "app/window/viewer_input.h"

#include <utility>

namespace ramus::app {

Pointing ViewerInput::pointing(Modifiers modifiers) {
    std::optional<SlicePointing> slice = slice_pointing();
    const glm::ivec2 size = slice ? slice->grid.size : picture_.picture_size();
    return {.at = in_viewport(pointer_),
            .modifiers = modifiers,
            .held = tool_mouse_.held(),
            .size = size,
            .pixel_ratio = state_.scale,
            .document = state_.workspace.document(),
            .settings = state_.interface.tool_settings,
            .lesions = lesion_shapes(state_.workspace.assets(), state_.workspace.document().marks()),
            .slice = slice};
}

void ViewerInput::tell_tool(Tool::Event event, const Pointing& pointing) {
    const auto tell = [this, event, pointing, tool = tools_taken_](const render::Pick& under) {
        if (tool != tools_taken_ || !state_.interface.tool) return;
        Pointing known = pointing;
        known.under = under;
        if (pointing.slice) {
            // A drag may leave the slice.
            const glm::dvec2 at = pointing.at;
            const glm::dvec2 size(pointing.size);
            if (!(at.x >= 0.0 && at.y >= 0.0 && at.x < size.x && at.y < size.y)) known.under = {};
            known.under.position = pointing.slice->grid.place(at - 0.5);
        }
        (state_.interface.tool.get()->*event)(known);
        perform_tool();
    };
    if (state_.interface.tool->picks()) return look_up(from_viewport(pointing.at), tell);
    tell({});
}

void ViewerInput::perform_tool() {
    const bool holds = state_.interface.tool && state_.interface.tool->changes_while_held();
    if (holds && !in_step_) state_.workspace.document().begin_step(), in_step_ = true;
    if (state_.interface.tool) run_commands_of(*state_.interface.tool);
    if (in_step_ && !holds) state_.workspace.document().end_step("drag"), in_step_ = false;
}

void ViewerInput::run_commands_of(Tool& tool) {
    for (const CommandLine& line : tool.take_commands()) state_.perform(line.front(), {line.begin() + 1, line.end()});
}

ToolDrawing ViewerInput::tool_drawing() {
    ToolDrawing drawing;
    if (tool_acts_here()) {
        const Pointing here = pointing(tool_mouse_.modifiers());
        drawing = state_.interface.tool->drawing(here);
        if (here.slice) drawing.part = ToolDrawing::Part{glm::ivec2(from_viewport(glm::dvec2(0.0))), here.size};
    }
    add_plane_outline(drawing);
    return drawing;
}

void ViewerInput::use_tool(std::string_view name) {
    const ToolKind* kind = find_tool(name);
    state_.interface.tool_kind = kind;
    state_.interface.tool = kind->make != nullptr ? kind->make() : nullptr;
    tool_mouse_.abandon();
    perform_tool(); // ends the step of what the tool before dragged
    ++tools_taken_;
    pick_wanted_ = true;
    state_.redraw();
}

bool ViewerInput::tool_acts_here() const {
    const auto& tool = state_.interface.tool;
    const auto grip = slice_grip();
    if (!tool || (grip && grip->along)) return false;
    return tool->works_on() != (grip ? WorksOn::kTree : WorksOn::kSlices);
}

bool ViewerInput::step_tool(double notches) {
    const auto& tool = state_.interface.tool;
    if (!tool || !tool->step(notches, state_.interface.tool_settings)) return false;
    perform_tool();
    return true;
}

} // namespace ramus::app
