// `ramus validate TREE...`: validates the surfaces of trees as in the paper (section VII), each tree and on average.
// The surfaces are computed, or read from the files of any program.
#include "app/commands/picture_flags.h"
#include "app/commands/printed_report.h"
#include "app/commands/progress.h"
#include "app/commands/subcommands.h"
#include "app/commands/validate_data_set.h"
#include "app/commands/validate_kernels.h"
#include "app/commands/validate_report.h"
#include "app/commands/validate_text.h"
#include "app/session/error_context.h"
#include "app/session/numbers.h"
#include "core/io/meshes/mesh_file.h"
#include "core/io/volumes/volume_file.h"

#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>

namespace ramus::app {

namespace {

Result<int> run_kernels(const ValidateFlags& flags) {
    RAMUS_TRY(trees, read_all(flags));
    if (auto printed =
            with_file(print_kernels(flags.trees[0], trees[0], flags.surface.surface, flags.json), flags.trees[0]);
        !printed)
        return tl::unexpected(printed.error());
    return kDone;
}

Result<int> run_validate(const ValidateFlags& flags) {
    if (flags.kernels) return run_kernels(flags);
    Job whole; // cancelled by an interrupt between the steps, which have jobs of their own
    const CancelOnInterrupt cancel(whole);
    std::optional<ReportFolder> report;
    std::unique_ptr<ValidationPainter> painter;
    if (!flags.report.empty()) {
        RAMUS_TRY(folder, ReportFolder::make(flags));
        report.emplace(std::move(folder));
    }
    RAMUS_TRY(trees, read_all(flags));
    if (report) {
        constexpr std::size_t kFew = 3;
        RAMUS_TRY(made, ValidationPainter::create(flags.count() <= kFew));
        painter = std::move(made);
    }
    std::vector<ValidatedDataSet> sets;
    for (std::size_t n = 0; n < flags.count(); ++n) {
        RAMUS_TRY(set, validated(flags, n, trees[n], painter.get()));
        sets.push_back(std::move(set));
        if (whole.cancelled()) return fail(kNothingWritten);
    }
    const std::string json = printed_report(validation_json(sets)) + "\n";
    if (whole.cancelled()) return fail(kNothingWritten);
    if (report)
        if (auto written = report->write(flags, sets, json); !written) return tl::unexpected(written.error());
    if (flags.json)
        std::cout << json;
    else
        print_validation(sets);
    return kDone;
}

} // namespace

void register_validate(CLI::App& app, Action& chosen) {
    const auto flags = std::make_shared<ValidateFlags>();
    CLI::App* command = add_command(
        app, "validate",
        "Compare surfaces with their trees: lost, false and merged branches, constrictions, radii, distances");
    add_input(*command, "TREE", "", flags->trees,
              "Vessel trees; several are validated one by one and averaged, when all their files can be read")
        ->required();
    add_input(*command, "--surface", "MESH", flags->meshes,
              "The surface, from any program (" + io::readable_mesh_extensions() +
                  "); without it, that of ramus. Of several trees once for each, in the same order")
        ->allow_extra_args(false);
    add_mesh_orientation_flag(*command, flags->mesh_axes, "--surface")->needs(command->get_option("--surface"));
    CLI::Option* mask =
        add_input(*command, "--mask", "MASK", flags->masks,
                  "Segmentation mask of the same vessels (" + io::readable_volume_extensions() +
                      "): distances to its isosurface. Of several trees once for each, in the same order")
            ->allow_extra_args(false);
    add_mask_units_flag(*command, flags->labels.units, "--mask")->needs(mask);
    add_label_flag(*command, flags->labels.labels, "Labels of the mask that are these vessels (default: all)")
        ->needs(mask);
    add_option(
        *command, "--report", "FOLDER", flags->report,
        "Write what was found as a page, index.html, with pictures and plots, as validation.json, as tables "
        "(.csv) with the radii along all branches, and box plots (.svg); the folder is created if it does not exist");
    command->add_flag("--json", flags->json,
                      "Print what was found as one JSON object; of several trees {\"data_sets\": [...], "
                      "\"averages\": {...}}");
    CLI::Option* kernels = command->add_flag(
        "--kernels", flags->kernels,
        "Instead, for one tree: print a table that compares kernels and widths, at joints and for the tree");
    add_surface_flags(*command, flags->surface);
    for (const char* other : {"--surface", "--mask", "--report", "--kernel", "--width", "--blend"})
        kernels->excludes(command->get_option(other));
    command->callback([flags, &chosen] {
        if (flags->kernels && flags->count() != 1) throw CLI::ValidationError("--kernels", "takes one tree");
        check_one_for_each("--mask", flags->masks.size(), flags->count());
        check_one_for_each("--surface", flags->meshes.size(), flags->count());
        chosen = [flags] { return run_validate(*flags); };
    });
}

} // namespace ramus::app
