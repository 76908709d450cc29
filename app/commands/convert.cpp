// ramus convert FILE -o FILE: a vessel tree in another format.
#include "app/commands/inputs.h"
#include "app/commands/subcommands.h"
#include "app/commands/surface_flags.h"
#include "core/io/trees/tree_file.h"

#include <memory>

namespace ramus::app {

namespace {

struct ConvertFlags {
    SurfaceFlags surface;
    std::string file;
    std::string output;
};

Result<int> run_convert(const ConvertFlags& flags) {
    if (auto possible = io::check_tree_output(flags.output); !possible) return tl::unexpected(possible.error());
    RAMUS_TRY(tree, load_tree(flags.file, flags.surface));
    std::vector<std::string> comments = {"written by ramus " RAMUS_VERSION};
    if (!tree.source.empty()) comments.push_back("source: " + tree.source);
    // SWC has no other place for them, and nobody shall take mended points for measured ones.
    for (const std::string& sentence : tree.repairs) comments.push_back("repaired: " + sentence);
    if (auto written = io::write_tree(tree, flags.output, comments); !written) return tl::unexpected(written.error());
    return kDone;
}

} // namespace

void register_convert(CLI::App& app, Action& chosen) {
    CLI::App* command =
        add_command(app, "convert", "Write a vessel tree in another format: " + io::writable_tree_extensions());
    const auto flags = std::make_shared<ConvertFlags>();
    add_option(*command, "FILE", "", flags->file, "Vessel tree to read")->required();
    add_option(*command, "-o,--output", "FILE", flags->output,
               "Vessel tree to write: " + io::writable_tree_extensions())
        ->required();
    add_reading_flags(*command, flags->surface);
    command->callback([flags, &chosen] { chosen = [flags] { return run_convert(*flags); }; });
}

} // namespace ramus::app
