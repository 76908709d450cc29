// From where the tree is looked at.
#include "app/actions/arguments.h"
#include "app/actions/groups.h"
#include "app/picture/fit.h"
#include "core/io/input_file.h"

#include <cctype>
#include <nlohmann/json.hpp>

namespace ramus::app::actions {

namespace {

constexpr const char* kNoClipboard = "there is no clipboard without a window";

// All that is not hidden, from where `camera` looks.
render::Camera fitted_to_picture(const ActionContext& context, const render::Camera& camera) {
    const auto visible = visible_positions(context);
    if (visible.empty()) return camera;
    return with_room(render::fitted(camera, visible, context.picture.picture_size()),
                     context.document.marks().comparison);
}

Result<void> view(ActionContext& context, Arguments arguments) {
    const auto view = arguments.size() == 1 ? render::view_named(arguments[0]) : std::nullopt;
    if (!view)
        return fail("view takes the name of a view", {}, "anterior, posterior, left, right, superior or inferior");
    return move_camera(context, fitted_to_picture(context, render::looking(context.document.session().camera, *view)));
}

Result<void> fit(ActionContext& context, Arguments) {
    return move_camera(context, fitted_to_picture(context, context.document.session().camera));
}

Result<void> orthographic(ActionContext& context, Arguments arguments) {
    const render::Camera& camera = context.document.session().camera;
    const auto wanted = switched(arguments, camera.orthographic);
    if (!wanted) return fail("orthographic is on or off");
    return move_camera(context, render::with_projection(camera, *wanted));
}

Result<void> camera_copy(ActionContext& context, Arguments) {
    if (context.clipboard == nullptr) return fail(kNoClipboard);
    context.clipboard->copy_text(render::to_json(context.document.session().camera).dump());
    context.say("Camera copied as text");
    return {};
}

Result<void> camera_paste(ActionContext& context, Arguments) {
    if (context.clipboard == nullptr) return fail(kNoClipboard);
    RAMUS_TRY(text, context.clipboard->pasted_text());
    RAMUS_TRY(camera, render::parse_camera(text, "clipboard"));
    return move_camera(context, camera);
}

Result<void> camera(ActionContext& context, Arguments arguments) {
    if (arguments.size() != 1) return fail("camera takes JSON, or a file with it", {}, "camera-copy copies it");
    Result<render::Camera> read;
    if (arguments[0].find('{') != std::string::npos) {
        read = render::parse_camera(arguments[0], "camera");
    } else {
        RAMUS_TRY(content, io::read_file(arguments[0], 1 << 20));
        read = render::parse_camera(content, arguments[0]);
    }
    return read ? move_camera(context, *read) : tl::unexpected(read.error());
}

bool is_orthographic(const Document& document) { return document.session().camera.orthographic; }

Command view_entry(const char* label, const char* key, const char* help) {
    std::string name(label);
    name.front() = static_cast<char>(std::tolower(name.front()));
    return Command("view", "NAME", help, view).in_menu("View", label, {key}).giving({name}).when(has_tree);
}

} // namespace

std::vector<Command> camera_commands() {
    return {
        Command("view", "NAME", "Looks from anterior, posterior, left, right, superior or inferior at the whole tree.",
                view),
        view_entry("Anterior", "A", "The viewer stands in front of the patient."),
        view_entry("Posterior", "P", "The viewer stands behind the patient."),
        view_entry("Left", "L", "The viewer stands at the patient's left."),
        view_entry("Right", "R", "The viewer stands at the patient's right."),
        view_entry("Superior", "S", "The viewer looks down from the head."),
        view_entry("Inferior", "I", "The viewer looks up from the feet."),
        Command("fit", "", "Brings the whole tree into the picture, from where the viewer stands.", fit)
            .in_menu("View", "Fit", {"F", "0"})
            .when(has_tree),
        Command("orthographic", "[on|off]", "Switches between parallel and central projection.", orthographic)
            .in_menu("View", "Orthographic", {"O"})
            .when(has_tree)
            .checked_when(is_orthographic),
        Command("camera", "JSON|FILE",
                "Looks from a camera that was copied as text: {\"position\": [0, -500, 0], ...}.", camera),
        Command("camera-copy", "", "Copies the camera as text, for camera-paste, scripts and ramus render --camera.",
                camera_copy)
            .in_menu("Edit", "Copy camera", {"Ctrl+C"})
            .when(has_tree),
        Command("camera-paste", "", "Looks from the camera that was copied as text.", camera_paste)
            .in_menu("Edit", "Paste camera", {"Ctrl+V"})
            .when(has_tree),
    };
}

} // namespace ramus::app::actions
