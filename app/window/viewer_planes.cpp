// The part of ViewerInput that is about slices among the vessels.
#include "app/picture/slices.h"
#include "app/session/numbers.h"
#include "app/window/viewer_input.h"

#include <glm/common.hpp>
#include <imgui.h>

namespace ramus::app {

PlaneSight ViewerInput::plane_sight() const { return {picture_.shown_camera(), picture_.picture_size(), state_.scale}; }

// A vessel under the pointer is nearer than what a person could mean by an edge behind it.
void ViewerInput::point_at_plane() {
    const bool free = over_picture(pointer_) && !state_.interface.tool && !mouse_.held() && !slice_mouse_.held() &&
                      !state_.interface.wipe_held && state_.interface.hovered == tree::kNoBranch && !slice_grip();
    const std::vector<render::ScanPlane> planes = picture_.scan_planes();
    auto edge = free && !planes.empty() ? edge_under(planes, plane_sight(), in_viewport(pointer_)) : std::nullopt;
    if (plane_mouse_.held()) return;
    if (edge.has_value() != plane_edge_.has_value()) state_.redraw();
    plane_edge_ = edge;
}

bool ViewerInput::grab_plane() {
    point_at_plane();
    const Session& session = state_.workspace.document().session();
    const std::vector<slice::Direction> shown = slices_among_vessels(session.slices);
    if (!plane_edge_ || plane_edge_->plane >= shown.size()) return false;
    plane_mouse_.grab(*plane_edge_, shown[plane_edge_->plane], crosshair_of(session, state_.workspace.assets()),
                      in_viewport(pointer_));
    return true;
}

void ViewerInput::drag_plane() {
    const Session& session = state_.workspace.document().session();
    const auto volume = first_volume(session, state_.workspace.assets());
    const Bounds<glm::dvec3> bounds = volume ? slice::bounds_of(*volume) : Bounds<glm::dvec3>{};
    const glm::dvec3 place = plane_mouse_.move(plane_sight(), bounds, in_viewport(pointer_));
    if (plane_mouse_.dragging()) show_slices_at(place);
}

void ViewerInput::release_plane() {
    plane_mouse_.release();
    point_at_plane();
    pick_wanted_ = true;
    state_.redraw();
}

bool ViewerInput::turn_wheel_over_plane(double notches) {
    const std::vector<slice::Direction> shown = slices_among_vessels(state_.workspace.document().session().slices);
    const bool inside = ImGui::GetIO().KeyCtrl && plane_under_ != render::kNoPlane;
    const std::size_t plane = plane_edge_ ? plane_edge_->plane : static_cast<std::size_t>(plane_under_);
    if (plane_mouse_.held() || !(plane_edge_ || inside) || plane >= shown.size()) return false;
    state_.perform("slice-step", {std::string(slice::name_of(shown[plane])), exact_text(notches)});
    return true;
}

// Drawn over the picture, which need not be drawn again for it.
void ViewerInput::add_plane_outline(ToolDrawing& drawing) const {
    if (!plane_edge_) return;
    const std::vector<render::ScanPlane> planes = picture_.scan_planes();
    if (plane_edge_->plane >= planes.size()) return;
    const render::ScanPlane& plane = planes[plane_edge_->plane];
    drawing.lines.push_back(
        {outline_of(plane, plane_sight()), glm::vec4(glm::mix(plane.outline, glm::vec3(1.0F), 0.35F), 1.0F), 3.0F});
}

} // namespace ramus::app
