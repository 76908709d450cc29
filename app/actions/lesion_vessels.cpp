// Commands about lesions and their nearest vessels: the contact limit, lines in the picture, moving the camera there.
#include "app/actions/arguments.h"
#include "app/actions/groups.h"
#include "app/assets/assets.h"
#include "app/assets/lesion_text.h"
#include "app/picture/fit.h"
#include "app/session/systems.h"

#include <algorithm>

namespace ramus::app::actions {

namespace {

Result<void> lesion_contact(ActionContext& context, Arguments arguments) {
    const auto within = arguments.size() == 1 ? number_in(arguments[0], 0.0, kFarthestMm) : std::nullopt;
    if (!within)
        return fail("lesion-contact takes a distance in mm", {},
                    "a vessel's wall that is as near to a lesion touches it; half a voxel's edge is usual");
    return edit(context, [&](Marks& marks) { marks.planning.touch_mm = *within; });
}

Result<void> shortest_distances(ActionContext& context, Arguments arguments) {
    const auto shown = switched(arguments, context.document.marks().shortest_distances);
    if (!shown) return fail("shortest-distances is on or off");
    return edit(context, [&](Marks& marks) { marks.shortest_distances = *shown; });
}

// N [SYSTEM]; by default the nearest system.
Result<void> lesion_vessel(ActionContext& context, Arguments arguments) {
    const Document& document = context.document;
    const Marks& marks = document.marks();
    const tree::VesselTree& tree = *document.tree();
    if (arguments.empty() || arguments.size() > 2)
        return fail("lesion-vessel takes a lesion's number and, of several systems, one");
    RAMUS_TRY(lesion, list_index(arguments.first(1), marks.lesions.size(), "lesion"));
    int system = -1;
    if (arguments.size() == 2) {
        RAMUS_TRY(found, find_system(systems_of(tree, marks), arguments[1]));
        system = tree.systems.size() > 1 ? found : 0;
    }
    complete_lesions(context.assets, document);
    const auto plan = context.assets.plan;
    const measure::LesionVessels* nearest = nullptr;
    for (const measure::LesionVessels& one : plan->vessels)
        if (one.lesion == lesion && (system < 0 || one.system == system) &&
            (nearest == nullptr || one.nearest.distance_mm < nearest->nearest.distance_mm))
            nearest = &one;
    if (nearest == nullptr || nearest->nearest.branch == tree::kNoBranch)
        return fail("no distance from lesion " + arguments[0] + " is known", {},
                    plan->troubles.empty() ? "" : plan->troubles.front());
    const measure::NearestWall& wall = nearest->nearest;
    context.say("Lesion " + arguments[0] + " to " + vessels_name(tree, marks, *nearest) + ", branch " +
                std::to_string(wall.branch) + ": " + distance_text(wall, document.lengths()) + "; " +
                contact_text(*nearest, document.lengths()));
    select_these(context, {wall.branch});
    const double radius = measure::point_on(tree, wall.branch, wall.fraction).radius_mm;
    return move_camera(context, looking_at(document.session().camera, 0.5 * (wall.on_lesion + wall.on_wall),
                                           std::max(radius, wall.distance_mm), context.picture.picture_size()));
}

} // namespace

std::vector<Command> lesion_vessel_commands() {
    return {
        Command(
            "shortest-distances", "[on|off]",
            "Draws the shortest distance from every lesion to the nearest vessel of each system, as a line with its "
            "length.",
            shortest_distances)
            .in_menu("Plan", "Shortest distances of lesions")
            .when(has_lesions)
            .in_use_when([](const ActionContext& context, const Command&) {
                return context.document.marks().shortest_distances;
            }),
        Command("lesion-contact", "MM",
                "Sets how near to a lesion a vessel's wall counts as touching it, for the angle and the length of "
                "contact.",
                lesion_contact),
        Command(
            "lesion-vessel", "N [SYSTEM]",
            "Goes to where lesion N is nearest to a vessel, of this system if told, selects the branch and tells the "
            "distance and the contact.",
            lesion_vessel)
            .when(has_lesions),
    };
}

} // namespace ramus::app::actions
