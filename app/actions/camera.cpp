// Commands of the camera: views, fit, projection.
#include "app/actions/arguments.h"
#include "app/actions/groups.h"
#include "app/picture/fit.h"
#include "core/io/input_file.h"

#include <nlohmann/json.hpp>

namespace ramus::app::actions {

namespace {

constexpr const char* kNoClipboard = "there is no clipboard without a window";

// Fits everything visible, in the direction of `camera`.
render::Camera fitted_to_picture(const ActionContext& context, const render::Camera& camera) {
    const glm::ivec2 size = context.picture.picture_size();
    const auto visible = visible_positions(context, camera, size);
    if (visible.empty()) return camera;
    return with_room(render::fitted(camera, visible, size), context.document.marks().comparison);
}

Result<void> view(ActionContext& context, Arguments arguments) {
    const auto view = arguments.size() == 1 ? render::view_named(arguments[0]) : std::nullopt;
    if (!view)
        return fail(
            "view takes the name of a view", {},
            "anterior, posterior, left, right, superior or inferior; +x, -x, +y, -y, +z or -z; view-go goes to a "
            "saved view");
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

// Uses axis names if the patient's sides are unknown.
template <render::View Which> std::string view_label(const Document& document) {
    return render::title_of(Which, document.claims().has_sides());
}

template <render::View Which> Command view_entry(const char* key, const char* help) {
    return Command("view", "NAME", help, view)
        .in_menu("View", render::title_of(Which, true), {key})
        .in_submenu("Look from")
        .labelled(view_label<Which>)
        .giving({std::string(render::name_of(Which))})
        .when(has_scene);
}

} // namespace

std::vector<Command> camera_commands() {
    return {
        Command("view", "NAME",
                "Looks from anterior, posterior, left, right, superior or inferior, or from +x, -x, +y, -y, +z or -z, "
                "at "
                "all that is shown.",
                view),
        view_entry<render::View::kAnterior>("A", "From +y: where sides are known, from in front of the patient."),
        view_entry<render::View::kPosterior>("P", "From -y: where sides are known, from behind the patient."),
        view_entry<render::View::kLeft>("L", "From -x: where sides are known, from the patient's left."),
        view_entry<render::View::kRight>("R", "From +x: where sides are known, from the patient's right."),
        view_entry<render::View::kSuperior>("S", "From +z: where sides are known, down from the head."),
        view_entry<render::View::kInferior>("I", "From -z: where sides are known, up from the feet."),
        Command("fit", "", "Brings all that is shown into the picture, from where the viewer stands.", fit)
            .in_menu("View", "Fit", {"F", "0"})
            .when(has_scene),
        Command("orthographic", "[on|off]",
                "Switches between parallel projection, in which one scale holds everywhere, and perspective.",
                orthographic)
            .in_menu("View", "Parallel projection", {"O"})
            .when(has_scene)
            .checked_when(is_orthographic),
        Command("camera", "JSON|FILE",
                "Looks from a camera that was copied as text: {\"position\": [0, -500, 0], ...}.", camera),
        Command("camera-copy", "", "Copies the camera as text, for camera-paste, scripts and the command line.",
                camera_copy)
            .in_menu("Edit", "Copy camera", {"Ctrl+C"})
            .when(has_scene),
        Command("camera-paste", "", "Looks from the camera that was copied as text.", camera_paste)
            .in_menu("Edit", "Paste camera", {"Ctrl+V"})
            .when(has_scene),
    };
}

} // namespace ramus::app::actions
