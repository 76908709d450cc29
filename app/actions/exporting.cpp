// Export of surfaces and trees: of visible, selected or all branches. export_pictures.cpp has the other kinds.
#include "app/actions/arguments.h"
#include "app/actions/export_kinds.h"
#include "app/actions/export_words.h"
#include "app/actions/groups.h"
#include "app/assets/assets.h"
#include "app/assets/territories.h"
#include "app/picture/organ_files.h"
#include "app/picture/surface_names.h"
#include "app/picture/territories.h"
#include "app/session/numbers.h"
#include "app/session/systems.h"
#include "app/session/thickness_text.h"
#include "core/io/meshes/mesh_file.h"
#include "core/io/output_file.h"
#include "core/io/trees/tree_file.h"
#include "core/io/volumes/label_map_file.h"
#include "core/measure/wall_thickness.h"
#include "core/mesh/close_mesh.h"
#include "core/mesh/surface.h"
#include "core/tree/part_of_tree.h"

#include <algorithm>

namespace ramus::app::actions {

namespace {

namespace fs = std::filesystem;

// Data for another thread: values and shared immutable objects only.
struct SurfaceWork {
    std::shared_ptr<const tree::VesselTree> tree;
    mesh::SurfaceOptions options;
    std::vector<std::uint8_t> hidden;
    io::MeshNames names;
    Export wanted;
};

Result<Continuation> write_surface_of(const SurfaceWork& work, Job& job) {
    std::string sentence = saved_text("Surface", work.wanted);
    RAMUS_TRY(surface, mesh::make_untangled_surface(*work.tree, work.options, job, work.hidden, work.wanted.file));
    if (const std::size_t left = surface.statistics.untangled.left; left > 0)
        sentence += "; " + counted(left, "pair of triangles goes", "pairs of triangles go") + " through each other";
    if (!surface.statistics.untangled.looked_at_all)
        sentence += "; triangles that go through each other were not counted: too many may do so; raise the detail";
    if (work.wanted.for_printing) {
        if (auto closed = mesh::check_closed(surface.mesh, work.wanted.file.string()); !closed)
            return tl::unexpected(closed.error());
        const auto thicknesses = measure::least_thicknesses(surface.mesh, work.options.threads);
        const std::string thin = thin_text(thicknesses, kThinnestPrintedMm, Lengths(work.names.claims));
        sentence += "; " + (thin.empty() ? printing_text(thicknesses, Lengths(work.names.claims)) : thin);
    }
    if (job.cancelled()) return fail("cancelled");
    if (auto written = io::write_mesh(std::move(surface.mesh), work.wanted.file, work.names); !written)
        return tl::unexpected(written.error());
    return has_written(work.wanted.file, sentence);
}

Result<Outcome> export_surface(ActionContext& context, const Export& wanted) {
    const Document& document = context.document;
    RAMUS_TRY(format, io::mesh_format(wanted.file));
    if (wanted.parts && !format->has_parts) return fail("this format has no parts", wanted.file.string(), "use .glb");
    if (wanted.parts == io::PartsBy::kSystem && document.tree()->systems.empty())
        return fail("this tree has no systems", wanted.file.string(), "use --parts branch or --parts none");
    if (wanted.for_printing && format->unit_mm != 1.0)
        return fail("programs take the numbers of this format for metres", wanted.file.string(),
                    "for printing use .stl");
    if (wanted.for_printing && document.marks().options.method != mesh::Method::kConvolutionSurface)
        return fail("truncated cones overlap, and are not fit for printing", {}, "show the convolution surface");
    auto work = std::make_shared<SurfaceWork>();
    work->tree = document.tree();
    work->options = document.marks().options;
    work->wanted = wanted;
    work->hidden = exported_branches(document, wanted.of);
    for (std::uint8_t& branch : work->hidden) branch = branch == 0 ? 1 : 0;
    work->names.claims = work->tree->claims;
    if (io::has_names(*format)) {
        refresh(context.assets, document);
        work->names = surface_names(*document.tree(), *document.facts(), document.marks(), context.assets.plan.get(),
                                    wanted.parts.value_or(usual_parts(*document.tree())));
    }
    return Pending{"Exporting " + wanted.file.filename().string(),
                   [work](Job& job) { return write_surface_of(*work, job); }, true};
}

Result<Outcome> export_tree(ActionContext& context, const Export& wanted) {
    if (auto possible = io::check_tree_output(wanted.file); !possible) return tl::unexpected(possible.error());
    auto tree = context.document.tree();
    auto kept = exported_branches(context.document, wanted.of);
    return Pending{
        "Exporting " + wanted.file.filename().string(),
        [tree, kept = std::move(kept), marks = context.document.marks(), wanted](Job& job) -> Result<Continuation> {
            const bool whole = std::ranges::find(kept, 0) == kept.end();
            const tree::VesselTree part = with_systems(whole ? *tree : tree::part_of(*tree, kept), marks);
            if (job.cancelled()) return fail("cancelled");
            std::vector<std::string> comments = {"written by ramus " RAMUS_VERSION};
            if (!part.source.empty()) comments.push_back("source: " + part.source);
            for (const std::string& sentence : sentences(part, tree::Note::Kind::kRepaired))
                comments.push_back("repaired: " + sentence);
            if (auto written = io::write_tree(part, wanted.file, comments); !written)
                return tl::unexpected(written.error());
            const std::string lost = io::data_left_out(part, wanted.file);
            return has_written(wanted.file, saved_text("Tree", wanted) + (lost.empty() ? "" : "; " + lost));
        },
        true};
}

// As a label map, or as surfaces where the file's name is that of a mesh.
Result<Outcome> export_territories(ActionContext& context, const Export& wanted) {
    const auto territories = context.assets.organ.territories;
    const Marks& marks = context.document.marks();
    if (!territories || marks.organ.territories == TerritoriesOf::kNothing)
        return fail("no territories are shown", wanted.file.string(), "show some: territories systems");
    const bool as_surfaces = io::mesh_format(wanted.file).has_value();
    if (!as_surfaces)
        if (auto possible = io::check_label_map_output(wanted.file); !possible) return tl::unexpected(possible.error());
    std::vector<glm::vec3> colours;
    for (std::size_t n = 0; n < territories->parts.size(); ++n)
        colours.push_back(territory_colour(*territories, n, marks));
    return Pending{"Exporting " + wanted.file.filename().string(),
                   [territories, colours, wanted, as_surfaces](Job& job) -> Result<Continuation> {
                       const OrganMask& mask = *territories->of.supply->of.mask;
                       OrganParts parts{mask.organ, mask.claims, {}, colours};
                       for (const OrganTerritories::Part& part : territories->parts) parts.names.push_back(part.name);
                       if (!as_surfaces) {
                           const auto part_of = [&](std::size_t voxel) { return territories->part_of[voxel]; };
                           const JobRange all(job, 0.0F, 1.0F);
                           if (auto written = write_organ_labels(parts, part_of, wanted.file, all); !written)
                               return tl::unexpected(written.error());
                           return has_written(wanted.file, saved_text("Territories", wanted));
                       }
                       std::vector<mesh::TriangleMesh> surfaces;
                       for (const OrganTerritories::Part& part : territories->parts) surfaces.push_back(*part.mesh);
                       RAMUS_TRY(written, write_organ_surfaces(parts, std::move(surfaces), wanted.file));
                       return has_written(written.front().file, saved_text("Territories", wanted));
                   },
                   true};
}

Result<Outcome> export_file(ActionContext& context, Arguments arguments) {
    if (!has_scene(context.document)) return fail("there is nothing to export");
    if (arguments.size() <= 1) { // without a file: opens the dialog at this kind
        const std::string kind = arguments.empty() ? std::string() : arguments[0];
        if (!kind.empty() && !export_kind_named(kind))
            return fail("there is no export of \"" + kind + "\"", {}, kExportUsage);
        if (context.files == nullptr) return fail("export needs a file here", {}, kExportUsage);
        context.files->ask_for_export(kind);
        return Done{};
    }
    RAMUS_TRY(wanted, export_in(context, arguments));
    if (wanted.kind().of_tree && !has_tree(context.document))
        return fail("there is no tree to export", wanted.file.string(), "pictures can be exported");
    if (auto possible = io::check_output(wanted.file); !possible) return tl::unexpected(possible.error());
    const auto exported = exported_branches(context.document, wanted.of);
    if (wanted.kind().of_branches && wanted.table.empty() &&
        std::ranges::count(exported, 0) == context.document.branch_count())
        return fail(wanted.of == ExportOf::kSelected ? "nothing is selected" : "every branch is hidden", {},
                    "select branches, or export all");
    switch (wanted.what) {
    case ExportWhat::kSurface:
        return export_surface(context, wanted);
    case ExportWhat::kTree:
        return export_tree(context, wanted);
    case ExportWhat::kTable:
        return export_table(context, wanted);
    case ExportWhat::kReport:
        return export_report(context, wanted);
    case ExportWhat::kPage:
        return export_page(context, wanted);
    case ExportWhat::kTerritories:
        return export_territories(context, wanted);
    case ExportWhat::kPicture:
    case ExportWhat::kSheet:
    case ExportWhat::kTurntable:
        break;
    }
    return export_figure(context, wanted);
}

} // namespace

Command export_command() {
    return Command("export", "[KIND [FILE [OPTIONS]]]",
                   "Writes what leaves the program, in the format of the name: surface, tree or table, of what is "
                   "visible, selected or all; picture, sheet or turntable, of any size, on any ground and with a "
                   "caption; report; or the territories that are shown. Without a file, asks where and how.",
                   export_file)
        .in_menu("File", "Export...", {"Ctrl+E"})
        .when(has_scene);
}

} // namespace ramus::app::actions
