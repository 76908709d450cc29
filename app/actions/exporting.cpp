// Export: the surface, the tree, a table of branches or the picture as a file, of what is visible, selected, or all.
#include "app/actions/arguments.h"
#include "app/actions/export_kinds.h"
#include "app/actions/groups.h"
#include "app/assets/assets.h"
#include "app/picture/surface_names.h"
#include "app/reports/report_tables.h"
#include "app/session/systems.h"
#include "app/session/thickness_text.h"
#include "core/io/meshes/mesh_file.h"
#include "core/io/meshes/surface_file.h"
#include "core/io/output_file.h"
#include "core/io/text_numbers.h"
#include "core/io/trees/tree_file.h"
#include "core/measure/wall_thickness.h"
#include "core/mesh/close_mesh.h"
#include "core/tree/part_of_tree.h"

#include <algorithm>

namespace ramus::app::actions {

namespace {

namespace fs = std::filesystem;

constexpr const char* kExportUsage = "export surface|tree|table|picture FILE [--of visible|selected|all] "
                                     "[--parts branch|system|none] [--for-printing]";

struct Export {
    ExportWhat what{};
    ExportOf of = ExportOf::kVisible;
    fs::path file;
    std::optional<io::PartsBy> parts; // none: what is usual
    bool for_printing = false;
};

Result<Export> export_in(ActionContext& context, Arguments arguments) {
    Export wanted;
    const auto kind = export_kind_named(arguments[0]);
    if (!kind) return fail("there is no export of \"" + arguments[0] + "\"", {}, kExportUsage);
    wanted.what = *kind;
    std::string file;
    for (std::size_t i = 1; i < arguments.size(); ++i) {
        const std::string& word = arguments[i];
        if (word == "--for-printing") {
            wanted.for_printing = true;
        } else if (word == "--of" || word == "--parts") {
            const std::string value = i + 1 < arguments.size() ? arguments[++i] : std::string();
            const auto* const scope = std::ranges::find(kExportScopes, value, &ExportScope::key);
            if (word == "--of" && scope == kExportScopes.end())
                return fail("--of takes visible, selected or all", {}, kExportUsage);
            if (word == "--of")
                wanted.of = scope->of;
            else if (!(wanted.parts = parts_named(value)))
                return fail("--parts takes branch, system or none", {}, kExportUsage);
        } else if (word.starts_with("--") || word.empty() || !file.empty()) {
            return fail("export takes what, and one file", {}, kExportUsage);
        } else {
            file = word;
        }
    }
    if (file.empty()) return fail("export takes a file", {}, kExportUsage);
    if (wanted.what != ExportWhat::kSurface && (wanted.parts || wanted.for_printing))
        return fail("only a surface has parts, or is printed", {}, kExportUsage);
    RAMUS_TRY(path, file_argument(context, Arguments(&file, 1), "export", ""));
    wanted.file = fs::absolute(path).lexically_normal();
    return wanted;
}

std::string saved_text(const char* what, const Export& wanted) {
    return std::string(what) + " saved: " + wanted.file.string();
}

// The end of pending work: nothing is changed, something is said.
Continuation saying(std::string sentence) {
    return [sentence = std::move(sentence)](ActionContext& then) {
        then.say(sentence);
        return Result<void>{};
    };
}

Result<void> expect_extension(const Export& wanted, std::string_view extension, const char* what) {
    if (io::lower_case(wanted.file.extension().string()) == extension) return {};
    return fail(std::string(what) + " is a file of type " + std::string(extension), wanted.file.string(),
                "give the name this ending");
}

// What goes to another thread: values and shared, immutable things only.
struct SurfaceWork {
    std::shared_ptr<const tree::VesselTree> tree;
    mesh::SurfaceOptions options;
    std::vector<std::uint8_t> hidden;
    io::MeshNames names;
    Export wanted;
};

Result<void> stream(const SurfaceWork& work, Job& job) {
    RAMUS_TRY(file, io::SurfaceFile::create(work.wanted.file, work.names.claims));
    const auto streamed = mesh::stream_surface(*work.tree, work.options, *file, job, work.hidden);
    if (auto taken = file->check(); !taken) return taken;
    if (!streamed) return tl::unexpected(streamed.error());
    return file->commit();
}

Result<Continuation> write_surface_of(const SurfaceWork& work, Job& job) {
    const std::string sentence = saved_text("Surface", work.wanted);
    if (mesh::asks_for_streaming(*work.tree, work.options, work.hidden)) {
        if (work.wanted.for_printing)
            return fail("the surface is larger than memory, and cannot be measured for printing", {},
                        "use a lower detail");
        if (auto written = stream(work, job); !written) return tl::unexpected(written.error());
        return saying(sentence);
    }
    RAMUS_TRY(surface, mesh::make_surface(*work.tree, work.options, job, work.hidden));
    std::string printing;
    if (work.wanted.for_printing) {
        if (auto closed = mesh::check_closed(surface.mesh, work.wanted.file.string()); !closed)
            return tl::unexpected(closed.error());
        const auto thicknesses = measure::least_thicknesses(surface.mesh, work.options.threads);
        const std::string thin = thin_text(thicknesses, kThinnestPrintedMm);
        printing = "; " + (thin.empty() ? printing_text(thicknesses, Lengths(work.names.claims)) : thin);
    }
    if (job.cancelled()) return fail("cancelled");
    if (auto written = io::write_mesh(surface.mesh, work.wanted.file, work.names); !written)
        return tl::unexpected(written.error());
    return saying(sentence + printing);
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
    if (!io::is_streamed(*format)) {
        refresh(context.assets, document);
        work->names = surface_names(*document.tree(), *document.facts(), document.marks(), context.assets.plan.get(),
                                    wanted.parts.value_or(usual_parts(*document.tree())));
    }
    return Pending{"Exporting " + wanted.file.filename().string(),
                   [work](Job& job) { return write_surface_of(*work, job); }};
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
            return saying(saved_text("Tree", wanted));
        }};
}

