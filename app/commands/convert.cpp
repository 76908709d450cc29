// `ramus convert FILE -o FILE`: writes a vessel tree in another format, with the edits of a session.
#include "app/commands/inputs.h"
#include "app/commands/output_target.h"
#include "app/commands/subcommands.h"
#include "app/commands/surface_flags.h"
#include "app/session/systems.h"
#include "core/io/run_inputs.h"
#include "core/io/trees/tree_file.h"
#include "core/tree/part_of_tree.h"

#include <algorithm>
#include <iostream>
#include <memory>
#include <optional>

namespace ramus::app {

namespace {

struct ConvertFlags {
    SurfaceFlags surface;
    std::string file, session;
    std::string output, format;
    std::optional<io::Orientation> axes;
};

Result<int> run_convert(const ConvertFlags& flags) {
    io::note_input(flags.file);
    io::note_input(flags.session);
    if (auto possible = io::check_tree_output(flags.output, flags.axes); !possible)
        return tl::unexpected(possible.error());
    if (flags.file.empty() && flags.session.empty())
        return fail("there is no tree to convert", {}, "give a FILE, or --session SESSION");
    RAMUS_TRY(opened, open_session(flags.file, flags.session, flags.surface));
    const Marks& marks = opened.session.marks;
    RAMUS_TRY(chosen, branches_of(*opened.tree, marks, flags.surface.systems, opened.session.tree.path.string()));
    const bool whole = std::ranges::find(chosen, 0) == chosen.end();
    const tree::VesselTree tree = with_systems(whole ? *opened.tree : tree::part_of(*opened.tree, chosen), marks);
    std::vector<std::string> comments = {"written by ramus " RAMUS_VERSION};
    if (!tree.source.empty()) comments.push_back("source: " + tree.source);
    // SWC can store repairs only in comments, and repaired points must not be taken for measured ones.
    for (const std::string& sentence : sentences(tree, tree::Note::Kind::kRepaired))
        comments.push_back("repaired: " + sentence);
    for (const tree::Edit& edit : marks.edits) comments.push_back("edited: " + sentence(edit));
    if (auto written = io::write_tree(tree, flags.output, comments, flags.axes); !written)
        return tl::unexpected(written.error());
    if (const std::string lost = io::data_left_out(tree, flags.output); !lost.empty())
        std::cerr << "ramus: " << lost << '\n';
    return kDone;
}

} // namespace

void register_convert(CLI::App& app, Action& chosen) {
    CLI::App* command =
        add_command(app, "convert", "Write a vessel tree in another format: " + io::writable_tree_extensions());
    const auto flags = std::make_shared<ConvertFlags>();
    add_input(*command, "FILE", "", flags->file, "Vessel tree to read; without it, that of the session");
    add_option(
        *command, "--session", "SESSION", flags->session,
        "Apply the edits of this session: joined, cut and deleted branches, roots, radii; its systems' names and "
        "colours");
    add_option(*command, "-o,--output", "FILE", flags->output,
               "Vessel tree to write: " + io::writable_tree_extensions())
        ->required();
    add_format_flag(*command, flags->format, streamed_tree_extensions());
    flags->surface.command = command;
    add_source_flags(*command, flags->surface);
    add_system_flag(*command, flags->surface);
    add_axes_flag(*command, flags->axes,
                  "Of .vtp and .mrk.json: axes of the coordinates in the file, which states them (default RAS, of "
                  ".mrk.json LPS)");
    command->callback([flags, command, &chosen] {
        check_output_flags(*command, flags->output, flags->format);
        chosen = [flags] { return with_output(*flags, run_convert); };
    });
}

} // namespace ramus::app
