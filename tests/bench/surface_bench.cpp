// How fast the surface is made, and how much work that is: the convolution surface at --detail (radius-adaptive,
// closed, welded, with normals, radii and branches) or at one --cell size, and the truncated cones, on grown trees of
// --branches and on the trees named on the command line. Every tree runs in a process of its own, so that peak memory
// is its own.
//
// Columns: the median over the runs of seconds and million triangles a second, then its best run and the median of one
// thread; the three steps; kernel evaluations per vertex; peak memory of the process, and what of it is beyond the mesh
// itself, in bytes a triangle; how many times the evaluations, and the time, would grow if every sample summed over all
// segments with the same kernel (measured on a seeded subset of samples and scaled up); and the seconds that all of
// `ramus mesh` takes between reading and writing: vessels kept apart, loops cut, triangles untangled, and the same with
// the plain sum.
#include "core/field/convolution_field.h"
#include "core/field/kernels/gaussian.h"
#include "core/io/trees/tree_file.h"
#include "core/mesh/cones.h"
#include "core/mesh/polygonize/polygonize.h"
#include "core/mesh/surface.h"
#include "core/mesh/tree_field.h"
#include "tests/support/grown_tree.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <functional>
#include <numeric>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>
#include <random>
#include <sys/resource.h>
#include <sys/wait.h>
#include <tuple>
#include <unistd.h>
#include <utility>

using namespace ramus;

