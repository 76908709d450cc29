// Where the camera goes by itself: to a branch, to a place.
#include "app/actions/arguments.h"
#include "app/actions/groups.h"
#include "core/measure/branch_place.h"

namespace ramus::app::actions {

namespace {

Result<void> centre(ActionContext& context, Arguments arguments) {
    if (arguments.size() != 1) return fail("centre takes the id of a branch, or a place X,Y,Z in mm");
    glm::dvec3 target(0.0);
    if (arguments[0].find(',') != std::string::npos) {
        const auto place = numbers_in(arguments[0], 3, kFarthestMm);
        if (!place) return fail("\"" + arguments[0] + "\" is not a place X,Y,Z in mm");
        target = {(*place)[0], (*place)[1], (*place)[2]};
    } else {
        const auto id = branch_id(context.document, arguments[0]);
        if (!id) return tl::unexpected(id.error());
        target = measure::place_on(*context.document.tree(), *id, 0.5).position;
    }
    context.document.set_camera(render::centred_on(context.document.session().camera, target));
    context.host.camera_moved();
    return {};
}

} // namespace

std::vector<Command> travel_commands() {
    return {
        {"centre", "ID|X,Y,Z", "Brings the middle of a branch, or a place, into the middle of the picture.", "", "", {}, centre},
        {"go-to", "ID|X,Y,Z", "Another name of centre.", "", "", {}, centre},
    };
}

} // namespace ramus::app::actions
