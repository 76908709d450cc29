// `ramus render FILE -o PNG`: draws the picture of the window without a window.
#include "app/actions/script.h"
#include "app/assets/assets.h"
#include "app/assets/half_turn.h"
#include "app/commands/backend_flags.h"
#include "app/commands/colour_flags.h"
#include "app/commands/figure_flags.h"
#include "app/commands/inputs.h"
#include "app/commands/output_target.h"
#include "app/commands/picture_flags.h"
#include "app/commands/picture_stage.h"
#include "app/commands/printed_report.h"
#include "app/commands/progress.h"
#include "app/commands/subcommands.h"
#include "app/commands/surface_flags.h"
#include "app/commands/turn_benchmark.h"
#include "app/panels/interface.h"
#include "app/picture/figures.h"
#include "app/picture/fit.h"
#include "app/picture/slices.h"
#include "app/picture/video_file.h"
#include "app/session/colour_by.h"
#include "app/session/error_context.h"
#include "app/session/numbers.h"
#include "app/window/headless_interface.h"
#include "app/window/pace.h"
#include "core/base/stopwatch.h"
#include "core/io/file_format.h"
#include "core/io/input_file.h"
#include "core/io/meshes/mesh_file.h"
#include "core/io/output_file.h"
#include "core/io/run_inputs.h"
#include "render/gl/gl_context.h"
#include "render/gl/headless_context.h"
#include "render/image/image.h"
#include "render/image/perceived.h"
#include "render/renderer/renderer.h"

#include <array>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

