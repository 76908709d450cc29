// ramus beside what Debian ships for such surfaces: VTK's tubes and flying edges, OpenVDB's level sets. Same trees,
// same cell size (two thirds of the smallest radius, or --cell), same run: the methods take turns, and every turn is a
// process of its own, so that nobody inherits another's memory. In it the surface is made twice: first, when the system
// has to find all memory, which on a virtual machine may cost as much as the work, and again, when the process has it.
//
// Columns: million triangles; seconds (medians) the first time, how many of them fill a grid with values, and again;
// million triangles a second, first and again; peak memory of the first beyond what the process began with, also per
// triangle; volume inside; whether the surface is closed, that is whether every directed edge has its opposite, each
// exactly once; how many times as fast as that method ramus is at one cell size, in triangles a second, first and
// again; and how many times ramus' memory that method takes.
#include "core/field/convolution_field.h"
#include "core/field/kernels/gaussian.h"
#include "core/io/trees/tree_file.h"
#include "core/mesh/polygonize/polygonize.h"
#include "core/mesh/tree_field.h"
#include "peers.h"
#include "tests/support/grown_tree.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <functional>
#include <glm/geometric.hpp>
#include <limits>
#include <malloc.h>
#include <memory>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_sort.h>
#include <oneapi/tbb/task_arena.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

using namespace ramus;

namespace {

using peers::Made;
using peers::PlainMesh;
using peers::Scene;

struct BenchOptions {
    int runs = 3;
    int threads = 2;
    double cell_mm = 0.0;
};

struct Method {
    std::string name;
    std::function<Made(const Scene&)> make;
};

enum class Closed : std::uint8_t { kNo, kYes, kUnknown };

// What a child reports, as plain bytes through a pipe.
struct Turn {
    std::uint64_t triangles = 0;
    double seconds = 0.0, fill_s = 0.0, again_s = 0.0;
    double peak_bytes = 0.0;
    double volume_mm3 = 0.0;
    Closed closed = Closed::kUnknown;
    char refusal[48] = {};
};

constexpr double kMiB = 1048576.0;

double median(std::vector<double> values) {
    std::ranges::sort(values);
    return values[values.size() / 2];
}

Made ramus_surface(const Scene& scene, const mesh::PolygonizeOptions& options) {
    const field::ConvolutionField field(scene.prepared, mesh::SurfaceOptions().width);
    Job job;
    auto polygonized = mesh::polygonize(field, options, job);
    Made made;
    if (!polygonized) {
        made.refusal = polygonized.error().what;
        return made;
    }
    const auto mesh = std::make_shared<const mesh::TriangleMesh>(std::move(*polygonized));
    made.triangles = mesh->triangles.size();
    made.plain = [mesh] {
        return PlainMesh{{mesh->positions.begin(), mesh->positions.end()},
                         {mesh->triangles.begin(), mesh->triangles.end()}};
    };
    return made;
}

std::vector<Method> methods_for(const Scene& scene) {
    mesh::PolygonizeOptions one_size, adaptive;
    one_size.cell_mm = scene.cell_mm;
    adaptive.detail = 16;
    return {
        {"ramus, one cell size", [=](const Scene& s) { return ramus_surface(s, one_size); }}, // first: all refer to it
        {"ramus, detail 16", [=](const Scene& s) { return ramus_surface(s, adaptive); }},
        {"VTK tubes, " + std::to_string(peers::tube_sides(scene)) + " sides", peers::vtk_tubes},
        {"VTK flying edges, dense", peers::vtk_flying_edges},
        {"OpenVDB, union of spheres", peers::openvdb_spheres},
        {"OpenVDB, same field", peers::openvdb_field},
    };
}

Closed closed(const PlainMesh& mesh) {
    // An edge's lower vertex, its upper one, and which way it goes: opposites become neighbours when sorted.
    std::vector<std::uint64_t> edges;
    edges.reserve(3 * mesh.triangles.size());
    for (const glm::uvec3& t : mesh.triangles)
        for (int i = 0; i < 3; ++i) {
            const std::uint64_t from = t[i];
            const std::uint64_t to = t[(i + 1) % 3];
            if (from == to) return Closed::kNo;
            edges.push_back(std::min(from, to) << 32 | std::max(from, to) << 1 | (from < to ? 0U : 1U));
        }
    if (edges.size() % 2 != 0) return Closed::kNo;
    tbb::parallel_sort(edges);
    for (std::size_t n = 0; n < edges.size(); n += 2) {
        const bool paired = (edges[n] & 1) == 0 && edges[n + 1] == edges[n] + 1;
        const bool once = n == 0 || edges[n - 1] >> 1 != edges[n] >> 1;
        if (!paired || !once) return Closed::kNo;
    }
    return Closed::kYes;
}

double volume_mm3(const PlainMesh& mesh) {
    if (mesh.positions.empty()) return 0.0;
    const glm::dvec3 origin(mesh.positions.front()); // far from zero, small differences of large numbers would remain
    double six_fold = 0.0;
    for (const glm::uvec3& t : mesh.triangles) {
        const glm::dvec3 a = glm::dvec3(mesh.positions[t.x]) - origin;
        const glm::dvec3 b = glm::dvec3(mesh.positions[t.y]) - origin;
        const glm::dvec3 c = glm::dvec3(mesh.positions[t.z]) - origin;
        six_fold += glm::dot(a, glm::cross(b, c));
    }
    return six_fold / 6.0;
}

double resident_bytes() {
    double pages = 0.0;
    std::ifstream("/proc/self/statm") >> pages >> pages; // the second number
    return pages * static_cast<double>(sysconf(_SC_PAGE_SIZE));
}

Turn take_turn(const Method& method, const Scene& scene) {
    Turn turn;
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(scene.threads));
    tbb::task_arena arena(scene.threads);
    arena.execute([&] {
        const double before = resident_bytes();
        Made made;
        const auto make = [&] {
            const auto start = std::chrono::steady_clock::now();
            made = method.make(scene);
            return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        };
        turn.seconds = make();
        rusage usage{};
        getrusage(RUSAGE_SELF, &usage);
        turn.peak_bytes = 1024.0 * static_cast<double>(usage.ru_maxrss) - before;
        turn.fill_s = made.fill_s;
        turn.triangles = made.triangles;
        std::snprintf(turn.refusal, sizeof turn.refusal, "%s", made.refusal.c_str());
        if (made.refusal.empty()) {
            made = {}; // its memory is free again
            turn.again_s = make();
        }
        // Beyond, the check would need more memory than the surface.
        constexpr std::uint64_t kMostChecked = 30'000'000;
        if (!made.refusal.empty() || made.triangles > kMostChecked) return;
        const PlainMesh plain = made.plain();
        turn.closed = closed(plain);
        turn.volume_mm3 = volume_mm3(plain);
    });
    return turn;
}

