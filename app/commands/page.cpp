// `ramus page FILE -o HTML`: the whole case as one page that any browser opens.
#include "app/actions/case_pages.h"
#include "app/commands/backend_flags.h"
#include "app/commands/colour_flags.h"
#include "app/commands/inputs.h"
#include "app/commands/output_target.h"
#include "app/commands/picture_stage.h"
#include "app/commands/printed_report.h"
#include "app/commands/progress.h"
#include "app/commands/subcommands.h"
#include "app/commands/surface_flags.h"
#include "app/session/error_context.h"
#include "app/session/numbers.h"
#include "core/io/output_file.h"
#include "core/io/run_inputs.h"
#include "core/io/text_numbers.h"
#include "render/gl/gl_context.h"
#include "render/renderer/renderer.h"

#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

namespace ramus::app {

namespace {

struct PageFlags {
    SurfaceFlags common;
    std::filesystem::path file, output;
    std::string session;
    std::string format = ".html"; // of standard output
    PageChoice choice;
    ColourFlags colours;
    BackendFlags backend;
    bool json = false;
};

Result<void> check_page_files(const PageFlags& flags) {
    io::note_input(flags.file);
    io::note_input(flags.session, io::InputKind::kSession);
    const std::string extension = io::lower_case(flags.output.extension().string());
    if (extension != ".html" && extension != ".htm")
        return fail("a page is an .html file", flags.output.string(), "give the name this ending");
    return io::check_output(flags.output);
}

// Opens the tree and the session. Without a camera in the session everything is seen from the front.
Result<bool> open_case(const PageFlags& flags, Document& document) {
    RAMUS_TRY(opened, open_session(flags.file.string(), flags.session, flags.common));
    if (auto good = apply(flags.colours, *opened.tree, opened.session.marks); !good)
        return tl::unexpected(good.error());
    document.open(std::move(opened.tree), std::move(opened.session), nullptr, {}, std::move(opened.base));
    return opened.has_camera;
}

nlohmann::ordered_json page_report(const PageFlags& flags, const CasePage& page) {
    nlohmann::ordered_json report = {{"page", flags.output.string()},
                                     {"bytes", page.html.size()},
                                     {"limit_bytes", flags.choice.most_bytes},
                                     {"triangles", page.triangles},
                                     {"triangles_before", page.triangles_before},
                                     {"largest_deviation_mm", page.largest_deviation_mm},
                                     {"simplified", page.simplified},
                                     {"sizes", nlohmann::ordered_json::array()}};
    for (const auto& [part, bytes] : page.sizes) report["sizes"].push_back({{"part", part}, {"bytes", bytes}});
    return report;
}

void print_page(const PageFlags& flags, const CasePage& page) {
    std::cout << actions::page_sentence(page, output_name(flags.output)) << '\n';
    for (const auto& [part, bytes] : page.sizes)
        if (bytes > 0) std::cout << "  " << part << ": " << grouped((bytes + 999) / 1000) << " kB\n";
}

// The context of OpenGL and what draws with it; empty for a page without pictures.
struct PageDrawing {
    std::unique_ptr<render::GlContext> context;
    std::unique_ptr<render::Renderer> renderer;
};
Result<PageDrawing> page_drawing(const PageFlags& flags) {
    PageDrawing drawing;
    if (has_part(flags.choice.left_out, PagePart::kViews)) return drawing;
    RAMUS_TRY(context, open_context(flags.backend, flags.common));
    drawing.context = std::move(context);
    RAMUS_TRY(renderer, render::Renderer::create(render::kGlassBytes, 0));
    drawing.renderer = std::move(renderer);
    return drawing;
}

Result<int> run_page(const PageFlags& flags) {
    if (auto good = check_page_files(flags); !good) return tl::unexpected(good.error());
    Document document;
    RAMUS_TRY(has_camera, open_case(flags, document));
    Viewing viewing;
    viewing.size = {1600, 1200};
    RAMUS_TRY(drawing, page_drawing(flags));
    PictureStage stage(document, flags.common, viewing);
    if (auto made = with_file(stage.make_surface(), document.session().tree.path.string()); !made)
        return tl::unexpected(made.error());
    if (!has_camera)
        document.set_camera(
            render::camera_for(stage.surface().mesh->positions(), render::View::kAnterior, viewing.size));
    if (drawing.renderer) stage.draw_with(*drawing.renderer);
    ActionContext here{.document = document, .picture = stage, .assets = stage.assets};
    PageChoice choice = flags.choice;
    choice.threads = flags.common.surface.threads;
    const auto make = [&](Job& job) { return actions::make_case_page(here, choice, viewing.size, job); };
    RAMUS_TRY(page, with_progress("page", make, kNothingWritten));
    if (auto written = io::write_file(flags.output, page.html); !written) return tl::unexpected(written.error());
    if (flags.json)
        std::cout << printed_report(page_report(flags, page), document.claims()) << '\n';
    else
        print_page(flags, page);
    return kDone;
}

std::string page_parts_help() {
    std::string help = "Leave something out; may be repeated, or a list. ";
    for (const PagePartRow& row : kPageParts)
        help += (row.part == kPageParts.front().part ? "" : "; ") + std::string(row.name) + ": " + row.help;
    return help;
}

} // namespace

void register_page(CLI::App& app, Action& chosen) {
    auto flags = std::make_shared<PageFlags>();
    CLI::App* command =
        add_command(app, "page", "The whole case as one page that any browser opens, without a network");
    add_input(*command, "FILE", "", flags->file, "Vessel tree; may be left out with --session");
    add_option(*command, "-o,--output", "HTML", flags->output, "Page to write")->required();
    add_option(*command, "--session", "FILE", flags->session,
               "This session: its tree, states, plans, measurements and camera");
    add_option(*command, "--title", "TEXT", flags->choice.title, "Title of the page (default: the name of the file)");
    add_option_taking<std::string>(
        *command, "--size-limit", "MB",
        [flags](const std::string& word) { flags->choice.most_bytes = *actions::page_bytes_in(word); },
        "The page is no larger than this; the surface is simplified for it, and the page says how much (default 12)")
        ->check(expecting(" is not a size in MB from 0.1 to 2000",
                          [](const std::string& word) { return actions::page_bytes_in(word).has_value(); }));
    command
        ->add_option_function<std::vector<std::string>>(
            "--without",
            [flags](const std::vector<std::string>& words) {
                for (const std::string& word : words) flags->choice.left_out.push_back(*page_part_named(word));
            },
            page_parts_help())
        ->type_name("PART")
        ->delimiter(',')
        ->allow_extra_args(false)
        ->check(expecting(" is not a part of a page",
                          [](const std::string& word) { return page_part_named(word).has_value(); }));
    add_method_flag(*command, false, [flags](mesh::Method method) { flags->common.surface.method = method; });
    add_colour_flags(*command, flags->colours);
    add_backend_flags(*command, flags->backend);
    command->add_flag("--json", flags->json, "Print what was written as one JSON object");
    add_surface_flags(*command, flags->common);
    add_system_flag(*command, flags->common);
    command->callback([flags, command, &chosen] {
        if (flags->file.empty() && flags->session.empty()) throw CLI::RequiredError("FILE or --session");
        check_backend_flags(flags->backend);
        check_output_flags(*command, flags->output, {});
        chosen = [flags] { return with_output(*flags, run_page); };
    });
}

} // namespace ramus::app
