// Commands that turn and zoom the view by steps, for keys and scripts.
#include "app/actions/arguments.h"
#include "app/actions/groups.h"
#include "app/tools/aim.h"
#include "render/scene/camera_moves.h"

#include <optional>

namespace ramus::app::actions {

namespace {

constexpr double kTurnDegrees = 15.0; // default step: six make a quarter turn
constexpr double kZoomFactor = 1.25;

Result<void> turn(ActionContext& context, Arguments arguments) {
    const auto refused = fail("turn takes left, right, up or down, and degrees from 0 to 360");
    if (arguments.empty() || arguments.size() > 2) return refused;
    const auto degrees =
        arguments.size() == 2 ? number_in(arguments[1], 0.0, 360.0) : std::optional<double>(kTurnDegrees);
    if (!degrees) return refused;
    const std::string& way = arguments[0];
    // The tree turns, so the viewer moves in the opposite direction.
    const render::Camera& now = context.document.session().camera;
    if (way == "left") return move_camera(context, render::turned(now, *degrees, 0.0));
    if (way == "right") return move_camera(context, render::turned(now, -*degrees, 0.0));
    if (way == "up") return move_camera(context, render::turned(now, 0.0, -*degrees));
    if (way == "down") return move_camera(context, render::turned(now, 0.0, *degrees));
    return refused;
}

Result<void> zoom(ActionContext& context, Arguments arguments) {
    const auto refused = fail("zoom takes in or out, and a factor from 1 to 1000");
    if (arguments.empty() || arguments.size() > 2) return refused;
    const auto factor =
        arguments.size() == 2 ? number_in(arguments[1], 1.0, 1000.0) : std::optional<double>(kZoomFactor);
    if (!factor || (arguments[0] != "in" && arguments[0] != "out")) return refused;
    const double by = arguments[0] == "in" ? *factor : 1.0 / *factor;
    const render::Camera& camera = context.document.session().camera;
    // Like the wheel at the pointer: the point in the middle keeps its place, and the camera does not pass it.
    if (const auto at = context.picture.looked_at()) {
        const auto mesh = context.picture.picture_mesh();
        const double least = least_distance_mm(nullptr, tree::kNoBranch, *at, mesh ? mesh->bounds().radius() : 1.0);
        return move_camera(context, render::zoomed_about(camera, *at, by, least));
    }
    return move_camera(context, render::zoomed(camera, by));
}

Command turn_entry(const char* way, const char* key, const char* help) {
    return Command("turn", "left|right|up|down [DEGREES]", help, turn).on_keys({key}).giving({way}).when(has_tree);
}

} // namespace

std::vector<Command> turning_commands() {
    return {
        Command("turn", "left|right|up|down [DEGREES]", "Turns the tree about the middle of the view, by 15 degrees.",
                turn),
        turn_entry("left", "Left", "Turns the tree to the left."),
        turn_entry("right", "Right", "Turns the tree to the right."),
        turn_entry("up", "Up", "Turns the tree upward."),
        turn_entry("down", "Down", "Turns the tree downward."),
        Command("zoom", "in|out [FACTOR]",
                "Magnifies what the middle of the picture shows, or makes it smaller, by a quarter.", zoom),
        Command("zoom", "in|out [FACTOR]", "Magnifies the picture.", zoom)
            .in_menu("View", "Zoom in", {"+", "="})
            .giving({"in"})
            .when(has_tree),
        Command("zoom", "in|out [FACTOR]", "Makes the picture smaller.", zoom)
            .in_menu("View", "Zoom out", {"-"})
            .giving({"out"})
            .when(has_tree),
    };
}

} // namespace ramus::app::actions
