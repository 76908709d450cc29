// ramus skeletonize MASK -o TREE: a vessel tree of a segmentation mask.
#include "core/volume/skeletonize/skeletonize.h"

#include "app/commands/inputs.h"
#include "app/commands/output_target.h"
#include "app/commands/printed_report.h"
#include "app/commands/progress.h"
#include "app/commands/subcommands.h"
#include "app/session/comparison.h"
#include "app/session/numbers.h"
#include "app/session/of_file.h"
#include "app/storage/tree_source.h"
#include "core/base/stopwatch.h"
#include "core/io/run_inputs.h"
#include "core/io/standard_input.h"
#include "core/io/trees/tree_file.h"
#include "core/io/volumes/volume_file.h"
#include "core/io/volumes/volume_unit.h"
#include "core/measure/tree_measure.h"
#include "core/volume/label_counts.h"

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

namespace ramus::app {

namespace {

struct SkeletonizeFlags {
    SurfaceFlags reading; // of which only memory, --verbose and what is of masks are asked for
    volume::LabelGroups labels;
    std::string file, output, format;
    bool json = false;
};

struct Seconds {
    double load = 0.0, skeleton = 0.0, write = 0.0;
};

// "1+3,2": the labels of each system; "all": none named. None: it is neither.
std::optional<std::vector<std::vector<volume::LabelChoice>>> label_lists(const std::string& text) {
    if (text == "all") return std::vector<std::vector<volume::LabelChoice>>();
    return label_groups(text);
}

void report_json(const tree::VesselTree& tree, const volume::SkeletonizeFigures& figures, const Seconds& seconds) {
    const measure::TreeStatistics statistics = measure::tree_statistics(tree);
    nlohmann::ordered_json systems = nlohmann::ordered_json::array();
    for (std::size_t s = 0; s < tree.systems.size(); ++s)
        systems.push_back(
            {{"name", tree.systems[s].name},
             {"branches", std::ranges::count(tree.branches, static_cast<int>(s), &tree::Branch::system)}});
    nlohmann::ordered_json notes = nlohmann::ordered_json::array();
    for (const tree::Note& note : tree.notes) notes.push_back(note.text);
    const nlohmann::ordered_json report = {
        {"branches", tree.branches.size()},
        {"leaves", statistics.leaves},
        {"roots", tree.roots.size()},
        {"loops", tree.loop_count},
        {"points", tree.points.size()},
        {"units", tree.claims.unit_word()},
        {"orientation", tree.claims.axes_word()},
        {"length_mm", statistics.length_mm},
        {"radius_mm", {{"min", statistics.radius_mm.min}, {"max", statistics.radius_mm.max}}},
        {"systems", systems},
        {"mask",
         {{"voxels", figures.voxels},
          {"pieces", figures.pieces},
          {"tunnels", figures.tunnels},
          {"cavities_filled", figures.cavities_filled},
          {"islands_dropped", figures.islands_dropped}}},
        {"notes", notes},
        {"load_s", seconds.load},
        {"skeleton_s", seconds.skeleton},
        {"write_s", seconds.write}};
    std::cout << printed_report(report) << '\n';
}

void report_text(const SkeletonizeFlags& flags, const tree::VesselTree& tree, const Seconds& seconds) {
    for (const tree::Note& note : tree.notes)
        if (note.kind == tree::Note::Kind::kRepaired) std::cerr << "ramus: " << note.text << '\n';
    std::cout << output_name(flags.output) << ": " << counted(tree.branches.size(), "branch", "branches") << ", "
              << counted(static_cast<std::uint64_t>(tree.loop_count), "loop", "loops") << ", "
              << counted(tree.roots.size(), "piece", "pieces");
    if (!tree.systems.empty()) std::cout << ", " << counted(tree.systems.size(), "system", "systems");
    std::cout << " in " << rounded(seconds.load + seconds.skeleton + seconds.write) << " s\n";
}

Result<int> run_skeletonize(const SkeletonizeFlags& flags) {
    io::note_input(flags.file);
    if (auto possible = io::check_tree_output(flags.output); !possible) return tl::unexpected(possible.error());
    Stopwatch watch;
    Seconds seconds;
    RAMUS_TRY(mask, load_volume(flags.file, flags.reading));
    warn_about(flags.file, mask);
    seconds.load = watch.lap();
    const auto isovalue = flags.reading.read.mask.isovalue;
    auto systems = isovalue ? std::vector<volume::SystemMask>{{.labels = {}, .isovalue = isovalue}}
                            : volume::systems_of(mask, flags.labels);
    if (!systems) return fail(systems.error().what, flags.file, systems.error().hint);
    if (!flags.labels && !isovalue && volume::label_counts(mask).size() > 1)
        say(flags.reading, flags.file + ": all labels are taken together; --label all makes each a system");
    volume::SkeletonizeFigures figures;
    const auto options =
        skeletonize_options(flags.reading.read.mask, static_cast<double>(flags.reading.surface.memory_bytes));
    const tree::Claims claims = io::claims_of(mask, flags.reading.read.unit);
    const auto make = [&](Job& job) {
        return of_file(volume::skeletonize(std::move(mask), *systems, options, job, &figures), flags.file);
    };
    RAMUS_TRY(tree, with_progress("skeleton", make, kNothingWritten));
    seconds.skeleton = watch.lap();
    tree.claims = claims;
    if (isovalue) tree.notes.push_back(threshold_note(*isovalue));
    tree.source = std::filesystem::path(io::input_name(flags.file)).filename().string();
    if (auto written =
            io::write_tree(tree, flags.output, {"written by ramus " RAMUS_VERSION, "source: " + tree.source});
        !written)
        return tl::unexpected(written.error());
    seconds.write = watch.lap();
    flags.json ? report_json(tree, figures, seconds) : report_text(flags, tree, seconds);
    return kDone;
}

void add_mask_options(CLI::App& command, SkeletonizeFlags& flags) {
    CLI::Option* label =
        add_option_taking<std::string>(
            command, "--label", "LABEL[,LABEL...]|all",
            [&flags](const std::string& list) { flags.labels = label_lists(list); },
            "Labels that are vessels, by number or name, each a system of its own that is joined with no other; 1+3 "
            "makes one of two "
            "(default: all that is inside is one)")
            ->check(expecting(" is neither all nor a list of whole numbers other than 0 and names", label_lists));
    add_mask_reading_flags(command, flags.reading.read.mask);
    command.get_option("--isovalue")->excludes(label);
    add_units_flag(command, flags.reading.read);
    add_memory_option(command, "--memory", flags.reading.surface.memory_bytes,
                      "Most memory to use, as 800M or 4G (default 0: half of the machine's)");
}

} // namespace

void register_skeletonize(CLI::App& app, Action& chosen) {
    CLI::App* command = add_command(app, "skeletonize", "Make a vessel tree of a segmentation mask");
    command->footer(
        "The tree has the pieces of the mask, and its tunnels as loops. Radii are those of circles with the "
        "area of the mask's cross-sections.");
    const auto flags = std::make_shared<SkeletonizeFlags>();
    add_input(*command, "MASK", "", flags->file,
              "Segmentation mask, or with --isovalue a scan (" + io::readable_volume_extensions() + ")")
        ->required();
    add_option(*command, "-o,--output", "TREE", flags->output, "Tree file to write: " + io::writable_tree_extensions())
        ->required();
    add_format_flag(*command, flags->format, streamed_tree_extensions());
    add_mask_options(*command, *flags);
    command->add_flag("--json", flags->json, "Print the figures as one JSON object");
    command->add_flag("--verbose", flags->reading.verbose, "Say on standard error what is going on");
    command->callback([flags, command, &chosen] {
        check_output_flags(*command, flags->output, flags->format);
        chosen = [flags] { return with_output(*flags, run_skeletonize); };
    });
}

} // namespace ramus::app
