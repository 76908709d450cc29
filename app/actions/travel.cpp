// Commands that move the camera to a branch, to a position, or along the vessels.
#include "app/actions/arguments.h"
#include "app/actions/groups.h"
#include "core/measure/branch_point.h"

namespace ramus::app::actions {

namespace {

Result<void> centre(ActionContext& context, Arguments arguments) {
    if (arguments.size() != 1) return fail("centre takes the id of a branch, or a place X,Y,Z in mm");
    glm::dvec3 target(0.0);
    if (arguments[0].find(',') != std::string::npos) {
        const auto numbers = numbers_in(arguments[0], 3, kFarthestMm);
        if (!numbers) return fail("\"" + arguments[0] + "\" is not a place X,Y,Z in mm");
        target = {(*numbers)[0], (*numbers)[1], (*numbers)[2]};
    } else {
        RAMUS_TRY(id, branch_id(context.document, arguments[0]));
        target = measure::point_on(*context.document.tree(), id, 0.5).position;
    }
    return move_camera(context, render::centred_on(context.document.session().camera, target));
}

Result<void> fly(ActionContext& context, Arguments arguments) {
    const bool inside = arguments.size() == 3 && arguments[2] == "inside";
    if (arguments.size() != 2 && !inside)
        return fail("fly takes the id of a branch, how far, and inside to fly within the vessel", {},
                    "0 is the root, 1 the end of the branch");
    RAMUS_TRY(id, branch_id(context.document, arguments[0]));
    const auto fraction = number_in(arguments[1], 0.0, 1.0);
    if (!fraction) return fail("\"" + arguments[1] + "\" is not a number from 0 to 1");
    const auto path =
        context.picture.flights.to(context.document.tree(), id, inside ? Flight::kInside : Flight::kOutside);
    context.document.set_camera(path->camera_at(*fraction, context.document.session().camera));
    context.picture.flew(id, *fraction);
    return {};
}

// The default end of a flight: the farthest end, of the selected branches if there are any.
int farthest_end(const Document& document) {
    const auto& branches = document.facts()->branches;
    const auto end = [&](int id) {
        const BranchFacts& facts = branches[static_cast<std::size_t>(id)];
        return facts.root_distance_mm + facts.length_mm;
    };
    const auto& selection = document.marks().selection;
    int farthest = selection.empty() ? 0 : selection.front();
    if (selection.empty())
        for (int id = 0; id < document.branch_count(); ++id) farthest = end(id) > end(farthest) ? id : farthest;
    for (const int id : selection) farthest = end(id) > end(farthest) ? id : farthest;
    return farthest;
}

Result<void> fly_along(ActionContext& context, Arguments arguments) {
    if (arguments.size() > 1) return fail("fly-along takes the id of one branch");
    if (context.document.branch_count() == 0) return fail("there is no tree to fly along");
    if (arguments.empty() && context.window != nullptr && context.window->shows("fly-along")) {
        context.window->close_flight();
        return {};
    }
    RAMUS_TRY(id, arguments.empty() ? Result<int>(farthest_end(context.document))
                                    : branch_id(context.document, arguments[0]));
    if (context.window == nullptr) return no_window("fly-along");
    context.window->open_flight(id);
    return {};
}

} // namespace

std::vector<Command> travel_commands() {
    return {
        Command("centre", "ID|X,Y,Z", "Brings the middle of a branch, or a place, into the middle of the picture.",
                centre),
        Command("go-to", "ID|X,Y,Z", "Another name of centre.", centre),
        Command(
            "fly", "ID FRACTION [inside]",
            "Puts the camera on its way along the vessels: 0 at the root, 1 at the end of the branch; inside, within "
            "them, with the centerlines ahead.",
            fly),
        Command("fly-along", "[ID]", "Opens or closes the bar that flies the camera along the vessels to a branch.",
                fly_along)
            .in_menu("View", "Fly along", {"J"})
            .when(has_tree)
            .in_use_when(shows_part("fly-along")),
    };
}

} // namespace ramus::app::actions