Result<Outcome> export_table(ActionContext& context, const Export& wanted) {
    if (auto fits = expect_extension(wanted, ".csv", "a table"); !fits) return tl::unexpected(fits.error());
    complete_lesions(context.assets, context.document);
    const auto exported = exported_branches(context.document, wanted.of);
    const auto ids = branches_where(exported.size(), [&](std::size_t id) { return exported[id] != 0; });
    const Table table = branches_table(context.document, context.assets, ids);
    if (auto written = io::write_file(wanted.file, csv_of(table)); !written) return tl::unexpected(written.error());
    context.say(saved_text("Table", wanted));
    return Done{};
}

Result<Outcome> export_picture(ActionContext& context, const Export& wanted) {
    if (auto fits = expect_extension(wanted, ".png", "a picture"); !fits) return tl::unexpected(fits.error());
    if (auto written = context.picture.write_picture(wanted.file); !written) return tl::unexpected(written.error());
    context.say(saved_text("Picture", wanted));
    return Done{};
}

Result<Outcome> export_file(ActionContext& context, Arguments arguments) {
    if (!has_tree(context.document)) return fail("there is no tree to export");
    if (arguments.empty())
        return outcome_of(
            ask_for_file(context, FilePurpose::kExport, fail("export needs a file here", {}, kExportUsage)));
    RAMUS_TRY(wanted, export_in(context, arguments));
    if (auto possible = io::check_output(wanted.file); !possible) return tl::unexpected(possible.error());
    if (std::ranges::count(exported_branches(context.document, wanted.of), 0) == context.document.branch_count() &&
        wanted.what != ExportWhat::kPicture)
        return fail(wanted.of == ExportOf::kSelected ? "nothing is selected" : "every branch is hidden", {},
                    "select branches, or export all");
    switch (wanted.what) {
    case ExportWhat::kSurface:
        return export_surface(context, wanted);
    case ExportWhat::kTree:
        return export_tree(context, wanted);
    case ExportWhat::kTable:
        return export_table(context, wanted);
    case ExportWhat::kPicture:
        break;
    }
    return export_picture(context, wanted);
}

} // namespace

Command export_command() {
    return Command("export",
                   "[surface|tree|table|picture FILE [--of visible|selected|all] [--parts branch|system|none] "
                   "[--for-printing]]",
                   "Writes the surface, the tree, a table of branches or the picture, of what is visible, selected or "
                   "all, in the format of the name; without words, asks what and where.",
                   export_file)
        .in_menu("File", "Export...", {"Ctrl+E"})
        .when(has_tree);
}

} // namespace ramus::app::actions
