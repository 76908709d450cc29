// The options of the surface.
#include "app/actions/arguments.h"
#include "app/actions/groups.h"

namespace ramus::app::actions {

namespace {

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

} // namespace

std::vector<Command> surface_commands() {
    return {
        Command("surface", "NAME VALUE", "Sets smooth, prune, width, detail or method (cs, cones) of the surface.",
                surface),
    };
}

} // namespace ramus::app::actions
