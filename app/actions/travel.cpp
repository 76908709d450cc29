// Where the camera goes by itself: to a branch.
#include "app/actions/arguments.h"
#include "app/actions/groups.h"

#include <glm/common.hpp>

namespace ramus::app::actions {

namespace {

// The point halfway along a branch.
glm::dvec3 middle_of(const tree::VesselTree& tree, int id) {
    const tree::Branch& branch = tree.branches[static_cast<std::size_t>(id)];
    double left = 0.5 * tree::length_mm(tree, branch);
    for (std::size_t i = 1; i < branch.points.size(); ++i) {
        const glm::dvec3& from = tree.points[branch.points[i - 1]].position;
        const glm::dvec3& to = tree.points[branch.points[i]].position;
        const double step = glm::distance(from, to);
        if (step >= left && step > 0.0) return glm::mix(from, to, left / step);
        left -= step;
    }
    return tree.points[branch.points.back()].position;
}

Result<void> centre(ActionContext& context, Arguments arguments) {
    if (arguments.size() != 1) return fail("centre takes the id of a branch");
    const auto id = branch_id(context.document, arguments[0]);
    if (!id) return tl::unexpected(id.error());
    context.document.set_camera(
        render::centred_on(context.document.session().camera, middle_of(*context.document.tree(), *id)));
    context.host.camera_moved();
    return {};
}

} // namespace

std::vector<Command> travel_commands() {
    return {
        {"centre", "ID", "Brings the middle of a branch into the middle of the picture.", "", "", {}, centre},
        {"go-to", "ID", "Another name of centre.", "", "", {}, centre},
    };
}

} // namespace ramus::app::actions