// In a child process; this one never has more than a single thread.
Turn take_turn_apart(const Method& method, const Scene& scene) {
    std::fflush(nullptr);
    Turn turn;
    int ends[2];
    if (pipe(ends) != 0) {
        std::snprintf(turn.refusal, sizeof turn.refusal, "no pipe");
        return turn;
    }
    const pid_t child = fork();
    if (child == 0) {
        close(ends[0]);
        const Turn own = take_turn(method, scene);
        const bool written = write(ends[1], &own, sizeof own) == static_cast<ssize_t>(sizeof own);
        _exit(written ? 0 : 1);
    }
    close(ends[1]);
    Turn received;
    const bool whole = read(ends[0], &received, sizeof received) == static_cast<ssize_t>(sizeof received);
    close(ends[0]);
    int status = 0;
    waitpid(child, &status, 0);
    if (whole) return received;
    std::snprintf(turn.refusal, sizeof turn.refusal, "failed (%s %d)", WIFSIGNALED(status) ? "signal" : "status",
                  WIFSIGNALED(status) ? WTERMSIG(status) : WEXITSTATUS(status));
    return turn;
}

struct Row {
    Turn last;
    std::vector<double> seconds, fill_s, again_s, peak_bytes;

    void add(const Turn& turn) {
        last = turn;
        seconds.push_back(turn.seconds), fill_s.push_back(turn.fill_s), again_s.push_back(turn.again_s);
        peak_bytes.push_back(turn.peak_bytes);
    }
    [[nodiscard]] bool refused() const { return last.refusal[0] != '\0'; }
    [[nodiscard]] double triangles() const { return static_cast<double>(last.triangles); }
    [[nodiscard]] double speed() const { return triangles() / median(seconds); }
    [[nodiscard]] double speed_again() const { return triangles() / median(again_s); }
};

