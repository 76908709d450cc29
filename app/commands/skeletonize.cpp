// `ramus skeletonize MASK -o TREE`: computes a vessel tree from a segmentation mask.
#include "core/volume/skeletonize/skeletonize.h"

#include "app/commands/inputs.h"
#include "app/commands/output_target.h"
#include "app/commands/printed_report.h"
#include "app/commands/progress.h"
#include "app/commands/subcommands.h"
#include "app/session/mask_reading.h"
#include "app/session/numbers.h"
#include "core/base/printable.h"
#include "core/base/stopwatch.h"
#include "core/io/run_inputs.h"
#include "core/io/standard_input.h"
#include "core/io/trees/mask_tree.h"
#include "core/io/trees/tree_file.h"
#include "core/io/volumes/volume_file.h"
#include "core/measure/tree_measure.h"
#include "core/tree/note_summary.h"

#include <algorithm>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

namespace ramus::app {

namespace {

struct SkeletonizeFlags {
    SurfaceFlags reading; // only --memory, --verbose and the options of masks
    std::string file, output, format;
    bool json = false;
};

struct Seconds {
    double load = 0.0, skeleton = 0.0, write = 0.0;
};

// Other commands call "all" "apart". Nothing if the text is not a list of labels.
std::optional<io::MaskReading> reading_of(const std::string& label) {
    auto reading = with(io::MaskReading(), "labels", label == "all" ? "apart" : label);
    return reading && label != "auto" ? std::optional(std::move(*reading)) : std::nullopt;
}

nlohmann::ordered_json note_json(const tree::NoteSummary& note) {
    nlohmann::ordered_json json_note = {{"kind", tree::name_of(note.kind)},
                                        {"topic", note.topic},
                                        {"text", printable(note.text)},
                                        {"count", note.count},
                                        {"at", nlohmann::ordered_json::array()}};
    for (const glm::dvec3& at : note.places) json_note["at"].push_back({at.x, at.y, at.z});
    return json_note;
}

void report_json(const tree::VesselTree& tree, const volume::SkeletonizeFigures& figures, const Seconds& seconds) {
    const measure::TreeStatistics statistics = measure::tree_statistics(tree);
    nlohmann::ordered_json systems = nlohmann::ordered_json::array();
    for (std::size_t s = 0; s < tree.systems.size(); ++s)
        systems.push_back(
            {{"name", tree.systems[s].name},
             {"branches", std::ranges::count(tree.branches, static_cast<int>(s), &tree::Branch::system)}});
    nlohmann::ordered_json notes = nlohmann::ordered_json::array();
    for (const tree::NoteSummary& note : tree::summed_up(tree)) notes.push_back(note_json(note));
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
    for (const tree::NoteSummary& note : tree::summed_up(tree)) {
        const std::string line = printable(with_places(note));
        if (note.kind == tree::Note::Kind::kAssumed)
            say(flags.reading, "assumed: " + line);
        else
            std::cerr << "ramus: " << line << '\n';
    }
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
    RAMUS_TRY(mask, load_volume(flags.file, flags.reading, flags.reading.read.mask.isovalue));
    seconds.load = watch.lap();
    volume::SkeletonizeFigures figures;
    const auto make = [&](Job& job) {
        return io::tree_of_mask(std::move(mask), flags.file, flags.reading.read,
                                static_cast<double>(flags.reading.surface.memory_bytes), job, &figures);
    };
    RAMUS_TRY(tree, with_progress("skeleton", make, kNothingWritten));
    seconds.skeleton = watch.lap();
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
            command, "--label,--labels", "apart|together|LABEL[+LABEL...],...",
            [&flags](const std::string& text) { flags.reading.read.mask.labels = reading_of(text)->labels; },
            "Labels that are vessels: apart (default, each a system of its own that is joined with no other; so does "
            "all), together, or those of each system, by number or name")
            ->check(expecting(" is not apart, together, all, or labels other than 0 and names as 1+3,2", reading_of));
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
    command->add_flag("--verbose", flags->reading.verbose, "Report each step on standard error");
    command->callback([flags, command, &chosen] {
        check_output_flags(*command, flags->output, flags->format);
        chosen = [flags] { return with_output(*flags, run_skeletonize); };
    });
}

} // namespace ramus::app
