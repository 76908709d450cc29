#include "app/commands/render.h"

#include "app/commands/interrupt.h"
#include "app/commands/load_tree.h"
#include "app/commands/progress_bar.h"
#include "app/commands/surface_flags.h"
#include "app/compose.h"
#include "core/io/output_file.h"
#include "core/io/tree_reader.h"
#include "render/gl_context.h"
#include "render/osmesa_context.h"
#include "render/renderer.h"

#include <charconv>
#include <chrono>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

namespace ramus::app {

namespace {

struct RenderFlags {
    SurfaceFlags common;
    std::filesystem::path file, output, reference;
    std::string camera;
    glm::ivec2 size{1600, 1200};
    render::View view = render::View::kAnterior;
    bool orthographic = false, transparent = false, json = false;
    double tolerance = 0.001; // of the pixels
    int benchmark = 0;        // frames
};

double seconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// "1600x1200", within what can be drawn; else a message for the user.
std::string read_size(const std::string& text, glm::ivec2& size) {
    std::int64_t width = 0, height = 0;
    const char *const end = text.data() + text.size(), *const kWanted = " is not a size such as 1600x1200";
    const auto x = std::from_chars(text.data(), end, width);
    if (x.ec != std::errc{} || x.ptr == end || *x.ptr != 'x') return text + kWanted;
    const auto y = std::from_chars(x.ptr + 1, end, height);
    if (y.ec != std::errc{} || y.ptr != end) return text + kWanted;
    if (const auto fits = render::check_size(width, height); !fits) return fits.error().message();
    size = {width, height};
    return {};
}

Result<render::Camera> read_camera(const std::string& text) {
    if (text.find('{') != std::string::npos) return render::parse_camera(text, "--camera");
    const auto content = io::read_file(text, 1 << 20);
    if (!content) return tl::unexpected(content.error());
    return render::parse_camera(*content, text);
}

// The picture against the reference. The difference is left beside the picture when there is too much of it.
Result<int> judge(const render::Image& image, const RenderFlags& flags, nlohmann::json& report) {
    const auto reference = render::read_png(flags.reference);
    if (!reference) return tl::unexpected(reference.error());
    std::string finding;
    const auto comparison = render::compare(image, *reference);
    if (comparison) {
        report["comparison"] = {{"pixels", comparison->pixels},
                                {"differing", comparison->differing},
                                {"fraction", comparison->fraction()},
                                {"largest", comparison->largest},
                                {"tolerance", flags.tolerance}};
        if (comparison->fraction() <= flags.tolerance) return kDone;
        finding = std::to_string(comparison->differing) + " of " + std::to_string(comparison->pixels) +
                  " pixels differ by more than 8/255, " + std::to_string(flags.tolerance) + " of them may";
    } else {
        finding = comparison.error().message();
        report["comparison"] = {{"error", finding}};
    }
    auto beside = flags.output;
    beside.replace_extension(".difference.png");
    if (auto written = render::write_png(render::difference(image, *reference), beside); !written)
        return tl::unexpected(written.error());
    report["comparison"]["difference"] = beside.string();
    std::cerr << "ramus: " << flags.reference.string() << ": " << finding << "; the picture is "
              << flags.output.string() << ", the difference " << beside.string() << '\n';
    return kBeyondTolerance;
}

// Once around the tree.
Result<void> run_benchmark(render::Renderer& renderer, render::Frame frame, const RenderFlags& flags,
                           nlohmann::json& report) {
    const render::Camera start_camera = frame.camera;
    std::uint64_t triangles = 0;
    const auto start = std::chrono::steady_clock::now();
    for (int i = 0; i < flags.benchmark; ++i) {
        frame.camera = render::turned(start_camera, 360.0 * (i + 1) / flags.benchmark, 0.0);
        const auto done = renderer.draw(frame);
        if (!done) return tl::unexpected(done.error());
        triangles += done->triangles;
        (void)renderer.pick(0.0, 0.0); // waits until the frame is there
    }
    const double seconds = seconds_since(start), fps = flags.benchmark / std::max(seconds, 1e-9);
    const double mean = static_cast<double>(triangles) / flags.benchmark;
    report["frames"] = flags.benchmark;
    report["seconds"] = seconds;
    report["fps"] = fps;
    report["triangles"] = mean;
    if (!flags.json)
        std::cout << flags.benchmark << " frames in " << seconds << " s: " << fps << " a second, "
                  << static_cast<std::uint64_t>(mean) << " triangles a frame\n";
    return {};
}

Result<int> run_render(const RenderFlags& flags) {
    const auto say = [&](const std::string& line) { app::say(flags.common, line); };
    // What can be wrong is found before the long work.
    std::optional<render::Camera> camera;
    if (!flags.camera.empty()) {
        auto read = read_camera(flags.camera);
        if (!read) return tl::unexpected(read.error());
        camera = *read;
    }
    if (!flags.output.empty())
        if (auto can = io::check_output(flags.output); !can) return tl::unexpected(can.error());
    if (!flags.reference.empty())
        if (auto can = render::read_png(flags.reference); !can) return tl::unexpected(can.error());

    auto read = load_tree(flags.file.string(), flags.common);
    if (!read) return tl::unexpected(read.error());
    const auto tree = std::make_shared<const tree::VesselTree>(std::move(*read));

    Job job;
    auto surface = [&] {
        const CancelOnInterrupt cancel(job);
        const ProgressBar bar("surface", job);
        return mesh::make_surface(*tree, flags.common.surface, job);
    }();
    if (job.cancelled()) return fail("cancelled; nothing was written");
    if (!surface) return tl::unexpected(surface.error());
    const auto mesh = std::make_shared<const mesh::TriangleMesh>(std::move(surface->mesh));
    say(counted(mesh->triangles.size(), "triangle", "triangles") + " in " + rounded(surface->statistics.seconds) +
        " s");

    Session session;
    session.tree.path = flags.file;
    session.marks.options = flags.common.surface;
    session.camera = camera ? *camera : render::camera_for(mesh->positions, flags.view, flags.size, flags.orthographic);
    if (camera && flags.orthographic) session.camera = render::with_projection(session.camera, true);

    Viewing viewing;
    viewing.size = flags.size;
    viewing.transparent = flags.transparent;
    const render::Frame frame = compose(session, tree, mesh, viewing);

    const auto context = render::make_osmesa_context();
    if (!context) return tl::unexpected(context.error());
    say(render::gl_description());
    const auto renderer = render::Renderer::create();
    if (!renderer) return tl::unexpected(renderer.error());
    const auto start = std::chrono::steady_clock::now();
    const auto done = (*renderer)->draw(frame);
    if (!done) return tl::unexpected(done.error());
    const render::Image image = (*renderer)->read_image();

    nlohmann::json report{{"size", {image.width, image.height}},
                          {"triangles", done->triangles},
                          {"mesh_s", surface->statistics.seconds},
                          {"draw_s", seconds_since(start)},
                          {"camera", render::to_json(session.camera)}};
    int status = kDone;
    if (!flags.output.empty()) {
        if (auto written = render::write_png(image, flags.output); !written) return tl::unexpected(written.error());
        report["picture"] = flags.output.string();
        say("wrote " + flags.output.string());
    }
    if (!flags.reference.empty()) {
        const auto verdict = judge(image, flags, report);
        if (!verdict) return tl::unexpected(verdict.error());
        status = *verdict;
    }
    if (flags.benchmark > 0)
        if (auto ran = run_benchmark(**renderer, frame, flags, report); !ran) return tl::unexpected(ran.error());
    if (flags.json) std::cout << report.dump(2) << '\n';
    return status;
}

} // namespace

void register_render(CLI::App& app, Action& chosen) {
    auto flags = std::make_shared<RenderFlags>();
    CLI::App* command = add_command(app, "render", "Make the window's picture without a window");
    command->add_option("FILE", flags->file, "Vessel tree")->type_name("")->required();
    command->add_option("-o,--output", flags->output, "PNG to write")->type_name("PNG");
    command
        ->add_option_function<std::string>(
            "--size",
            [flags](const std::string& text) {
                if (const std::string wrong = read_size(text, flags->size); !wrong.empty())
                    throw CLI::ValidationError("--size", wrong);
            },
            "Pixels of the picture (default 1600x1200)")
        ->type_name("WxH");
    std::map<std::string, render::View> views;
    for (const render::View view : render::kViews) views.emplace(render::name_of(view), view);
    CLI::Option* view =
        command->add_option("--view", flags->view, "anterior (default), posterior, left, right, superior or inferior")
            ->type_name("NAME")
            ->transform(CLI::CheckedTransformer(views).description(""));
    command->add_option("--camera", flags->camera, "Camera as JSON, or a file with it, named as in a session file")
        ->type_name("JSON|FILE")
        ->excludes(view);
    command->add_flag("--orthographic", flags->orthographic,
                      "Parallel projection: equal lengths look equal near and far");
    const std::map<std::string, mesh::Method> methods{{"cs", mesh::Method::kConvolutionSurface},
                                                      {"cones", mesh::Method::kTruncatedCones}};
    command->add_option("--method", flags->common.surface.method, "cs, the convolution surface (default), or cones")
        ->type_name("NAME")
        ->transform(CLI::CheckedTransformer(methods).description(""));
    command->add_flag("--transparent", flags->transparent, "Nothing behind the tree instead of the background");
    CLI::Option* reference =
        command->add_option("--reference", flags->reference, "Compare with this PNG; exit status 3 when they differ")
            ->type_name("PNG");
    command
        ->add_option("--tolerance", flags->tolerance,
                     "Share of the pixels that may differ from the reference by more than 8/255 (default 0.001)")
        ->type_name("T")
        ->check(CLI::Range(0.0, 1.0).description(""))
        ->needs(reference);
    command
        ->add_option("--benchmark", flags->benchmark,
                     "Turn once around the tree in N frames and tell how fast that was")
        ->type_name("N")
        ->check(CLI::Range(1, 1000000).description(""));
    command->add_flag("--json", flags->json, "Print what was done as one JSON object");
    add_surface_flags(*command, flags->common);
    command->callback([flags, &chosen] {
        if (flags->output.empty() && (flags->benchmark == 0 || !flags->reference.empty()))
            throw CLI::RequiredError("-o");
        chosen = [flags] { return run_render(*flags); };
    });
}

} // namespace ramus::app
