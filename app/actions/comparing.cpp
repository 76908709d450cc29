// Commands that compare surfaces of the same vessels, and the skeleton.
#include "app/actions/arguments.h"
#include "app/actions/groups.h"
#include "core/io/volumes/volume_file.h"

#include <algorithm>

namespace ramus::app::actions {

namespace {

using Mode = Comparison::Mode;

Result<void> compare(ActionContext& context, Arguments arguments) {
    const auto mode = arguments.empty() ? std::nullopt : comparison_mode_named(arguments[0]);
    if (!mode || arguments.size() > 2)
        return fail("compare takes a mode, and which surfaces", {},
                    "off, side-by-side, blend, superimposed or wipe, then the surfaces in the order wanted: " +
                        compared_names());
    Marks next = context.document.marks();
    next.comparison.mode = *mode;
    if (*mode != Mode::kOff) next.plans.compared.reset(); // the viewports are for surfaces now
    if (arguments.size() == 2) {
        const auto surfaces = surface_list(arguments[1]);
        if (!surfaces)
            return fail("\"" + arguments[1] + "\" is not a list of surfaces", {},
                        "two or three of " + compared_names() + " with commas between");
        next.comparison.surfaces = *surfaces;
    }
    change_keeping_whole(context, std::move(next));
    return {};
}

Result<void> compare_blend(ActionContext& context, Arguments arguments) {
    const auto share = arguments.size() == 1 ? number_in(arguments[0], 0.0, 1.0) : std::nullopt;
    if (!share) return fail("compare-blend takes a number from 0, the first surface, to 1, the second");
    return edit(context, [&](Marks& marks) { marks.comparison.blend = *share; });
}

Result<void> compare_wipe(ActionContext& context, Arguments arguments) {
    const auto at = arguments.size() == 1 ? number_in(arguments[0], 0.0, 1.0) : std::nullopt;
    if (!at) return fail("compare-wipe takes a number from 0, the left edge, to 1, the right one");
    return edit(context, [&](Marks& marks) { marks.comparison.wipe = *at; });
}

Result<void> compare_mask(ActionContext& context, Arguments arguments) {
    if (arguments.empty())
        return ask_for_file(context, FilePurpose::kMask,
                            fail("compare-mask needs a FILE here", {}, io::readable_volume_extensions()));
    Marks next = context.document.marks();
    next.comparison.labels.clear();
    next.comparison.mask_units.clear();
    if (arguments.size() > 2 && arguments[arguments.size() - 2] == "--units") {
        if (!io::length_unit(arguments.back()))
            return fail("\"" + arguments.back() + "\" is no unit of length", {}, "mm, um, cm or m");
        next.comparison.mask_units = arguments.back();
        arguments = arguments.first(arguments.size() - 2);
    }
    if (arguments.size() > 2)
        return fail("compare-mask takes a file, labels in it, and --units", {}, "put quotes around a name with blanks");
    if (arguments[0] == "none" && arguments.size() == 1) {
        next.comparison.mask.clear();
        context.document.change(std::move(next));
        return {};
    }
    const std::filesystem::path path = std::filesystem::absolute(arguments[0]).lexically_normal();
    std::error_code error;
    if (!std::filesystem::is_regular_file(path, error) &&
        !(std::filesystem::exists(path, error) && io::is_volume(path)))
        return fail("the mask cannot be read", path.string(), "check the name and its permissions");
    next.comparison.mask = path.string();
    if (arguments.size() == 2) {
        const auto labels = label_list(arguments[1]);
        if (!labels)
            return fail("\"" + arguments[1] + "\" is not a list of labels", {},
                        "names and whole numbers other than 0, with commas between");
        next.comparison.labels = *labels;
    }
    context.document.change(std::move(next));
    return {};
}

Result<void> skeleton(ActionContext& context, Arguments arguments) {
    const auto shown = switched(arguments, context.document.marks().skeleton);
    if (!shown) return fail("skeleton is on or off");
    return edit(context, [&](Marks& marks) { marks.skeleton = *shown; });
}

bool shows_skeleton(const Document& document) { return document.marks().skeleton; }

constexpr const char* kArguments = "off|side-by-side|blend|superimposed|wipe [SURFACES]";

Command mode_entry(Mode mode, const char* label, const char* help) {
    return Command("compare", kArguments, help, compare)
        .in_menu("View", label)
        .in_submenu("Compare")
        .giving({std::string(name_of(mode))})
        .when(has_tree)
        .checked_when([mode](const Document& document) { return document.marks().comparison.mode == mode; });
}

} // namespace

std::vector<Command> compare_commands() {
    return {
        Command("compare", kArguments,
                "Shows surfaces of the same vessels off, side-by-side, blend, superimposed or wipe: two or three of "
                "cs,cones,iso,tree,paper.",
                compare),
        mode_entry(Mode::kOff, "One surface", "Compares nothing: one surface fills the picture."),
        mode_entry(Mode::kSideBySide, "Surfaces side by side",
                   "Compares surfaces in viewports that one camera looks into."),
        mode_entry(Mode::kBlend, "Surfaces blended", "Compares two surfaces: one fades into the other."),
        mode_entry(Mode::kSuperimposed, "Surfaces superimposed",
                   "Compares two surfaces: the second as lines over the first."),
        mode_entry(Mode::kWipe, "Surfaces split by a line",
                   "Compares two surfaces: one left of a line that is dragged, the other right of it."),
        Command("compare-blend", "SHARE", "How much there is of the second surface where two are blended, from 0 to 1.",
                compare_blend),
        Command("compare-wipe", "AT", "Where the line between two surfaces is, from 0, the left edge, to 1.",
                compare_wipe),
        Command(
            "compare-mask", "[FILE [LABELS] [--units UNIT]|none]",
            "The segmentation mask that the isosurface is of; none: the tree's own voxels. Without FILE, asks for one.",
            compare_mask),
        Command("skeleton", "[on|off]", "Draws centerlines, with rings of the radius, over the vessels.", skeleton)
            .in_menu("View", "Skeleton with radii")
            .when(has_tree)
            .checked_when(shows_skeleton),
    };
}

} // namespace ramus::app::actions
