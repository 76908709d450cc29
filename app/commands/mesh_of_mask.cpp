#include "app/commands/mesh_of_mask.h"

#include "app/commands/interrupt.h"
#include "app/commands/load_volume.h"
#include "app/commands/progress_bar.h"
#include "app/session/comparison.h"
#include "app/session/surface_options.h"
#include "core/base/stopwatch.h"
#include "core/io/meshes/mesh_file.h"
#include "core/measure/mesh_components.h"
#include "core/volume/isosurface.h"

#include <cmath>
#include <utility>
#include <vector>

namespace ramus::app {

void add_mask_flags(CLI::App& command, MaskFlags& flags) {
    CLI::Option* label =
        command
            .add_option_function<std::string>(
                "--label", [&flags](const std::string& list) { flags.selection.labels = *label_list(list); },
                "With iso: these labels of the mask alone, as 1 or 1,2 (default: all)")
            ->type_name("N[,N...]")
            ->check(CLI::Validator(
                [](std::string& list) -> std::string {
                    return label_list(list) ? "" : list + " is not a list of whole numbers other than 0";
                },
                ""));
    command
        .add_option_function<double>(
            "--isovalue",
            [&flags](double value) {
                if (!std::isfinite(value)) throw CLI::ValidationError("--isovalue", "must be a finite number");
                flags.selection.isovalue = value;
            },
            "With iso: what is at least that is inside (default for fractions: 0.5)")
        ->type_name("VALUE")
        ->excludes(label);
}

void check_mask_flags(const CLI::App& command, const MaskFlags& flags) {
    const std::vector<std::string> of_masks = {"--label", "--isovalue"};
    std::vector<std::string> of_trees = {"--session", "--repair"};
    for (const SurfaceOption& option : surface_options())
        if (option.of_session) of_trees.push_back("--" + std::string(option.key));
    for (const std::string& name : flags.iso ? of_trees : of_masks)
        if (command.get_option(name)->count() > 0)
            throw CLI::ValidationError(name, flags.iso ? "has no meaning with --method iso"
                                                       : "has a meaning only with --method iso");
}

Result<WrittenSurface> mesh_of_mask(const std::string& file, const MaskFlags& mask, const SurfaceFlags& flags,
                                    const std::string& output, double& load_s) {
    Stopwatch watch;
    auto read = load_volume(file, flags);
    if (!read) return tl::unexpected(read.error());
    load_s = watch.lap();
    Job job;
    auto surface = [&] {
        const CancelOnInterrupt cancel(job);
        const ProgressBar bar("surface", job);
        const volume::IsosurfaceOptions options{static_cast<double>(flags.surface.memory_bytes), flags.surface.threads};
        return volume::isosurface(std::move(*read), mask.selection, options, job);
    }();
    if (job.cancelled()) return fail("cancelled; nothing was written");
    if (!surface) {
        if (surface.error().where.empty()) surface.error().where = file;
        return tl::unexpected(surface.error());
    }
    WrittenSurface written{surface->positions.size(), surface->triangles.size()};
    written.mesh_s = watch.lap();
    if (auto saved = io::write_mesh(*surface, output); !saved) return tl::unexpected(saved.error());
    written.write_s = watch.lap();
    written.components = measure::component_count(*surface);
    return written;
}

} // namespace ramus::app
