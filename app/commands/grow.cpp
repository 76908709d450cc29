// `ramus grow -o TREE`: grows a synthetic organ tree and writes it.
#include "core/tree/grow/grow.h"

#include "app/commands/output_target.h"
#include "app/commands/progress.h"
#include "app/commands/subcommands.h"
#include "core/base/stopwatch.h"
#include "core/io/trees/tree_file.h"

#include <filesystem>
#include <iostream>
#include <memory>
#include <sstream>

namespace ramus::app {

namespace {

struct Flags {
    tree::GrowOptions grow;
    std::filesystem::path output;
    std::string format;
    bool verbose = false;
};

// The command line that grows the same tree again, without options that have their default values.
std::string command_line(const tree::GrowOptions& options) {
    const tree::GrowOptions usual;
    std::ostringstream line;
    line.precision(17);
    line << "ramus grow --branches " << options.branches << " --seed " << options.seed;
    if (options.organ_width_mm != usual.organ_width_mm) line << " --organ-size " << options.organ_width_mm;
    if (options.root_radius_mm != usual.root_radius_mm) line << " --root-radius " << options.root_radius_mm;
    if (options.spacing_mm != usual.spacing_mm) line << " --spacing " << options.spacing_mm;
    if (options.tortuosity != usual.tortuosity) line << " --tortuosity " << options.tortuosity;
    return line.str();
}

Result<int> grow(const Flags& flags) {
    if (const auto writable = io::check_tree_output(flags.output); !writable) return tl::unexpected(writable.error());
    const Stopwatch watch;
    const auto make = [&](Job& job) { return tree::grow(flags.grow, job); };
    RAMUS_TRY(grown, with_progress("tree", make, "growing was cancelled"));
    const double seconds = watch.seconds();
    const double litres = grown.organ_volume_mm3 * 1e-6;
    const double terminal_mm = grown.terminal_radius_mm;
    const tree::VesselTree tree = tree::vessel_tree_of(std::move(grown));
    if (flags.verbose)
        std::cerr << "grew " << tree.branches.size() << " branches of " << tree.points.size() << " points in "
                  << seconds << " s; the organ holds " << litres << " l, the mean terminal radius is " << terminal_mm
                  << " mm\n";
    if (const auto written = io::write_tree(tree, flags.output, {command_line(flags.grow)}); !written)
        return tl::unexpected(written.error());
    return kDone;
}

} // namespace

void register_grow(CLI::App& app, Action& chosen) {
    CLI::App* command = add_command(app, "grow", "Grow a synthetic organ tree: a portal vein inside a liver");
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
    add_option(*command, "--organ-size", "MM", options.organ_width_mm,
               "Width of the organ, left to right (default 214: 1.5 l)");
    add_option(*command, "--root-radius", "MM", options.root_radius_mm,
               "Radius of the stem; the others follow from it (default 6)");
    add_option(*command, "--spacing", "MM", options.spacing_mm, "Distance of centerline points (default 1)");
    add_option(*command, "--tortuosity", "X", options.tortuosity,
               "0: straight between forks, 1: gently winding (default 1)");
    command->add_flag("--verbose", flags->verbose, "Report on standard error how the tree has grown");
    command->callback([flags, command, &chosen] {
        check_output_flags(*command, flags->output, flags->format);
        if (const auto wrong = tree::wrong_with(flags->grow)) throw CLI::ValidationError(wrong->message());
        chosen = [flags] { return with_output(*flags, grow); };
    });
}

} // namespace ramus::app
