// Commands of deviation: colours by the distance from another surface.
#include "app/actions/arguments.h"
#include "app/actions/groups.h"
#include "app/assets/shapes.h"
#include "core/base/words.h"
#include "core/io/length_unit.h"
#include "core/io/meshes/mesh_file.h"
#include "core/io/orientation.h"
#include "core/io/volumes/volume_file.h"

#include <filesystem>

namespace ramus::app::actions {

namespace {

using From = DeviationChoice::From;
using Unit = DeviationChoice::Unit;

constexpr const char* kWanted = "cones, iso or a file";

// A mask becomes that of the comparison: a picture has only one.
Result<void> take_file(Marks& marks, const std::string& name, const std::string& units) {
    const std::filesystem::path path = std::filesystem::absolute(name).lexically_normal();
    std::error_code error;
    if (!std::filesystem::exists(path, error))
        return fail("no such file", path.string(), std::string("give ") + kWanted);
    if (io::may_be_mesh(path)) {
        marks.deviation.from = From::kFile;
        marks.deviation.file = path.string();
        return {};
    }
    if (!io::is_volume(path))
        return fail("this is neither a mask nor a mesh", path.string(), "surfaces are " + context_extensions());
    marks.deviation.from = From::kIsosurface;
    marks.comparison.mask = path.string();
    marks.comparison.mask_units = units;
    marks.comparison.labels.clear();
    return {};
}

Result<void> deviation_from(ActionContext& context, Arguments arguments) {
    if (arguments.empty())
        return ask_for_file(context, FilePurpose::kDeviation, fail("deviation-from needs a surface", {}, kWanted));
    std::string units, axes;
    if (arguments.size() == 3 && arguments[1] == "--units") {
        units = arguments[2];
        if (!io::length_unit(units)) return fail("\"" + units + "\" is no unit of length", {}, "mm, um, cm or m");
        arguments = arguments.first(1);
    } else if (arguments.size() == 3 && arguments[1] == "--mesh-orientation") {
        axes = arguments[2];
        if (!io::slicer_space(axes)) return fail("--mesh-orientation takes LPS or RAS");
        arguments = arguments.first(1);
    }
    if (arguments.size() > 1)
        return fail("deviation-from takes one surface, and --units of a mask or --mesh-orientation of a mesh", {},
                    "put quotes around a name with blanks");
    Marks next = context.document.marks();
    next.colour_by = ColourBy::kDeviation;
    next.deviation.file.clear();
    next.deviation.axes = axes;
    if (arguments[0] == name_of(Compared::kTruncatedCones))
        next.deviation.from = From::kCones;
    else if (arguments[0] == name_of(Compared::kIsosurface))
        next.deviation.from = From::kIsosurface;
    else if (auto taken = take_file(next, arguments[0], units); !taken)
        return taken;
    // The unit voxels requires a reference with voxels.
    if (next.deviation.unit == Unit::kVoxels && !may_count_voxels(next.deviation.from))
        next.deviation.unit = Unit::kMm, next.deviation.most = 0.0;
    context.document.change(std::move(next));
    return {};
}

Result<void> deviation_scale(ActionContext& context, Arguments arguments) {
    const auto wrong = [] {
        return fail("deviation-scale takes where the scale ends, and mm or voxels", {},
                    "0.5, 0.5 mm, 1 voxels, auto or auto voxels");
    };
    if (arguments.empty() || arguments.size() > 2) return wrong();
    const auto unit = arguments.size() == 2 ? deviation_unit_named(arguments[1]) : std::optional(Unit::kMm);
    const auto most =
        arguments[0] == "auto" ? std::optional(0.0) : number_in(arguments[0], kLeastDeviation, kMostDeviation);
    if (!unit || !most) return wrong();
    if (*unit == Unit::kVoxels && !may_count_voxels(context.document.marks().deviation.from))
        return fail("only a mask has voxels", {}, "deviation-from iso, or a mask, first");
    return edit(context, [&](Marks& marks) {
        marks.deviation.unit = *unit;
        marks.deviation.most = *most;
    });
}

} // namespace

std::vector<Command> deviation_commands() {
    return {
        Command("deviation-from", "[cones|iso|FILE [--units UNIT] [--mesh-orientation LPS|RAS]]",
                "Colours the surface by how far it lies from truncated cones, from the isosurface of the mask that "
                "compare-mask names, or from a mesh or mask. Without any, asks for a file.",
                deviation_from)
            .in_menu("Colour", "Deviation from a file\xE2\x80\xA6")
            .when(has_tree),
        Command("deviation-scale", "MAX|auto [mm|voxels]",
                "Where the colours of the deviation end, in mm or in diagonals of the mask's voxels; auto: where 99 % "
                "of the distances lie below.",
                deviation_scale)
            .when(has_tree),
    };
}

} // namespace ramus::app::actions
