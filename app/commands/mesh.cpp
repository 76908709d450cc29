#include "app/commands/mesh.h"

#include "app/commands/load_tree.h"
#include "app/commands/open_session.h"
#include "app/commands/surface_flags.h"
#include "app/commands/write_surface.h"
#include "app/session/numbers.h"
#include "core/base/stopwatch.h"
#include "core/io/mesh_writer.h"
#include "core/io/output_file.h"

#include <iostream>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>

namespace ramus::app {

namespace {

struct MeshFlags {
    SurfaceFlags surface;
    std::string file, session, output;
    bool json = false;
};

Result<int> run_mesh(const MeshFlags& flags) {
    // What would fail at the end shall fail at the beginning.
    if (auto format = io::mesh_format(flags.output); !format) return tl::unexpected(format.error());
    if (auto possible = io::check_output(flags.output); !possible) return tl::unexpected(possible.error());

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

    if (flags.json) {
        const nlohmann::ordered_json report = {{"vertices", written->vertices},
                                               {"triangles", written->triangles},
                                               {"components", written->components},
                                               {"evaluations", written->evaluations},
                                               {"load_s", load_s},
                                               {"mesh_s", written->mesh_s},
                                               {"write_s", written->write_s}};
        std::cout << report.dump(2) << '\n';
    } else {
        std::cout << flags.output << ": " << counted(written->triangles, "triangle", "triangles") << ", "
                  << counted(written->vertices, "vertex", "vertices") << ", "
                  << counted(static_cast<std::uint64_t>(written->components), "component", "components") << " in "
                  << rounded(load_s + written->mesh_s + written->write_s) << " s\n";
    }
    return kDone;
}

} // namespace

void register_mesh(CLI::App& app, Action& chosen) {
    CLI::App* command = add_command(app, "mesh", "Write the surface of a vessel tree as .ply, .stl or .obj");
    const auto flags = std::make_shared<MeshFlags>();
    command->add_option("FILE", flags->file, "Vessel tree; may be left out with --session")->type_name("");
    command->add_option("-o,--output", flags->output, "Mesh to write: .ply, .stl or .obj")
        ->type_name("MESH")
        ->required();
    static const std::map<std::string, mesh::Method> kMethods = {{"cs", mesh::Method::kConvolutionSurface},
                                                                 {"cones", mesh::Method::kTruncatedCones}};
    command
        ->add_option_function<std::string>(
            "--method", [flags](const std::string& name) { flags->surface.surface.method = kMethods.at(name); },
            "cs: convolution surface (default); cones: truncated cones")
        ->type_name("METHOD")
        ->check(CLI::IsMember({"cs", "cones"}));
    command
        ->add_option("--session", flags->session,
                     "Of this session: its tree and surface options, without its hidden branches")
        ->type_name("FILE");
    command->add_flag("--json", flags->json, "Print the figures as one JSON object");
    add_surface_flags(*command, flags->surface);
    command->callback([flags, &chosen] {
        if (flags->file.empty() && flags->session.empty()) throw CLI::RequiredError("FILE or --session");
        chosen = [flags] { return run_mesh(*flags); };
    });
}

} // namespace ramus::app
