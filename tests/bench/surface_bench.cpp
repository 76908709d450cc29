// How fast the surface is made, and how much work that is: the convolution surface at --detail (radius-adaptive,
// closed, welded, with normals, radii and branches) and the truncated cones, on a grown tree of 1,504 branches and on
// the trees named on the command line. Every tree runs in a process of its own, so that peak memory is its own.
//
// Columns: the median over the runs of seconds and million triangles a second; the share of the three steps; kernel
// evaluations per vertex; peak memory of the process; and how many times the evaluations, and the time to do them,
// would grow if every sample summed over all segments (the time is measured on a seeded subset of samples and scaled
// up).
#include "core/field/sampling.h"
#include "core/io/tree_reader.h"
#include "core/mesh/cones.h"
#include "core/mesh/polygonize/polygonize.h"
#include "core/tree/build_tree.h"
#include "core/tree/grow/grow.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <functional>
#include <numeric>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>
#include <random>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

using namespace ramus;

namespace {

struct BenchOptions {
    int runs = 7;
    int threads = 2;
    int detail = 16;
    double cell_mm = 0.0;
    int smooth = 1;
};

double seconds_of(const std::function<void()>& work) {
    const auto start = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

double median(std::vector<double> values) {
    std::ranges::sort(values);
    return values[values.size() / 2];
}

Result<tree::VesselTree> grown_tree() {
    Job job;
    const auto grown = tree::grow({}, job);
    if (!grown) return tl::unexpected(grown.error());
    tree::Graph graph;
    graph.points = grown->points;
    for (std::uint32_t i = 0; i < grown->parents.size(); ++i) {
        if (grown->parents[i] < 0)
            graph.roots.push_back(i);
        else
            graph.edges.emplace_back(static_cast<std::uint32_t>(grown->parents[i]), i);
    }
    return tree::build_tree(std::move(graph), tree::Repair::kAll, [](std::uint32_t) { return std::string("grown"); });
}

// Seconds to sum all segments at every one of `samples` points, in parallel, scaled up from a subset of them.
double all_segments_seconds(const field::ConvolutionField& field, const mesh::TriangleMesh& mesh,
                            std::uint64_t samples) {
    std::vector<std::uint32_t> all(field.segments().size());
    std::iota(all.begin(), all.end(), 0U);
    std::mt19937 random(1);
    const std::size_t bricks = std::clamp<std::size_t>(400'000'000 / (all.size() * field::kGridPoints), 8, 4096);
    std::vector<glm::dvec3> places(bricks);
    for (auto& place : places) place = glm::dvec3(mesh.positions[random() % mesh.positions.size()]);
    const double seconds = seconds_of([&] {
        tbb::parallel_for(std::size_t{0}, bricks, [&](std::size_t n) {
            field::GridAxes axes;
            for (std::size_t i = 0; i < field::kGridSide; ++i) {
                const double step = 0.1 * static_cast<double>(i);
                axes.x[i] = places[n].x + step, axes.y[i] = places[n].y + step, axes.z[i] = places[n].z + step;
            }
            thread_local field::LocalSegments local;
            thread_local field::GridGroups values;
            field::gather_segments(field, all, axes, local);
            field::sample_groups(local, 0xFF, values);
        });
    });
    return seconds * static_cast<double>(samples) / static_cast<double>(bricks * field::kGridPoints);
}

void measure(const std::string& name, const tree::VesselTree& tree, const BenchOptions& options) {
    mesh::SurfaceOptions surface_options;
    surface_options.smooth_passes = options.smooth;
    const tree::PreparedTree prepared = mesh::prepare_tree(tree, surface_options);
    const field::ConvolutionField field(prepared, surface_options.width);
    mesh::PolygonizeOptions polygonize_options;
    polygonize_options.detail = options.detail;
    polygonize_options.cell_mm = options.cell_mm;
    Job job;
    mesh::PolygonizeStatistics statistics;
    mesh::TriangleMesh mesh;
    std::vector<double> total, bricks, cells, join, cone;
    for (int run = 0; run <= options.runs; ++run) {
        mesh = {};
        const double seconds = seconds_of([&] {
            auto made = mesh::polygonize(field, polygonize_options, job, &statistics);
            if (made) mesh = std::move(*made);
        });
        if (run == 0) continue; // warms the caches
        total.push_back(seconds);
        bricks.push_back(statistics.bricks_s), cells.push_back(statistics.cells_s), join.push_back(statistics.join_s);
    }
    if (mesh.triangles.empty()) {
        std::printf("%-26s could not be meshed\n", name.c_str());
        return;
    }
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    const double evaluations = static_cast<double>(statistics.evaluations);
    const double all_evaluations =
        static_cast<double>(statistics.samples) * static_cast<double>(field.segments().size());
    const double all_seconds = all_segments_seconds(field, mesh, statistics.samples);
    std::size_t cone_triangles = 0;
    for (int run = 0; run <= options.runs; ++run) {
        const double seconds =
            seconds_of([&] { cone_triangles = mesh::cones(prepared, options.detail, job)->triangles.size(); });
        if (run > 0) cone.push_back(seconds);
    }
    const double time = median(total);
    std::printf("%-26s %7zu %8.3f %7.3f %6.2f  %4.0f %4.0f %4.0f  %7.1f %6.1f %6ld %7.0fx %6.0fx  %7.4f %6.3f\n",
                name.c_str(), field.segments().size(), static_cast<double>(mesh.triangles.size()) / 1e6, time,
                static_cast<double>(mesh.triangles.size()) / time / 1e6, 1e3 * median(bricks), 1e3 * median(cells),
                1e3 * median(join), evaluations / 1e6, evaluations / static_cast<double>(mesh.positions.size()),
                usage.ru_maxrss / 1024, all_evaluations / evaluations, all_seconds / time, median(cone),
                static_cast<double>(cone_triangles) / 1e6);
    std::fflush(stdout);
}

// In a child process, before any thread exists.
void measure_apart(const std::string& name, const std::function<Result<tree::VesselTree>()>& load,
                   const BenchOptions& options) {
    std::fflush(stdout);
    const pid_t child = fork();
    if (child != 0) {
        int status = 0;
        waitpid(child, &status, 0);
        return;
    }
    tbb::task_arena arena(options.threads);
    arena.execute([&] {
        const auto tree = load();
        if (tree)
            measure(name, *tree, options);
        else
            std::fprintf(stderr, "%s\n", tree.error().message().c_str());
    });
    std::fflush(stdout);
    _exit(0);
}

} // namespace

int main(int argc, char** argv) {
    CLI::App app("How fast surfaces are made: medians over --runs, on a grown tree of 1,504 branches and on FILES");
    BenchOptions options;
    std::vector<std::string> files;
    app.add_option("FILES", files, "vessel trees");
    app.add_option("--runs", options.runs, "counted runs after a warm-up")
        ->capture_default_str()
        ->check(CLI::PositiveNumber);
    app.add_option("--threads", options.threads)->capture_default_str()->check(CLI::PositiveNumber);
    app.add_option("--detail", options.detail)->capture_default_str()->check(CLI::PositiveNumber);
    app.add_option("--cell", options.cell_mm, "one cell size everywhere, mm")->check(CLI::PositiveNumber);
    app.add_option("--smooth", options.smooth)->capture_default_str()->check(CLI::NonNegativeNumber);
    CLI11_PARSE(app, argc, argv);

    std::printf("%d threads, %s, detail %d, %d runs\n", options.threads, field::instruction_set(), options.detail,
                options.runs);
    std::printf("%-26s %7s %8s %7s %6s  %4s %4s %4s  %7s %6s %6s %8s %7s  %7s %6s\n", "", "", "million", "", "Mtri",
                "find", "fill", "join", "million", "evals/", "peak", "all segments", "", "cones", "cones");
    std::printf("%-26s %7s %8s %7s %6s  %4s %4s %4s  %7s %6s %6s %8s %7s  %7s %6s\n", "tree", "segm.", "triang.", "s",
                "/s", "ms", "ms", "ms", "evals", "vertex", "MiB", "evals", "time", "s", "Mtri");
    measure_apart("grown, 1504 branches", grown_tree, options);
    for (const std::string& file : files)
        measure_apart(
            std::filesystem::path(file).stem().string(), [&] { return io::read_tree(file); }, options);
    return 0;
}
