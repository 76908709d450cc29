// ramus mesh FILE -o MESH: the surface of a vessel tree as a file.
#include "app/commands/load_tree.h"
#include "app/commands/mesh_of_mask.h"
#include "app/commands/open_session.h"
#include "app/commands/subcommands.h"
#include "app/commands/surface_flags.h"
#include "app/commands/write_surface.h"
#include "app/session/numbers.h"
#include "core/base/stopwatch.h"
#include "core/io/meshes/mesh_file.h"
#include "core/io/output_file.h"
#include "core/io/volumes/volume_file.h"

#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

namespace ramus::app {

namespace {

struct MeshFlags {
    SurfaceFlags surface;
    MaskFlags mask;
    std::string file, session, output;
    bool json = false;
};

void report(const MeshFlags& flags, const WrittenSurface& written, double load_s) {
    if (flags.json) {
        nlohmann::ordered_json figures = {
            {"vertices", written.vertices}, {"triangles", written.triangles}, {"components", written.components}};
        if (!flags.mask.iso) figures["evaluations"] = written.evaluations;
        figures.update({{"load_s", load_s}, {"mesh_s", written.mesh_s}, {"write_s", written.write_s}});
        std::cout << figures.dump(2) << '\n';
    } else {
        std::cout << flags.output << ": " << counted(written.triangles, "triangle", "triangles") << ", "
                  << counted(written.vertices, "vertex", "vertices") << ", "
                  << counted(static_cast<std::uint64_t>(written.components), "component", "components") << " in "
                  << rounded(load_s + written.mesh_s + written.write_s) << " s\n";
    }
}

Result<int> run_mesh(const MeshFlags& flags) {
    // What would fail at the end shall fail at the beginning.
    if (auto format = io::mesh_format(flags.output); !format) return tl::unexpected(format.error());
    if (auto possible = io::check_output(flags.output); !possible) return tl::unexpected(possible.error());

    if (flags.mask.iso) {
        double load_s = 0.0;
        const auto written = mesh_of_mask(flags.file, flags.mask, flags.surface, flags.output, load_s);
        if (!written) return tl::unexpected(written.error());
        report(flags, *written, load_s);
        return kDone;
    }

    const Stopwatch watch;
    const auto opened = open_session(flags.file, flags.session, flags.surface);
    if (!opened) return tl::unexpected(opened.error());
    std::vector<std::uint8_t> hidden(opened->tree->branches.size(), 0);
    for (const int branch : branches_in_state(opened->session.marks, render::BranchState::kHidden))
        hidden[static_cast<std::size_t>(branch)] = 1;
    const double load_s = watch.seconds();

    const auto written = write_surface(*opened->tree, opened->session.marks.options, hidden, flags.output);
    if (!written) return tl::unexpected(written.error());
    say(flags.surface, counted(written->evaluations, "evaluation", "evaluations") + " of the field in " +
                           rounded(written->mesh_s) + " s" + (written->streamed ? ", streamed to the disk" : ""));
    report(flags, *written, load_s);
    return kDone;
}

} // namespace

void register_mesh(CLI::App& app, Action& chosen) {
    CLI::App* command = add_command(app, "mesh",
                                    "Write the surface of a vessel tree, or of a segmentation mask, as " +
                                        io::writable_mesh_extensions());
    const auto flags = std::make_shared<MeshFlags>();
    add_option(*command, "FILE", "", flags->file,
               "Vessel tree, may be left out with --session; with --method iso a mask (" +
                   io::readable_volume_extensions() + ")");
    add_option(*command, "-o,--output", "MESH", flags->output, "Mesh to write: " + io::writable_mesh_extensions())
        ->required();
    add_method_flag(*command, true, [flags](mesh::Method method) {
        flags->mask.iso = !mesh::row_of(method).of_tree;
        if (!flags->mask.iso) flags->surface.surface.method = method;
    });
    add_option(*command, "--session", "FILE", flags->session,
               "Of this session: its tree and surface options, without its hidden branches");
    command->add_flag("--json", flags->json, "Print the figures as one JSON object");
    add_surface_flags(*command, flags->surface);
    add_mask_flags(*command, flags->mask);
    command->callback([flags, command, &chosen] {
        check_mask_flags(*command, flags->mask);
        if (flags->file.empty() && flags->session.empty()) throw CLI::RequiredError("FILE or --session");
        chosen = [flags] { return run_mesh(*flags); };
    });
}

} // namespace ramus::app