namespace ramus::app {

namespace {

struct RenderFlags {
    SurfaceFlags common;
    std::filesystem::path file, output, reference;
    std::string camera, session, commands;
    std::string saved_view; // to look from; empty: not given
    bool overwrite = false; // the commands may replace files
    ColourFlags colours;
    std::vector<std::string> context; // files
    std::string mesh_axes;            // of meshes that do not state their axes; empty: not given
    glm::ivec2 size{1600, 1200};
    render::View view = render::View::kAnterior;
    bool view_given = false, orthographic = false, transparent = false, interface = false, json = false, notes = false;
    double tolerance = 0.001;         // share of pixels
    std::optional<double> noticeable; // replaces the tolerance: share of pixels that differ visibly
    int benchmark = 0;                // frames
    bool benchmark_full = false;
    BackendFlags backend;
    std::size_t graphics_bytes = 0; // for surfaces; 0: the renderer's own limit
    FigureOptions figure;
    ComparisonFlags comparison;
    DeviationFlags deviation;
    ScanFlags scans;
};

// Compares the picture with the reference. If they differ too much, writes a picture of the difference next to it.
Result<int> judge(const render::Image& image, const RenderFlags& flags, nlohmann::json& report) {
    RAMUS_TRY(reference, render::read_png(flags.reference));
    std::string finding;
    const auto comparison = render::compare(image, reference);
    if (comparison) {
        report["comparison"] = {{"pixels", comparison->pixels},
                                {"differing", comparison->differing},
                                {"fraction", comparison->fraction()},
                                {"largest", comparison->largest}};
        render::PerceivedDifference perceived;
        if (flags.noticeable || flags.json) { // slow, so only on request
            perceived = *render::perceived_difference(image, reference);
            report["comparison"]["perceived"] = {{"noticeable", perceived.noticeable},
                                                 {"fraction", perceived.fraction()},
                                                 {"mean", perceived.mean},
                                                 {"largest", perceived.largest}};
        }
        const double found = flags.noticeable ? perceived.fraction() : comparison->fraction();
        const double most = flags.noticeable.value_or(flags.tolerance);
        report["comparison"]["tolerance"] = most;
        if (found <= most) return kDone;
        const auto differing = flags.noticeable ? perceived.noticeable : comparison->differing;
        finding = std::to_string(differing) + " of " + std::to_string(comparison->pixels) + " pixels differ " +
                  (flags.noticeable ? "so that it can be seen" : "by more than 8/255") + ", " + std::to_string(most) +
                  " of them may";
    } else {
        finding = comparison.error().message();
        report["comparison"] = {{"error", finding}};
    }
    auto difference_path = flags.output;
    difference_path.replace_extension(".difference.png");
    if (auto written = render::write_png(render::difference(image, reference), difference_path); !written)
        return tl::unexpected(written.error());
    report["comparison"]["difference"] = difference_path.string();
    std::cerr << "ramus: " << flags.reference.string() << ": " << finding << "; the picture is "
              << flags.output.string() << ", the difference " << difference_path.string() << '\n';
    return kBeyondTolerance;
}

// Opens the tree and the session. Returns whether the session has a camera.
Result<bool> open_document(const RenderFlags& flags, Document& document) {
    RAMUS_TRY(opened, open_session(flags.file.string(), flags.session, flags.common, Alone::kAllowed));
    apply(flags.comparison, opened.session.marks);
    apply(flags.scans, opened.session.slices);
    // A scan alone is seen in slices.
    if (flags.file.empty() && flags.session.empty() && flags.scans.layout.empty())
        opened.session.slices.layout = SliceLayout::kSlices;
    if (auto good = apply(flags.colours, opened.tree ? *opened.tree : tree::VesselTree(), opened.session.marks); !good)
        return tl::unexpected(good.error());
    if (!flags.saved_view.empty()) {
        const std::vector<SavedView>& views = opened.session.marks.views;
        RAMUS_TRY(view, with_file(find_view(views, flags.saved_view), flags.session));
        opened.session.camera = views[view].camera;
        opened.has_camera = true;
    }
    document.open(std::move(opened.tree), std::move(opened.session), nullptr, {}, std::move(opened.base));
    return opened.has_camera;
}

// Draws the whole window, with the panels around the picture.
Result<Figure> draw_interface(const RenderFlags& flags, const Document& document, const PictureStage& stage,
                              render::Renderer& renderer, const std::function<Result<void>(ActionContext&)>& run) {
    Workspace workspace({});
    LoadedTree loaded;
    loaded.assets = stage.assets;
    loaded.session = document.session();
    loaded.base = document.base_tree();
    loaded.has_camera = true;
    loaded.cones = stage.surface();
    loaded.cones.request = surface_request(document.marks());
    workspace.adopt(std::move(loaded), document.session().tree.path);
    RAMUS_TRY(shown, picture_with_interface(workspace, renderer, flags.size, 1.0F, run));
    return Figure{std::move(shown.image), shown.scale_bar};
}

// The scale bar, for --json; null: the picture has none.
nlohmann::json description_of(const std::optional<render::ScaleBar>& bar) {
    if (!bar) return nullptr;
    return {{bar->unit_known ? "mm" : "units", bar->length_mm}, // as scripts know it
            {"length", bar->length_mm},
            {"unit", bar->unit_known ? "mm" : tree::kNotSaid},
            {"pixels", bar->pixels},
            {"at", render::name_of_place(bar->at)},
            {"percent", bar->percent}};
}

// Inputs other than the tree.
struct Inputs {
    std::optional<render::Camera> camera;
    std::vector<ScriptLine> script;
};

// Reads the inputs other than the tree. Also fails if the picture cannot be written or the reference cannot be read.
Result<Inputs> read_inputs(const RenderFlags& flags) {
    Inputs inputs;
    for (const std::filesystem::path& file :
         {flags.file, flags.reference, std::filesystem::path(flags.comparison.mask)})
        io::note_input(file);
    io::note_input(flags.session, io::InputKind::kSession);
    for (const auto* files : {&flags.context, &flags.scans.scans})
        for (const auto& file : *files) io::note_input(file);
    if (!flags.camera.empty()) {
        RAMUS_TRY(read, camera_in(flags.camera));
        inputs.camera = read;
    }
    if (!flags.commands.empty()) {
        RAMUS_TRY(read, read_script(flags.commands));
        inputs.script = std::move(read);
    }
    if (!flags.output.empty()) {
        if (auto can = io::check_output(flags.output); !can) return tl::unexpected(can.error());
        const bool is_picture = flags.figure.turntable == 0 || !is_video(flags.output);
        if (auto fits = is_picture ? render::check_png_name(flags.output) : Result<void>(); !fits)
            return tl::unexpected(fits.error());
    }
    if (!flags.reference.empty())
        if (auto can = render::read_png(flags.reference); !can) return tl::unexpected(can.error());
    return inputs;
}

// Writes pictures, or a video, of one turn around the tree.
Result<int> run_turntable(const RenderFlags& flags, render::SheetRenderer& sheets, const render::Sheet& sheet,
                          bool keep_camera) {
    FigureOptions options = flags.figure;
    options.whole = !keep_camera;
    const auto write = [&](Job& job) { return write_turntable(sheets, sheet, options, flags.output, job); };
    RAMUS_TRY(table, write_with_progress("pictures", write));
    say(flags.common,
        "wrote " +
            (is_video(flags.output) ? std::string() : counted(table.files.size(), "picture", "pictures") + " from ") +
            table.files.front().string());
    nlohmann::json report{{"pictures", nlohmann::json::array()},
                          {"scale_bar", description_of(table.scale_bar)},
                          {"gl", opengl_in_use(flags.backend.backend)}};
    for (const auto& file : table.files) report["pictures"].push_back(file.string());
    if (flags.json) std::cout << printed_report(report) << '\n';
    return kDone;
}

// Writes the picture, compares it with the reference, adds both to the report and returns the exit status.
Result<int> finish_picture(const render::Image& image, const RenderFlags& flags, nlohmann::json& report) {
    if (!flags.output.empty()) {
        if (auto written = render::write_png(image, flags.output); !written) return tl::unexpected(written.error());
        report["picture"] = flags.output.string();
        say(flags.common, "wrote " + flags.output.string());
    }
    return flags.reference.empty() ? Result<int>(kDone) : judge(image, flags, report);
}

// Sets the camera: that of --camera, that of the session, or one that shows the whole tree.
void set_camera(Document& document, const Inputs& inputs, bool session_has_one, const RenderFlags& flags,
                const PictureStage& stage) {
    if (inputs.camera) {
        document.set_camera(*inputs.camera);
    } else if (!session_has_one || flags.view_given) {
        const auto seen =
            stage.surface().mesh ? stage.surface().mesh->positions() : visible_points(document.marks(), stage.assets);
        document.set_camera(with_room(render::camera_for(seen, flags.view, stage.picture_size(), flags.orthographic),
                                      document.marks().comparison));
    }
    if (flags.orthographic) document.set_camera(render::with_projection(document.session().camera, true));
}

// Runs the commands of the options, then those of --commands.
Result<void> run_commands(ActionContext& here, const RenderFlags& flags,
                          const std::function<Result<void>(ActionContext&)>& run) {
    for (const std::string& file : flags.context) {
        std::vector<std::string> words{"context", file};
        if (!flags.comparison.mask_units.empty() && !io::is_mesh(file))
            words.insert(words.end(), {"--units", flags.comparison.mask_units});
        if (!flags.mesh_axes.empty() && io::names_mesh(file))
            words.insert(words.end(), {"--mesh-orientation", flags.mesh_axes});
        if (auto added = run_command(here, words); !added) return added;
    }
    for (const auto& lines :
         {command_lines(flags.deviation, flags.comparison.mask_units, flags.mesh_axes), command_lines(flags.scans)})
        for (const std::vector<std::string>& words : lines)
            if (auto set = run_command(here, words); !set) return set;
    if (flags.comparison.contact > 0) {
        const std::vector<std::string> words{"contact", std::to_string(flags.comparison.contact)};
        if (auto there = run_command(here, words); !there) return there;
    }
    return flags.interface ? Result<void>() : run(here);
}

// Warns of context shapes and lesions that are rotated by half a turn against the tree.
void warn_of_half_turns(const Document& document, const Assets& assets) {
    if (!document.tree()) return;
    const Marks& marks = document.marks();
    const Place vessels{render::bounds_of(*document.tree()), document.tree()->claims.orientation};
    const auto warn = [&](const std::string& file, const Place& mesh, const std::string& read_in) {
        const std::string hint = half_turn_hint(mesh, vessels, other_axes_option(read_in));
        if (!hint.empty()) std::cerr << "ramus: " << file << ": " << hint << '\n';
    };
    for (const ContextItem& item : marks.context)
        if (const auto shape = assets.context_shape(source_of(item)))
            warn(item.file, {shape->box, shape->claims.orientation}, item.axes);
    for (const Lesion& lesion : lesion_meshes(marks))
        if (const auto mesh = lesion.of_mask() ? nullptr : assets.lesion_mesh(lesion))
            warn(lesion.file, {render::bounds_of(mesh->mesh), mesh->claims.orientation}, lesion.axes);
}

// Of a scan without a tree, planes are seen aslant unless the person says otherwise.
void look_at_scan(Document& document, const Inputs& inputs, bool has_camera, const RenderFlags& flags,
                  const PictureStage& stage) {
    if (inputs.camera || flags.view_given) return set_camera(document, inputs, has_camera, flags, stage);
    document.set_camera(camera_of_planes(visible_points(document.marks(), stage.assets), stage.picture_size()));
}

// The benchmark, if there is one. `draw_seconds`: of the picture.
Result<void> time_turn(const RenderFlags& flags, render::SheetRenderer& sheets, const render::Sheet& sheet,
                       double draw_seconds, nlohmann::json& report) {
    if (flags.benchmark == 0) return {};
    const bool hurry = draw_seconds > Pace::kSlowSeconds && !flags.benchmark_full;
    if (auto ran = run_turn_benchmark(sheets, sheet, flags.benchmark, hurry, report); !ran)
        return tl::unexpected(ran.error());
    if (!flags.json) std::cout << benchmark_sentence(report) << '\n';
    return {};
}

Result<int> run_render(const RenderFlags& flags) {
    // Errors in the inputs are found before long computations.
    RAMUS_TRY(inputs, read_inputs(flags));
    Document document;
    RAMUS_TRY(has_camera, open_document(flags, document));
    Viewing viewing;
    viewing.size = flags.interface ? layout_of(flags.size, 1.0F, true).view_size : flags.size;
    if (flags.transparent) viewing.ground = Ground::kTransparent;
    viewing.notes = flags.notes;
    PictureStage stage(document, flags.common, viewing);
    if (auto made = with_file(stage.make_surface(), document.session().tree.path.string()); !made)
        return tl::unexpected(made.error());
    if (!document.tree())
        if (auto read = stage.complete_assets(); !read) return tl::unexpected(read.error());
    set_camera(document, inputs, has_camera, flags, stage);
    const auto context = open_context(flags.backend, flags.common);
    if (!context) return tl::unexpected(context.error());
    RAMUS_TRY(renderer, render::Renderer::create(render::kGlassBytes, flags.graphics_bytes));
    stage.draw_with(*renderer);
    const auto run = [&](ActionContext& to) {
        if (flags.file.empty() && flags.session.empty()) look_at_scan(document, inputs, has_camera, flags, stage);
        return run_script(to, inputs.script, flags.commands, flags.overwrite);
    };
    ActionContext here{.document = document,
                       .picture = stage,
                       .assets = stage.assets,
                       .tell = [&](const std::string& line) { say(flags.common, line); }};
    if (auto ran = run_commands(here, flags, run); !ran) return tl::unexpected(ran.error());
    warn_of_half_turns(document, stage.assets);

    RAMUS_TRY(sheet, stage.sheet());
    dress(sheet, flags.figure);
    render::SheetRenderer& sheets = stage.sheet_renderer();
    if (flags.figure.turntable > 0)
        return run_turntable(flags, sheets, sheet, inputs.camera || (has_camera && !flags.view_given));
    const Stopwatch watch;
    RAMUS_TRY(done, sheets.draw_with_scale(sheet));
    render::SheetRenderer::finish();
    const double draw_seconds = watch.seconds();
    // draw_figure() reuses the picture if the frame is unchanged.
    const auto compose_sized = [&](glm::ivec2 size) { return stage.sheet(size); };
    RAMUS_TRY(figure, flags.interface      ? draw_interface(flags, document, stage, *renderer, run)
                      : flags.figure.sheet ? draw_four_views(sheets, compose_sized, flags.size, flags.figure)
                                           : draw_figure(sheets, sheet, flags.figure));

    nlohmann::json report{{"size", {figure.image.width, figure.image.height}},
                          {"triangles", done.triangles},
                          {"mesh_s", stage.surface().seconds},
                          {"draw_s", draw_seconds},
                          {"gl", opengl_in_use(flags.backend.backend)},
                          {"camera", render::to_json(document.session().camera)},
                          {"scale_bar", description_of(figure.scale_bar)}};
    auto status = finish_picture(figure.image, flags, report);
    if (!status) return status;
    if (auto ran = time_turn(flags, sheets, sheet, draw_seconds, report); !ran) return tl::unexpected(ran.error());
    if (flags.json) std::cout << printed_report(report) << '\n';
    return *status;
}

// Adds the options that compare the picture with a reference, and those of the benchmark.
void add_checking_flags(CLI::App& command, RenderFlags& flags) {
    CLI::Option* reference = add_option(command, "--reference", "PNG", flags.reference,
                                        "Compare with this PNG; exit status 3 when they differ");
    add_option(command, "--tolerance", "T", flags.tolerance,
               "Share of the pixels that may differ from the reference by more than 8/255 (default 0.001)")
        ->check(CLI::Range(0.0, 1.0).description(""))
        ->needs(reference);
    add_option(command, "--noticeable", "T", flags.noticeable,
               "Instead: share of the pixels that may differ visibly, for a person at a screen")
        ->check(CLI::Range(0.0, 1.0).description(""))
        ->needs(reference);
    add_option(command, "--benchmark", "N", flags.benchmark,
               "Turn once around the tree in N frames, as the window does, and print how fast that was")
        ->check(CLI::Range(1, 1000000).description(""));
    command.add_flag("--benchmark-full", flags.benchmark_full,
                     "With --benchmark: draw every frame as if the view rested");
}

// Throws CLI::Error for options that are missing or cannot be combined.
void check_flags(const CLI::App& command, const RenderFlags& flags) {
    if (flags.file.empty() && flags.session.empty() && flags.scans.scans.empty())
        throw CLI::RequiredError("FILE, --session or --scan");
    if (!flags.saved_view.empty() && flags.session.empty())
        throw CLI::ValidationError("--view",
                                   flags.saved_view + " is no direction, and only a --session has saved views");
    check_backend_flags(flags.backend);
    if (flags.figure.turntable > 0 && flags.output.empty()) throw CLI::RequiredError("-o");
    if (flags.figure.turntable > 0 && (flags.interface || !flags.reference.empty() || flags.benchmark > 0))
        throw CLI::ValidationError("--turntable", "cannot be combined with --ui, --reference or --benchmark");
    if (flags.figure.turntable > 0 && is_standard_output(flags.output))
        throw CLI::ValidationError("--turntable", "makes several pictures, or a video, and standard output takes one");
    check_comparison_flags(command, flags.comparison);
    if (flags.figure.sheet && flags.interface) throw CLI::ValidationError("--sheet", "cannot be combined with --ui");
    const bool other_result = flags.benchmark > 0 || !flags.commands.empty();
    if (flags.output.empty() && (!other_result || !flags.reference.empty() || flags.interface))
        throw CLI::RequiredError("-o");
}

} // namespace

void register_render(CLI::App& app, Action& chosen) {
    auto flags = std::make_shared<RenderFlags>();
    CLI::App* command = add_command(app, "render", "Draw the window's picture without a window");
    add_input(*command, "FILE", "", flags->file, "Vessel tree; may be left out with --session");
    add_option(*command, "-o,--output", "PNG", flags->output, "PNG to write");
    add_size_flag(*command, flags->size);
    CLI::Option* view = add_view_flag(*command, flags->view, flags->saved_view);
    add_graphics_memory_flag(*command, flags->graphics_bytes);
    add_option(*command, "--session", "FILE", flags->session,
               "Draw this session: its tree, states, camera and surface options");
    add_option(*command, "--commands", "FILE", flags->commands,
               "Run these commands first, one per line (`select 12`, `hide`, ...)");
    command->add_flag("--overwrite", flags->overwrite, kOverwriteHelp)->needs("--commands");
    add_input(*command, "--context", "FILE", flags->context,
              "Show the surface of this mask or mesh next to the tree (" + context_extensions() + "); may be repeated")
        ->allow_extra_args(false);
    add_mesh_orientation_flag(*command, flags->mesh_axes, "meshes of --context and --deviation-from");
    add_scan_flags(*command, flags->scans);
    add_colour_flags(*command, flags->colours);
    command->add_flag("--ui", flags->interface, "Draw the whole window, with the panels around the picture");
    command->add_flag("--notes", flags->notes,
                      "Mark the places that reading the tree repaired or finds strange (`ramus info` lists them)");
    add_option(*command, "--camera", "JSON|FILE", flags->camera,
               "Camera as JSON, or a file with it, named as in a session file")
        ->excludes(view);
    command->add_flag("--orthographic", flags->orthographic,
                      "Parallel projection: equal lengths look equal near and far");
    add_method_flag(*command, false, [flags](mesh::Method method) { flags->common.surface.method = method; });
    command->add_flag("--transparent", flags->transparent, "Leave the background transparent");
    add_checking_flags(*command, *flags);
    add_backend_flags(*command, flags->backend);
    add_figure_flags(*command, flags->figure);
    add_comparison_flags(*command, flags->comparison);
    add_deviation_flags(*command, flags->deviation);
    command->add_flag("--json", flags->json, "Print what was done as one JSON object");
    add_surface_flags(*command, flags->common);
    add_system_flag(*command, flags->common);
    command->callback([flags, command, view, &chosen] {
        flags->view_given = view->count() > 0 && flags->saved_view.empty();
        check_flags(*command, *flags);
        check_output_flags(*command, flags->output, {});
        chosen = [flags] { return with_output(*flags, run_render); };
    });
}

} // namespace ramus::app
