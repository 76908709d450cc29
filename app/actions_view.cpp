// Files, undo, the camera and the options of the picture.
#include "app/actions.h"
#include "app/session_file.h"

#include <algorithm>
#include <charconv>
#include <optional>

namespace ramus::app::actions {

namespace {

Result<std::filesystem::path> file_argument(ActionContext& context, Arguments arguments, std::string_view command,
                                            std::string_view extension) {
    if (arguments.size() > 1)
        return fail(std::string(command) + " takes one file", {}, "put quotes around a name with blanks");
    return arguments.empty() ? context.host.suggested_file(extension) : std::filesystem::path(arguments[0]);
}

std::optional<double> number_in(const std::string& word, double least, double most) {
    double value = 0.0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc{} || end != word.data() + word.size() || !(value >= least && value <= most)) return {};
    return value;
}

// All that is not hidden, from where `camera` looks.
render::Camera fitted_to_picture(const ActionContext& context, const render::Camera& camera) {
    const auto mesh = context.host.picture_mesh();
    if (!mesh) return camera;
    // A surface from before they were hidden may be what there is.
    const Marks& marks = context.document.marks();
    const auto visible =
        mesh->positions([&](int branch) { return state_of(marks, branch) != render::BranchState::kHidden; });
    return visible.empty() ? camera : render::fitted(camera, visible, context.host.picture_size());
}

void move_camera(ActionContext& context, const render::Camera& camera) {
    context.document.set_camera(camera);
    context.host.camera_moved();
}

} // namespace

Result<void> open(ActionContext& context, Arguments arguments) {
    if (arguments.size() > 1) return fail("open takes one file", {}, "put quotes around a name with blanks");
    return arguments.empty() ? context.host.ask_for_file() : context.host.open(arguments[0]);
}

Result<void> save(ActionContext& context, Arguments arguments) {
    const auto path = file_argument(context, arguments, "save", ".ramus.json");
    if (!path) return tl::unexpected(path.error());
    if (auto written = write_session(context.document.session(), *path); !written) return written;
    context.document.mark_saved();
    context.host.say("Session saved: " + path->string());
    return {};
}

Result<void> shot(ActionContext& context, Arguments arguments) {
    const auto path = file_argument(context, arguments, "shot", ".png");
    if (!path) return tl::unexpected(path.error());
    if (auto written = context.host.write_picture(*path); !written) return written;
    context.host.say("Picture saved: " + path->string());
    return {};
}

Result<void> quit(ActionContext& context, Arguments) { return context.host.quit(); }

Result<void> undo(ActionContext& context, Arguments) {
    return context.document.undo() ? Result<void>{} : fail("there is nothing to undo");
}

Result<void> redo(ActionContext& context, Arguments) {
    return context.document.redo() ? Result<void>{} : fail("there is nothing to redo");
}

Result<void> view(ActionContext& context, Arguments arguments) {
    const auto view = arguments.size() == 1 ? render::view_named(arguments[0]) : std::nullopt;
    if (!view)
        return fail("view takes the name of a view", {}, "anterior, posterior, left, right, superior or inferior");
    move_camera(context, fitted_to_picture(context, render::looking(context.document.session().camera, *view)));

    return {};
}

Result<void> fit(ActionContext& context, Arguments) {
    move_camera(context, fitted_to_picture(context, context.document.session().camera));

    return {};
}

Result<void> orthographic(ActionContext& context, Arguments arguments) {
    const render::Camera& camera = context.document.session().camera;
    if (arguments.size() > 1 || (arguments.size() == 1 && arguments[0] != "on" && arguments[0] != "off"))
        return fail("orthographic is on or off");
    const bool wanted = arguments.empty() ? !camera.orthographic : arguments[0] == "on";
    move_camera(context, render::with_projection(camera, wanted));
    return {};
}

Result<void> colour_by(ActionContext& context, Arguments arguments) {
    const auto found = std::find_if(kColourings.begin(), kColourings.end(), [&](ColourBy quantity) {
        return arguments.size() == 1 && name_of(quantity) == arguments[0];
    });
    if (found == kColourings.end())
        return fail("colour-by takes a quantity", {}, "nothing, generation, strahler, diameter or branch");
    Marks next = context.document.marks();
    next.colour_by = *found;
    context.document.change(std::move(next));
    return {};
}

Result<void> surface(ActionContext& context, Arguments arguments) {
    const auto refused =
        fail("surface takes a name and a value", {},
             "smooth 0 to 100, prune 0 to 1000000, width 0.1 to 100, detail 4 to 512, method cs or cones");
    if (arguments.size() != 2) return refused;
    Marks next = context.document.marks();
    mesh::SurfaceOptions& options = next.options;
    const std::string& option = arguments[0];
    if (option == "method") {
        if (arguments[1] != "cs" && arguments[1] != "cones") return refused;
        options.method = arguments[1] == "cs" ? mesh::Method::kConvolutionSurface : mesh::Method::kTruncatedCones;
    } else {
        const auto value = option == "smooth"   ? number_in(arguments[1], 0.0, 100.0)
                           : option == "prune"  ? number_in(arguments[1], 0.0, 1e6)
                           : option == "width"  ? number_in(arguments[1], 0.1, 100.0)
                           : option == "detail" ? number_in(arguments[1], 4.0, 512.0)
                                                : std::nullopt;
        const bool whole = option == "smooth" || option == "detail";
        if (!value || (whole && *value != static_cast<int>(*value))) return refused;
        if (option == "smooth")
            options.smooth_passes = static_cast<int>(*value);
        else if (option == "prune")
            options.prune_ratio = *value;
        else if (option == "width")
            options.width = *value;
        else
            options.detail = static_cast<int>(*value);
    }
    context.document.change(std::move(next));
    return {};
}

Result<void> panel(ActionContext& context, Arguments) { return context.host.toggle("panel"); }
Result<void> help(ActionContext& context, Arguments) { return context.host.toggle("help"); }

} // namespace ramus::app::actions
