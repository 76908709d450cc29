// `ramus mesh FILE -o MESH`: writes the surface of a vessel tree or of a mask.
#include "app/assets/assets.h"
#include "app/commands/inputs.h"
#include "app/commands/output_target.h"
#include "app/commands/part_of_surface.h"
#include "app/commands/printed_report.h"
#include "app/commands/printing.h"
#include "app/commands/progress.h"
#include "app/commands/subcommands.h"
#include "app/commands/surface_flags.h"
#include "app/commands/write_surface.h"
#include "app/picture/surface_names.h"
#include "app/session/comparison.h"
#include "app/session/error_context.h"
#include "app/session/numbers.h"
#include "app/session/surface_options.h"
#include "core/base/stopwatch.h"
#include "core/io/meshes/mesh_file.h"
#include "core/io/output_file.h"
#include "core/io/volumes/volume_file.h"
#include "core/io/volumes/volume_unit.h"
#include "core/volume/bit_mask.h"
#include "core/volume/isosurface.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace ramus::app {

namespace {

// For --method iso: the surface of a segmentation mask, or of a scan at an isovalue.
struct MaskFlags {
    bool iso = false;
    volume::Selection selection;
};

// Adds --label. It excludes --isovalue, one of the options of reading.
void add_mask_flags(CLI::App& command, MaskFlags& flags) {
    CLI::Option* label = add_option_taking<std::string>(
                             command, "--label", "LABEL[,LABEL...]",
                             [&flags](const std::string& list) { flags.selection.labels = *label_list(list); },
                             "With iso: these labels of the mask alone, by number or name, as 1 or 1,portal_vein "
                             "(default: all)")
                             ->check(expecting(" is not a list of whole numbers other than 0 and names", label_list));
    command.get_option("--isovalue")->excludes(label);
}

// Throws CLI::ValidationError for options that the chosen method does not have.
void check_mask_flags(const CLI::App& command, const MaskFlags& flags) {
    const std::vector<std::string> of_masks = {"--label"};
    std::vector<std::string> of_trees = {"--session", "--repair",  "--parts",      "--system",    "--labels",
                                         "--root",    "--islands", "--fill-holes", "--bulge-size"};
    for (const SurfaceOption& option : surface_options())
        if (option.of_session) of_trees.push_back("--" + std::string(option.key));
    for (const std::string& name : flags.iso ? of_trees : of_masks)
        if (command.get_option(name)->count() > 0)
            throw CLI::ValidationError(name, flags.iso ? "has no meaning with --method iso"
                                                       : "has a meaning only with --method iso");
}

// Reads a mask, computes its isosurface and writes it. Sets `load_s` to the time of reading, in seconds.
Result<WrittenSurface> mesh_of_mask(const std::string& file, const MaskFlags& mask, const SurfaceFlags& flags,
                                    SurfaceTarget& target, double& load_s) {
    Stopwatch watch;
    RAMUS_TRY(read, load_volume(file, flags));
    warn_about(file, read);
    target.names.claims = io::claims_of(read, flags.read.unit);
    if (auto known = io::check_axes(target.names.axes, target.names.claims, file); !known)
        return tl::unexpected(known.error());
    load_s = watch.lap();
    const volume::IsosurfaceOptions options{.memory_bytes = static_cast<double>(flags.surface.memory_bytes),
                                            .threads = flags.surface.threads,
                                            .target = target.file};
    const auto make = [&](Job& job) {
        return with_file(volume::isosurface(std::move(read), mask.selection, options, job), file);
    };
    RAMUS_TRY(surface, with_progress("surface", make, kNothingWritten));
    WrittenSurface written;
    written.streamed = surface.memory().memory() != nullptr;
    written.mesh_s = watch.lap();
    if (auto saved = write_surface(std::move(surface), target, written); !saved) return tl::unexpected(saved.error());
    return written;
}

struct MeshFlags {
    SurfaceFlags surface;
    MaskFlags mask;
    std::string file, session, output, format;
    std::optional<io::PartsBy> parts; // none: usual_parts()
    std::optional<io::Orientation> axes;
    PrintingFlags printing;
    bool compress = false, json = false;
    MadeBy by;
};

// Adds --parts, for .glb.
void add_parts_flag(CLI::App& command, std::optional<io::PartsBy>& parts) {
    add_option_taking<std::string>(
        command, "--parts", "branch|system|none", [&parts](const std::string& word) { parts = parts_named(word); },
        "Of .glb: an object for each branch, for each system, or for the whole (default: system where the tree has "
        "systems, branch else)")
        ->check(expecting(" is not branch, system or none", parts_named));
}

// Warns of pieces of the tree that have no surface.
void warn_of_lost(const MeshFlags& flags, const WrittenSurface& written) {
    if (written.lost_pieces.empty()) return;
    constexpr std::size_t kNamed = 5;
    const std::size_t count = written.lost_pieces.size();
    std::string named;
    for (std::size_t i = 0; i < std::min(count, kNamed); ++i)
        named += (i == 0 ? "" : ", ") + std::to_string(written.lost_pieces[i].front());
    std::cerr << "ramus: " << output_name(flags.output) << ": " << counted(count, "piece", "pieces") << " of the tree "
              << (count == 1 ? "is" : "are") << " not on the surface (branch " << named
              << (count > kNamed ? ", ..." : "")
              << "): far shorter than thick, thinner than cells, or inside of other vessels\n";
}

// "2 pieces fewer", "1 loop more"; empty if the numbers are equal.
std::string difference_text(std::int64_t here, std::int64_t wanted, const char* one, const char* many) {
    if (here == wanted) return {};
    return counted(static_cast<std::uint64_t>(std::abs(here - wanted)), one, many) +
           (here > wanted ? " more" : " fewer");
}

// Advice for a surface whose pieces or loops differ from the tree's.
const char* remedy_of_shape(mesh::Blend blend) {
    if (!mesh::row_of(blend).separates) return "vessels that come close are merged: --blend tree keeps them apart";
    return "look where axes all but cross: ramus info --contacts lists them, the closest first";
}

// " (closed at (1.5, -20.1, 33.4) and 2 more)": the places of lost loops or false loops, mm.
std::string places_text(const char* what, std::span<const glm::vec3> places) {
    if (places.empty()) return {};
    const glm::vec3& p = places.front();
    const std::size_t more = places.size() - 1;
    return " (" + std::string(what) + " (" + rounded(p.x) + ", " + rounded(p.y) + ", " + rounded(p.z) + ")" +
           (more > 0 ? " and " + std::to_string(more) + " more" : "") + ")";
}
std::string places_text(const std::optional<mesh::MatchedTree>& matched) {
    if (!matched) return {};
    return places_text("closed at", matched->lost_loops.closed) + places_text("near", matched->false_loops.left);
}

// Warns if the numbers of pieces or loops of the surface differ from the tree's.
void warn_of_shape(const MeshFlags& flags, const WrittenSurface& written, mesh::Blend blend) {
    if (!written.tree_shape || written.shape == *written.tree_shape) return;
    std::string what = difference_text(written.shape.pieces, written.tree_shape->pieces, "piece", "pieces");
    const std::string loops = difference_text(written.shape.loops, written.tree_shape->loops, "loop", "loops");
    if (!what.empty() && !loops.empty()) what += " and ";
    std::cerr << "ramus: " << output_name(flags.output) << ": the surface has " << what << loops << " than the tree"
              << places_text(written.matched) << "; " << remedy_of_shape(blend) << '\n';
}

// Warns of intersecting triangles that remain, and of those that were not looked for.
void warn_of_intersections(const MeshFlags& flags, const WrittenSurface& written) {
    if (written.untangled && written.untangled->left > 0)
        std::cerr << "ramus: " << output_name(flags.output) << ": "
                  << counted(written.untangled->left, "pair of triangles goes", "pairs of triangles go")
                  << " through each other" << places_text("near", written.untangled->places)
                  << "; another --detail may have none\n";
    if (written.untangled && !written.untangled->looked_at_all)
        std::cerr
            << "ramus: " << output_name(flags.output)
            << ": triangles that go through each other were not counted: too many may do so, as with cells larger "
               "than vessels; lower --cell, or raise --detail\n";
}

// The repairs of the surface. A repair that was not looked for is null.
nlohmann::ordered_json repairs_json(const WrittenSurface& written) {
    nlohmann::ordered_json repairs = {{"cut_loops", nullptr}, {"opened_loops", nullptr}, {"intersections", nullptr}};
    if (written.matched) {
        repairs["cut_loops"] = written.matched->false_loops.cut;
        repairs["opened_loops"] = written.matched->lost_loops.opened;
    }
    if (written.untangled && written.untangled->looked_at_all)
        repairs["intersections"] = {{"found", written.untangled->found}, {"left", written.untangled->left}};
    return repairs;
}

void report(const MeshFlags& flags, const WrittenSurface& written, const io::MeshNames& names,
            const std::optional<Smoothing>& smoothing, double load_s) {
    const tree::Claims& claims = names.claims;
    warn_of_lost(flags, written);
    if (flags.json) {
        nlohmann::ordered_json figures = {
            {"vertices", written.vertices}, {"triangles", written.triangles}, {"components", written.shape.pieces}};
        if (written.tree_shape) {
            figures["loops"] = written.shape.loops;
            figures["tree"] = {{"components", written.tree_shape->pieces}, {"loops", written.tree_shape->loops}};
        }
        figures["streamed"] = written.streamed;
        if (!flags.mask.iso) {
            figures.update(repairs_json(written));
            figures["evaluations"] = written.evaluations;
        }
        if (smoothing) figures["smoothing"] = smoothing_json(*smoothing);
        figures.update({{"units", claims.unit_word()}, {"orientation", io::axes_word(names.axes, claims)}});
        figures.update({{"load_s", load_s}, {"mesh_s", written.mesh_s}, {"write_s", written.write_s}});
        if (!written.lost_pieces.empty()) figures["lost_pieces"] = written.lost_pieces;
        if (flags.printing.wanted) figures["printing"] = printing_json(flags.printing, written.thicknesses, claims);
        std::cout << printed_report(std::move(figures)) << '\n';
    } else {
        std::cout << output_name(flags.output) << ": " << counted(written.triangles, "triangle", "triangles") << ", "
                  << counted(written.vertices, "vertex", "vertices") << ", "
                  << counted(static_cast<std::uint64_t>(written.shape.pieces), "component", "components")
                  << (written.tree_shape && written.shape.loops > 0
                          ? ", " + counted(static_cast<std::uint64_t>(written.shape.loops), "loop", "loops")
                          : std::string())
                  << " in " << rounded(load_s + written.mesh_s + written.write_s) << " s\n";
        if (flags.printing.wanted) std::cout << printing_text(written.thicknesses, Lengths(claims)) << '\n';
    }
    if (flags.printing.wanted) warn_about_printing(flags.printing, written, claims);
}

// The names and colours of the surface of a tree. Fails if --parts asks for systems and the tree has none.
Result<io::MeshNames> names_for(const MeshFlags& flags, const OpenedSession& opened) {
    const tree::VesselTree& tree = *opened.tree;
    if (flags.parts == io::PartsBy::kSystem && tree.systems.empty())
        return fail("this tree has no systems", flags.file, "use --parts branch or --parts none");
    const TreeFacts facts = facts_of(tree);
    Document document;
    document.open(opened.tree, opened.session);
    Assets assets;
    complete_lesions(assets, document);
    return surface_names(tree, facts, opened.session.marks, assets.plan.get(), flags.parts.value_or(usual_parts(tree)));
}

// Prints the repairs of the surface, with --verbose.
void tell_what_was_done(const MeshFlags& flags, const WrittenSurface& written) {
    say(flags.surface, counted(written.evaluations, "evaluation", "evaluations") + " of the field in " +
                           rounded(written.mesh_s) + " s" + (written.streamed ? ", on the disk" : ""));
    const mesh::MatchedTree matched = written.matched.value_or(mesh::MatchedTree{});
    if (matched.false_loops.cut > 0)
        say(flags.surface, "cut " + counted(matched.false_loops.cut, "loop", "loops") + " that the tree does not have");
    if (matched.lost_loops.opened > 0)
        say(flags.surface, "opened " + counted(matched.lost_loops.opened, "loop", "loops") +
                               " of the tree that the vessels' own thickness closes");
    if (written.untangled && written.untangled->found > 0)
        say(flags.surface, "moved vertices where " +
                               counted(written.untangled->found, "pair of triangles", "pairs of triangles") +
                               " went through each other");
}

// Checks the output first, so that no computation is in vain.
Result<const io::MeshFormat*> format_for(const MeshFlags& flags) {
    RAMUS_TRY(format, io::mesh_format(flags.output));
    if (flags.parts && !format->has_parts)
        return fail("this format has no parts", flags.output, "leave --parts out, or use .glb");
    if (flags.compress && !format->can_compress)
        return fail("this format is not compressed", flags.output, "leave --compress out, or use .glb");
    if (flags.printing.wanted && format->unit_mm != 1.0)
        return fail("programs take the numbers of this format for metres", flags.output, "for printing use .stl");
    return format;
}

Result<int> run_mesh(const MeshFlags& flags) {
    RAMUS_TRY(format, format_for(flags));
    io::note_input(flags.file);
    io::note_input(flags.session);
    if (auto possible = io::check_output(flags.output); !possible) return tl::unexpected(possible.error());

    SurfaceTarget target{flags.output, {}, flags.printing.wanted, flags.surface.surface.threads};
    if (flags.mask.iso) {
        double load_s = 0.0;
        target.names.name = std::filesystem::path(io::input_name(flags.file)).stem().stem().string();
        target.names.compressed = flags.compress;
        target.names.axes = flags.axes.value_or(io::Orientation::ras());
        MaskFlags mask = flags.mask;
        mask.selection.isovalue = flags.surface.read.mask.isovalue;
        RAMUS_TRY(written, mesh_of_mask(flags.file, mask, flags.surface, target, load_s));
        report(flags, written, target.names, std::nullopt, load_s);
        return kDone;
    }

    const Stopwatch watch;
    RAMUS_TRY(opened, open_session(flags.file, flags.session, flags.surface));
    if (flags.by.is_divided() && opened.session.marks.options.method != mesh::Method::kConvolutionSurface)
        return fail("only convolution surfaces are made in parts", flags.file, "use --method cs");
    if (flags.printing.wanted && opened.session.marks.options.method != mesh::Method::kConvolutionSurface)
        return fail("truncated cones overlap, and are not fit for printing", flags.output, "use --method cs");
    std::vector<std::uint8_t> hidden(opened.tree->branches.size(), 0);
    for (const int branch : branches_in_state(opened.session.marks, tree::BranchState::kHidden))
        hidden[static_cast<std::size_t>(branch)] = 1;
    if (io::has_names(*format)) {
        RAMUS_TRY(names, names_for(flags, opened));
        target.names = std::move(names);
    }
    target.names.compressed = flags.compress;
    if (flags.by.team != nullptr) target.names.pieces = flags.by.team->size();
    target.names.claims = opened.tree->claims;
    target.names.axes = flags.axes.value_or(io::Orientation::ras());
    if (auto known = io::check_axes(target.names.axes, target.names.claims, opened.session.tree.path.string()); !known)
        return tl::unexpected(known.error());
    const double load_s = watch.seconds();

    RAMUS_TRY(written, with_file(write_surface(*opened.tree, opened.session.marks.options, hidden, target, flags.by),
                                 opened.session.tree.path.string()));
    if (flags.by.team != nullptr && !flags.by.team->leads()) return kDone;
    if (flags.by.part) {
        std::cout << part_report(written, *flags.by.part, flags.output, load_s, flags.json) << '\n';
        return kDone;
    }
    tell_what_was_done(flags, written);
    warn_of_intersections(flags, written);
    warn_of_shape(flags, written, opened.session.marks.options.blend);
    const mesh::SurfaceOptions& options = opened.session.marks.options;
    std::optional<Smoothing> smoothing; // only for JSON
    if (flags.json) smoothing = smoothing_of(*opened.tree, options.smooth_passes);
    report(flags, written, target.names, smoothing, load_s);
    return kDone;
}

} // namespace

