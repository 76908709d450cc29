// `ramus grow -o TREE`: grows a synthetic organ tree and writes it.
#include "core/tree/grow/grow.h"

#include "app/commands/inputs.h"
#include "app/commands/output_target.h"
#include "app/commands/progress.h"
#include "app/commands/subcommands.h"
#include "app/commands/surface_input.h"
#include "app/session/comparison.h"
#include "app/session/numbers.h"
#include "core/base/printable.h"
#include "core/base/stopwatch.h"
#include "core/io/run_inputs.h"
#include "core/io/standard_input.h"
#include "core/io/trees/tree_file.h"
#include "core/io/volumes/volume_file.h"
#include "core/organ/grow_in.h"

#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace ramus::app {

namespace {

struct Flags {
    tree::GrowOptions grow;
    std::string organ; // mask; empty: the liver that is built in
    std::string organ_labels_text, mask_units;
    std::vector<volume::LabelChoice> organ_labels;
    bool own_radius = false, own_spacing = false; // given on the command line
    std::filesystem::path output;
    std::string format;
    bool verbose = false;
};

// The command line that grows the same tree again, without options that have their default values (`usual`).
std::string command_line(const Flags& flags, const tree::GrowOptions& usual) {
    const tree::GrowOptions& options = flags.grow;
    std::ostringstream line;
    line.precision(17);
    line << "ramus grow --branches " << options.branches << " --seed " << options.seed;
    if (options.organ_width_mm != usual.organ_width_mm) line << " --organ-size " << options.organ_width_mm;
    if (options.root_radius_mm != usual.root_radius_mm) line << " --root-radius " << options.root_radius_mm;
    if (options.spacing_mm != usual.spacing_mm) line << " --spacing " << options.spacing_mm;
    if (options.tortuosity != usual.tortuosity) line << " --tortuosity " << options.tortuosity;
    if (!flags.organ.empty())
        line << " --organ " << printable(std::filesystem::path(io::input_name(flags.organ)).filename().string());
    if (!flags.organ_labels_text.empty()) line << " --organ-label " << printable(flags.organ_labels_text);
    if (!flags.mask_units.empty()) line << " --mask-units " << flags.mask_units;
    return line.str();
}

// What is wrong with the options, if anything. The size of a mask's organ is not known yet.
std::optional<Error> wrong_with(const Flags& flags) {
    tree::GrowOptions options = flags.grow;
    const tree::GrowOptions usual;
    if (!flags.organ.empty() && options.root_radius_mm > 0.0) options.root_radius_mm = usual.root_radius_mm;
    if (!flags.organ.empty() && options.spacing_mm > 0.0) options.spacing_mm = usual.spacing_mm;
    return tree::wrong_with(options);
}

Result<organ::Organ> organ_in(const Flags& flags) {
    io::note_input(flags.organ);
    const SurfaceFlags reading = with_units({}, {{}, flags.mask_units});
    RAMUS_TRY(volume, load_volume(flags.organ, reading));
    warn_about(flags.organ, volume);
    return with_progress(
        "organ",
        [&](Job& job) -> Result<organ::Organ> {
            auto read = organ::organ_of(volume, {flags.organ_labels, {}}, JobRange(job, 0.0F, 1.0F));
            if (!read && read.error().where.empty()) read.error().where = io::input_name(flags.organ);
            return read;
        },
        "growing was cancelled");
}

struct Grown {
    tree::GrownTree tree;
    tree::GrowOptions usual; // the default options of this organ
};

Result<Grown> grown_in_mask(Flags& flags) {
    RAMUS_TRY(organ, organ_in(flags));
    const tree::GrowOptions usual = organ::grow_options_for(organ);
    flags.grow.organ_width_mm = usual.organ_width_mm;
    if (!flags.own_radius) flags.grow.root_radius_mm = usual.root_radius_mm;
    if (!flags.own_spacing) flags.grow.spacing_mm = usual.spacing_mm;
    const std::vector<std::size_t> parts = organ::part_sizes(organ);
    if (parts.size() > 1)
        std::cerr << "ramus: the organ has " << parts.size()
                  << " parts that do not touch; the tree grows in the largest, "
                  << rounded(100.0 * double(parts.front()) / double(organ.count())) << " % of it\n";
    auto tree = with_progress(
        "tree", [&](Job& job) { return organ::grow_in(organ, flags.grow, job); }, "growing was cancelled");
    if (!tree && tree.error().where.empty()) tree.error().where = io::input_name(flags.organ);
    if (!tree) return tl::unexpected(tree.error());
    return Grown{std::move(*tree), usual};
}

Result<Grown> grown_by(Flags& flags) {
    if (!flags.organ.empty()) return grown_in_mask(flags);
    const auto make = [&](Job& job) { return tree::grow(flags.grow, job); };
    RAMUS_TRY(tree, with_progress("tree", make, "growing was cancelled"));
    return Grown{std::move(tree), {}};
}

Result<int> grow(const Flags& given) {
    Flags flags = given;
    if (const auto writable = io::check_tree_output(flags.output); !writable) return tl::unexpected(writable.error());
    const Stopwatch watch;
    RAMUS_TRY(grown, grown_by(flags));
    const double seconds = watch.seconds();
    const double litres = grown.tree.organ_volume_mm3 * 1e-6;
    const double terminal_mm = grown.tree.terminal_radius_mm;
    const tree::VesselTree tree = tree::vessel_tree_of(std::move(grown.tree));
    if (flags.verbose)
        std::cerr << "grew " << tree.branches.size() << " branches of " << tree.points.size() << " points in "
                  << seconds << " s; the organ holds " << litres << " l, the mean terminal radius is " << terminal_mm
                  << " mm\n";
    if (const auto written = io::write_tree(tree, flags.output, {command_line(flags, grown.usual)}); !written)
        return tl::unexpected(written.error());
    return kDone;
}

} // namespace

