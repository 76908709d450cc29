// The part of ViewerInput that is about slices.
#include "app/picture/slices.h"
#include "app/session/numbers.h"
#include "app/tools/slice_points_tool.h"
#include "app/window/viewer_input.h"
#include "core/measure/branch_point.h"

#include <algorithm>
#include <imgui.h>
#include <utility>

namespace ramus::app {

std::optional<SliceGrip> ViewerInput::slice_grip() const {
    const std::vector<Viewport> all = state_.viewports();
    const Viewport& here = all[std::min(viewport_, all.size() - 1)];
    if (!here.slice) return {};
    const Session& session = state_.workspace.document().session();
    const Assets& assets = state_.workspace.assets();
    SliceGrip grip{*here.slice, grid_of(session, assets, *here.slice, here.size),
                   session.slices.zooms[slice_index(*here.slice)]};
    for (const Scan& scan : session.marks.scans) {
        const auto file = scan.visible && !scan.labels ? assets.scan(scan) : nullptr;
        if (!file) continue;
        grip.window = window_of(scan, *file);
        break;
    }
    return grip;
}

void ViewerInput::take(const SliceChange& change) {
    Document& document = state_.workspace.document();
    SliceViews views = document.session().slices;
    if (change.crosshair) views.crosshair = change.crosshair;
    if (change.zoom) views.zooms[slice_index(slice_mouse_.grip().direction)] = *change.zoom;
    document.set_slices(views);
    if (!change.window) return;
    // A drag of the window is one step of undo.
    if (!std::exchange(windows_, true)) document.begin_step();
    state_.perform("window", {exact_text(change.window->width) + "," + exact_text(change.window->level)});
}

std::optional<SliceSpot> ViewerInput::slice_spot(glm::dvec2 in_viewport) const {
    const auto grip = slice_grip();
    if (!grip) return {};
    return SliceSpot{grip->direction, grip->grid.place(in_viewport - 0.5)};
}

// The second press of a double click makes the slice large, or brings the earlier layout back.
void ViewerInput::press_slice(MouseButton button, Modifiers modifiers, const SliceGrip& grip, double now) {
    if (button == MouseButton::kLeft && state_.interface.tool_kind->name == kSlicePoints) {
        // The place on the slice, as if the slice were one among the vessels.
        Pointing here = pointing(modifiers);
        here.under = {.position = grip.grid.place(in_viewport(pointer_) - 0.5), .plane = 0};
        state_.interface.tool->press(here);
        state_.interface.tool->release(here);
        show_slices_at(here.under.position);
        return perform_tool();
    }
    if (!slice_mouse_.twice(button, modifiers, in_picture(pointer_), now))
        return take(slice_mouse_.press(button, modifiers, in_viewport(pointer_), grip));
    const SliceLayout layout = state_.workspace.document().session().slices.layout;
    const bool alone = slices_of(layout).size() == 1;
    state_.perform("layout", {std::string(alone ? name_of(layout_before_) : slice::name_of(grip.direction))});
    layout_before_ = alone ? SliceLayout::kSlices : layout;
}

void ViewerInput::release_slice(MouseButton button) {
    const auto click = slice_mouse_.release(button, in_viewport(pointer_));
    if (!slice_mouse_.held() && std::exchange(windows_, false)) state_.workspace.document().end_step("window");
    if (click) clicked(*click);
    pick_wanted_ = true;
}

void ViewerInput::turn_wheel_over_slice(const SliceGrip& grip, double notches) {
    if (!ImGui::GetIO().KeyCtrl)
        return state_.perform("slice-step", {std::string(slice::name_of(grip.direction)), exact_text(notches)});
    SliceViews views = state_.workspace.document().session().slices;
    views.zooms[slice_index(grip.direction)] = SliceMouse::zoomed(grip, in_viewport(pointer_), notches);
    state_.workspace.document().set_slices(views);
}

// The place under the pointer, for the status bar.
void ViewerInput::point_at_slice() {
    const auto grip = over_picture(pointer_) ? slice_grip() : std::nullopt;
    state_.interface.slice_place = grip ? std::optional(grip->grid.place(in_viewport(pointer_) - 0.5)) : std::nullopt;
}

// Slices go through the middle of the vessel that was clicked on.
void ViewerInput::show_slices_at(const render::Pick& pick) {
    const auto& tree = state_.workspace.document().tree();
    show_slices_at(
        measure::point_on(*tree, pick.branch, measure::nearest_fraction(*tree, pick.branch, pick.position)).position);
}

void ViewerInput::show_slices_at(const glm::dvec3& place) {
    SliceViews views = state_.workspace.document().session().slices;
    views.crosshair = place;
    state_.workspace.document().set_slices(views);
}

} // namespace ramus::app