namespace {

// With a team, the command that all its processes run.
void add_mesh(CLI::App& app, Action& chosen, Team* team) {
    CLI::App* command = add_command(app, "mesh",
                                    "Write the surface of a vessel tree, or of a segmentation mask, as " +
                                        io::writable_mesh_extensions());
    const auto flags = std::make_shared<MeshFlags>();
    flags->by.team = team;
    add_input(*command, "FILE", "", flags->file,
              "Vessel tree, may be left out with --session; with --method iso a mask (" +
                  io::readable_volume_extensions() + ")");
    add_option(*command, "-o,--output", "MESH", flags->output, "Mesh to write: " + io::writable_mesh_extensions())
        ->required();
    add_format_flag(*command, flags->format, streamed_mesh_extensions());
    add_method_flag(*command, true, [flags](mesh::Method method) {
        flags->mask.iso = !mesh::row_of(method).of_tree;
        if (!flags->mask.iso) flags->surface.surface.method = method;
    });
    add_option(*command, "--session", "FILE", flags->session,
               "Use the tree and surface options of this session, without its hidden branches");
    command->add_flag("--json", flags->json, "Print the figures as one JSON object");
    add_surface_flags(*command, flags->surface);
    add_system_flag(*command, flags->surface);
    add_mask_flags(*command, flags->mask);
    add_printing_flags(*command, flags->printing);
    add_parts_flag(*command, flags->parts);
    command->add_flag("--compress", flags->compress,
                      "Of .glb: a third of the size, for programs that read EXT_meshopt_compression, as three.js; "
                      "positions are rounded to 0.0003 mm in an organ");
    add_axes_flag(*command, flags->axes, "Axes of the coordinates in the file, which states them (default RAS)");
    if (team == nullptr) add_part_flag(*command, flags->by.part);
    command->callback([flags, command, &chosen] {
        check_mask_flags(*command, flags->mask);
        if (flags->by.is_divided()) check_divided(*command, flags->output, flags->mask.iso);
        if (flags->file.empty() && flags->session.empty()) throw CLI::RequiredError("FILE or --session");
        check_output_flags(*command, flags->output, flags->format);
        chosen = [flags] { return with_output(*flags, run_mesh); };
    });
}

} // namespace

void register_mesh(CLI::App& app, Action& chosen) { add_mesh(app, chosen, nullptr); }

void register_mesh_together(CLI::App& app, Action& chosen, Team& team) { add_mesh(app, chosen, &team); }

} // namespace ramus::app