void register_grow(CLI::App& app, Action& chosen) {
    CLI::App* command = add_command(app, "grow", "Grow a synthetic tree in a liver, or in the organ of a mask");
    command->footer("Terminals fill the organ evenly; at every fork the parent's radius cubed is the sum of the "
                    "children's cubed.\nA tree of twofold forks has an odd number of branches; for an even one, one "
                    "fork is threefold.\nThe same options give the same tree on every machine.");
    auto flags = std::make_shared<Flags>();
    tree::GrowOptions& options = flags->grow;
    add_option(*command, "-o,--output", "TREE", flags->output, "Tree file to write: " + io::writable_tree_extensions())
        ->required();
    add_format_flag(*command, flags->format, streamed_tree_extensions());
    add_option(*command, "--branches", "N", options.branches,
               "Branches of the tree, exactly: 1, or 3 and more (default 1504)");
    add_option(*command, "--seed", "S", options.seed,
               "Seed of the random numbers: each gives another organ and tree (default 1)");
    CLI::Option* const size = add_option(*command, "--organ-size", "MM", options.organ_width_mm,
                                         "Width of the organ, left to right (default 214: 1.5 l)");
    CLI::Option* const mask = add_input(*command, "--organ", "MASK", flags->organ,
                                        "Mask of an organ to grow in, instead of the built-in liver; the defaults of "
                                        "--root-radius and --spacing are then in proportion to its size: " +
                                            io::readable_volume_extensions());
    mask->excludes(size);
    add_option_taking<std::string>(
        *command, "--organ-label", "LABEL,...",
        [flags](const std::string& text) {
            flags->organ_labels = *label_list(text);
            flags->organ_labels_text = text;
        },
        "Labels of the mask that are the organ (default: all)")
        ->check(expecting(" is not a list of names and whole numbers other than 0", label_list))
        ->needs(mask);
    add_mask_units_flag(*command, flags->mask_units, "--organ")->needs(mask);
    CLI::Option* const radius = add_option(*command, "--root-radius", "MM", options.root_radius_mm,
                                           "Radius of the stem; the others follow from it (default 6)");
    CLI::Option* const spacing =
        add_option(*command, "--spacing", "MM", options.spacing_mm, "Distance of centerline points (default 1)");
    add_option(*command, "--tortuosity", "X", options.tortuosity,
               "0: straight between forks, 1: gently winding (default 1)");
    command->add_flag("--verbose", flags->verbose, "Report on standard error how the tree has grown");
    command->callback([flags, command, radius, spacing, &chosen] {
        check_output_flags(*command, flags->output, flags->format);
        flags->own_radius = radius->count() > 0;
        flags->own_spacing = spacing->count() > 0;
        if (const auto wrong = wrong_with(*flags)) throw CLI::ValidationError(wrong->message());
        chosen = [flags] { return with_output(*flags, grow); };
    });
}

} // namespace ramus::app