void print_row(const std::string& name, const Row& row, const Row& ramus) {
    if (row.refused()) {
        std::printf("  %-26s %s\n", name.c_str(), row.last.refusal);
        return;
    }
    const double peak = median(row.peak_bytes);
    std::printf("  %-26s %8.3f %8.3f %8.3f %8.3f %7.2f %7.2f %8.1f %7.1f", name.c_str(), row.triangles() / 1e6,
                median(row.seconds), median(row.fill_s), median(row.again_s), row.speed() / 1e6,
                row.speed_again() / 1e6, peak / kMiB, peak / row.triangles());
    if (row.last.closed == Closed::kUnknown)
        std::printf(" %8s %6s", "-", "-"); // too large to be checked
    else
        std::printf(" %8.2f %6s", row.last.volume_mm3 / 1e3, row.last.closed == Closed::kYes ? "yes" : "no");
    if (!ramus.refused())
        std::printf(" %7.2fx %7.2fx %7.2fx", ramus.speed() / row.speed(), ramus.speed_again() / row.speed_again(),
                    peak / median(ramus.peak_bytes));
    std::printf("\n");
}

// Whether there was a tree.
bool compare(const std::string& name, const Result<tree::VesselTree>& tree, const BenchOptions& options) {
    if (!tree) {
        std::fprintf(stderr, "%s\n", tree.error().message().c_str());
        return false;
    }
    Scene scene{mesh::prepare_tree(*tree, {}), options.cell_mm, options.threads};
    if (scene.cell_mm == 0.0) {
        double thinnest = std::numeric_limits<double>::max();
        for (const tree::Branch& branch : scene.prepared.tree.branches)
            for (const std::uint32_t n : branch.points)
                thinnest = std::min(thinnest, scene.prepared.tree.points[n].radius);
        scene.cell_mm = thinnest / 1.5;
    }
    // Free memory that stays with the process would be handed to the children as if it cost nothing.
    malloc_trim(0);

    const std::vector<Method> methods = methods_for(scene);
    std::vector<Row> rows(methods.size());
    for (int run = 0; run < options.runs; ++run)
        for (std::size_t n = 0; n < methods.size(); ++n)
            if (!rows[n].refused()) rows[n].add(take_turn_apart(methods[n], scene));
    std::printf("%s: %zu segments, cells of %.4g mm\n", name.c_str(), scene.prepared.tree.segment_count(),
                scene.cell_mm);
    for (std::size_t n = 0; n < methods.size(); ++n) print_row(methods[n].name, rows[n], rows.front());
    std::fflush(stdout);
    return true;
}

} // namespace

int main(int argc, char** argv) {
    CLI::App app("ramus beside VTK and OpenVDB: medians over --runs, on grown trees and on FILES");
    BenchOptions options;
    std::vector<std::string> files;
    std::vector<int> branches = {151, 1504};
    app.add_option("FILES", files, "vessel trees; before --branches, or after --");
    app.add_option("--runs", options.runs)->capture_default_str()->check(CLI::PositiveNumber);
    app.add_option("--threads", options.threads)->capture_default_str()->check(CLI::PositiveNumber);
    app.add_option("--branches", branches, "sizes of the trees to grow; 0: none")
        ->capture_default_str()
        ->check(CLI::NonNegativeNumber);
    app.add_option("--cell", options.cell_mm, "cell size, mm; two thirds of the smallest radius unless given")
        ->check(CLI::PositiveNumber);
    CLI11_PARSE(app, argc, argv);

    std::printf("%d threads, %s, %d runs\n", options.threads, field::gaussian(5.0).sum->instruction_set, options.runs);
    std::printf("  %-26s %8s %8s %8s %8s %7s %7s %8s %7s %8s %6s %8s %8s %8s\n", "", "million", "first", "of it",
                "again", "Mtri/s", "Mtri/s", "peak", "bytes /", "volume", "", "ramus'", "speed", "memory /");
    std::printf("  %-26s %8s %8s %8s %8s %7s %7s %8s %7s %8s %6s %8s %8s %8s\n", "method", "triang.", "s", "fill, s",
                "s", "first", "again", "MiB", "triang.", "ml", "closed", "first", "again", "ramus'");
    bool all = true;
    for (const int count : branches)
        if (count > 0)
            all &= compare("grown, " + std::to_string(count) + " branches", test::grown_tree(count), options);
    for (const std::string& file : files)
        all &= compare(std::filesystem::path(file).stem().string(), io::read_tree(file), options);
    return all ? 0 : 1;
}