namespace {

struct BenchOptions {
    int runs = 7;
    int threads = 2;
    int detail = 16;
    double cell_mm = 0.0;
    bool finest_cell = false; // one cell size: smallest radius / 1.5
    int smooth = 1;
    bool compare = true; // with all segments, with one thread, with cones
    std::string table;   // file to append to; empty: none
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

// Seconds to sum all segments at every one of `samples` points, in parallel, scaled up from a subset of them.
double all_segments_seconds(const field::ConvolutionField& field, const mesh::TriangleMesh& mesh,
                            std::uint64_t samples) {
    std::vector<std::uint32_t> all(field.segments().size());
    std::iota(all.begin(), all.end(), 0U);
    std::mt19937 random(1);
    const std::size_t bricks = std::clamp<std::size_t>(4'000'000'000 / (all.size() * field::kGridPoints), 32, 4096);
    std::vector<glm::dvec3> corners(bricks);
    for (auto& corner : corners) corner = glm::dvec3(mesh.positions[random() % mesh.positions.size()]);
    const double seconds = seconds_of([&] {
        tbb::parallel_for(std::size_t{0}, bricks, [&](std::size_t n) {
            field::GridAxes axes;
            for (std::size_t i = 0; i < field::kGridSide; ++i) {
                const double step = 0.1 * static_cast<double>(i);
                axes.x[i] = corners[n].x + step, axes.y[i] = corners[n].y + step, axes.z[i] = corners[n].z + step;
            }
            const auto sum = field.in_brick(field::Choice::kAllSegments);
            thread_local field::GridGroups values;
            sum->enter(all, axes);
            sum->sample_groups(0xFF, values);
        });
    });
    return seconds * static_cast<double>(samples) / static_cast<double>(bricks * field::kGridPoints);
}

struct Timing {
    std::vector<double> total, bricks, cells, join;
    mesh::PolygonizeStatistics statistics;
    mesh::TriangleMesh mesh;
};

Timing time_runs(const field::ConvolutionField& field, const mesh::PolygonizeOptions& options, int runs, int threads) {
    Timing timing;
    tbb::task_arena arena(threads);
    Job job;
    for (int run = 0; run <= runs; ++run) {
        timing.mesh = {};
        const double seconds = seconds_of([&] {
            arena.execute([&] {
                auto made = mesh::polygonize(field, options, job, &timing.statistics);
                if (made) timing.mesh = std::move(*made);
            });
        });
        if (run == 0 && runs > 1) continue; // warms the caches
        timing.total.push_back(seconds);
        timing.bricks.push_back(timing.statistics.bricks_s);
        timing.cells.push_back(timing.statistics.cells_s);
        timing.join.push_back(timing.statistics.join_s);
        if (runs == 1) break;
    }
    return timing;
}

// What one tree came to. Times are medians over the runs, in seconds; zero where they were not asked for.
struct Row {
    std::string name;
    double segments = 0, triangles = 0, vertices = 0, evaluations = 0;
    double time = 0, best = 0, alone = 0; // with all threads, its best run, and with one thread
    double bricks = 0, cells = 0, join = 0;
    double peak_bytes = 0;
    double all_evaluations = 0, all_seconds = 0; // had every sample summed over all segments
    double cones = 0;
    double whole = 0, whole_plain = 0; // from the tree to all of the surface, vessels kept apart or not

    // Of the whole process, what is beyond the mesh.
    [[nodiscard]] double beyond() const { return peak_bytes - 12.0 * triangles - 32.0 * vertices; }
};

void print(const Row& row, bool compare) {
    std::printf("%-22s %7.0f %8.3f %7.3f %6.2f %6.2f ", row.name.c_str(), row.segments, row.triangles / 1e6, row.time,
                row.triangles / row.time / 1e6, row.triangles / row.best / 1e6);
    if (compare)
        std::printf("%6.2f", row.triangles / row.alone / 1e6);
    else
        std::printf("%6s", "");
    std::printf(" %4.0f %4.0f %4.0f  %7.1f %6.1f  %6.0f %5.1f ", 1e3 * row.bricks, 1e3 * row.cells, 1e3 * row.join,
                row.evaluations / 1e6, row.evaluations / row.vertices, row.peak_bytes / (1 << 20),
                row.beyond() / row.triangles);
    if (compare)
        std::printf(" %6.0fx %6.0fx  %7.4f %7.4f %7.4f", row.all_evaluations / row.evaluations,
                    row.all_seconds / row.time, row.cones, row.whole, row.whole_plain);
    std::printf("\n");
}

// For scripts: a line of numbers as they are, below one of names.
void append(const std::string& file, const Row& row, const BenchOptions& options) {
    const bool fresh = !std::filesystem::exists(file);
    std::ofstream out(file, std::ios::app);
    if (fresh)
        out << "name\tdetail\tone_cell\tthreads\tsegments\ttriangles\tvertices\tevaluations\tseconds\tbest\tone_thread"
               "\tbricks\tcells\tjoin\tpeak_bytes\tbeyond_mesh\tall_evaluations\tall_seconds\tcones"
               "\twhole\twhole_plain\n";
    out << row.name << '\t' << options.detail << '\t' << (options.finest_cell || options.cell_mm > 0.0) << '\t'
        << options.threads;
    for (const double number : {row.segments, row.triangles, row.vertices, row.evaluations, row.time, row.best,
                                row.alone, row.bricks, row.cells, row.join, row.peak_bytes, row.beyond(),
                                row.all_evaluations, row.all_seconds, row.cones, row.whole, row.whole_plain})
        out << '\t' << number;
    out << '\n';
}

// Seconds from the tree to its whole surface, in pairs of runs: vessels kept apart, and the plain sum.
std::pair<double, double> whole_seconds(const tree::VesselTree& tree, mesh::SurfaceOptions options,
                                        const BenchOptions& bench) {
    options.detail = bench.detail;
    tbb::task_arena arena(bench.threads);
    std::vector<double> apart, plain;
    Job job;
    for (int run = 0; run < bench.runs; ++run)
        for (const mesh::Blend blend : {mesh::Blend::kTree, mesh::Blend::kPaper}) {
            options.blend = blend;
            const double seconds =
                seconds_of([&] { arena.execute([&] { (void)mesh::make_untangled_surface(tree, options, job); }); });
            (blend == mesh::Blend::kTree ? apart : plain).push_back(seconds);
        }
    return {median(apart), median(plain)};
}

void measure(const std::string& name, const tree::VesselTree& tree, const BenchOptions& options) {
    mesh::SurfaceOptions surface_options;
    surface_options.smooth_passes = options.smooth;
    const tree::PreparedTree prepared = mesh::prepare_tree(tree, surface_options);
    const field::ConvolutionField field(prepared, surface_options.width);
    mesh::PolygonizeOptions polygonize_options;
    polygonize_options.detail = options.detail;
    polygonize_options.cell_mm = options.finest_cell ? field.extent().thinnest / 1.5 : options.cell_mm;
    const Timing timing = time_runs(field, polygonize_options, options.runs, options.threads);
    if (timing.mesh.triangles.empty()) {
        std::printf("%-22s could not be meshed\n", name.c_str());
        return;
    }
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    Row row;
    row.name = name;
    row.segments = static_cast<double>(field.present().size());
    row.triangles = static_cast<double>(timing.mesh.triangles.size());
    row.vertices = static_cast<double>(timing.mesh.positions.size());
    row.evaluations = static_cast<double>(timing.statistics.evaluations);
    row.time = median(timing.total);
    row.best = *std::ranges::min_element(timing.total);
    row.bricks = median(timing.bricks);
    row.cells = median(timing.cells);
    row.join = median(timing.join);
    row.peak_bytes = 1024.0 * static_cast<double>(usage.ru_maxrss);
    if (options.compare) {
        row.alone = median(time_runs(field, polygonize_options, options.runs, 1).total);
        row.all_evaluations = static_cast<double>(timing.statistics.samples) * row.segments;
        row.all_seconds = all_segments_seconds(field, timing.mesh, timing.statistics.samples);
        std::vector<double> cones;
        Job job;
        for (int run = 0; run <= options.runs; ++run) {
            const double seconds = seconds_of([&] { (void)mesh::cones(prepared, options.detail, job); });
            if (run > 0) cones.push_back(seconds);
        }
        row.cones = median(cones);
        if (!options.finest_cell && !(options.cell_mm > 0.0))
            std::tie(row.whole, row.whole_plain) = whole_seconds(tree, surface_options, options);
    }
    print(row, options.compare);
    if (!options.table.empty()) append(options.table, row, options);
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
    const auto tree = load();
    if (tree)
        measure(name, *tree, options);
    else
        std::fprintf(stderr, "%s\n", tree.error().message().c_str());
    std::fflush(stdout);
    _exit(0);
}

} // namespace

int main(int argc, char** argv) {
    CLI::App app("How fast surfaces are made: medians over --runs, on grown trees and on FILES");
    BenchOptions options;
    std::vector<std::string> files;
    std::vector<int> branches{1504};
    bool quick = false;
    app.add_option("FILES", files, "vessel trees");
    app.add_option("--branches", branches, "sizes of the grown trees; 0 for none")->capture_default_str();
    app.add_option("--runs", options.runs, "counted runs after a warm-up; 1: without one")
        ->capture_default_str()
        ->check(CLI::PositiveNumber);
    app.add_option("--threads", options.threads)->capture_default_str()->check(CLI::PositiveNumber);
    app.add_option("--detail", options.detail)->capture_default_str()->check(CLI::PositiveNumber);
    app.add_option("--cell", options.cell_mm, "one cell size everywhere, mm")->check(CLI::PositiveNumber);
    app.add_flag("--finest-cell", options.finest_cell, "one cell size everywhere: the smallest radius / 1.5");
    app.add_option("--smooth", options.smooth)->capture_default_str()->check(CLI::NonNegativeNumber);
    app.add_flag("--quick", quick, "Without comparing with one thread, all segments and cones");
    app.add_option("--table", options.table, "file of tab-separated values to append to");
    CLI11_PARSE(app, argc, argv);
    options.compare = !quick;

    std::printf("%d threads, %s, detail %d, %d runs\n", options.threads, field::gaussian(5.0).sum->instruction_set,
                options.detail, options.runs);
    std::printf("%-22s %7s %8s %7s %6s %6s %6s  %4s %4s %4s  %7s %6s  %6s %5s  %6s %6s   %7s %7s %7s\n", "", "",
                "million", "", "Mtri", "best", "one", "find", "fill", "join", "million", "evals/", "peak", "B/tri",
                "all segm", "ents", "cones", "whole", "plain");
    std::printf("%-22s %7s %8s %7s %6s %6s %6s  %4s %4s %4s  %7s %6s  %6s %5s  %6s %6s   %7s %7s %7s\n", "tree",
                "segm.", "triang.", "s", "/s", "", "thread", "ms", "ms", "ms", "evals", "vertex", "MiB", "more",
                "evals", "time", "s", "s", "s");
    for (const int count : branches)
        if (count > 0)
            measure_apart(
                "grown, " + std::to_string(count), [&] { return test::grown_tree(count); }, options);
    for (const std::string& file : files)
        measure_apart(
            std::filesystem::path(file).stem().string(), [&] { return io::read_tree(file); }, options);
    return 0;
}
