// How long slices take while a person moves through a scan of 512 x 512 x 800 voxels with the outlines of a large
// surface, and pictures along a vessel: medians in milliseconds, each at new positions.
#include "app/assets/centerlines.h"
#include "app/workspace/surface_maker.h"
#include "core/base/bounds.h"
#include "core/base/stopwatch.h"
#include "core/mesh/surface.h"
#include "core/slice/reformation.h"
#include "core/slice/vessel_path.h"
#include "core/slice/walls.h"
#include "render/slice/slice_painter.h"
#include "tests/support/grown_tree.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <functional>
#include <glm/gtc/matrix_transform.hpp>
#include <string>

using namespace ramus;

namespace {

void report(const std::string& what, int runs, const std::function<void(int)>& work) {
    std::vector<double> milliseconds;
    for (int run = 0; run < runs; ++run) {
        const Stopwatch watch;
        work(run);
        milliseconds.push_back(1e3 * watch.seconds());
    }
    std::ranges::sort(milliseconds);
    std::printf("%-52s %8.1f %8.1f %8.1f\n", what.c_str(), milliseconds[milliseconds.size() / 2], milliseconds.front(),
                milliseconds.back());
}

// A scan of noise over the box.
volume::Volume scan_over(const Bounds<glm::dvec3>& box) {
    volume::Volume scan;
    scan.size = {512, 512, 800};
    scan.to_patient = glm::scale(glm::translate(glm::dmat4(1.0), box.least), box.size() / glm::dvec3(scan.size - 1));
    SparseArray<std::int16_t> values;
    values.resize(volume::voxel_count(scan.size));
    std::uint32_t state = 1;
    for (std::size_t n = 0; n < values.size(); ++n) {
        state = state * 1664525U + 1013904223U;
        values[n] = static_cast<std::int16_t>(state >> 21U);
    }
    scan.voxels = std::move(values);
    return scan;
}

void slices(const render::Frame& frame, const std::shared_ptr<const volume::Volume>& scan, int runs) {
    const Bounds<glm::dvec3> box = slice::bounds_of(*scan);
    render::SlicePainter painter;
    for (const auto& [direction, name] : slice::kDirections) {
        const bool oblique = direction == slice::Direction::kOblique;
        const slice::Axes axes = oblique ? slice::axes_across({1.0, 2.0, 3.0}) : slice::axes_of(direction);
        const double mm = std::max({box.size().x, box.size().y, box.size().z}) / 512.0;
        for (const bool vessels : {false, true})
            report(std::string(name) + (vessels ? " with outlines" : ""), runs, [&](int run) {
                const double way = 0.3 + 0.4 * (run + (vessels ? 0.5 : 0.0)) / runs;
                render::SliceView view;
                view.grid = slice::grid_around(axes, box.least + way * box.size(), mm, {512, 512});
                view.scans = {{scan, {1024.0, 2048.0}, 1.0F}};
                view.outlines = view.axes = vessels;
                view.overlays.orientation_cube = false; // as slices of the window
                (void)painter.paint(frame, view);
            });
    }
}

Result<void> along(const tree::VesselTree& tree, const mesh::TriangleMesh& mesh, const volume::Volume& scan, int runs) {
    int deepest = 0;
    double longest = 0.0;
    for (int branch = 0; branch < static_cast<int>(tree.branches.size()); ++branch) {
        RAMUS_TRY(path, slice::path_from_root(tree, branch, 5.0));
        if (path.length_mm() > longest) longest = path.length_mm(), deepest = branch;
    }
    RAMUS_TRY(path, slice::path_from_root(tree, deepest, 0.5));
    const Stopwatch watch;
    const slice::MeshLines lines(mesh);
    std::printf("index of the surface for walls: %.1f\n", 1e3 * watch.seconds());
    report("straightened, " + std::to_string(static_cast<int>(path.length_mm())) + " mm, walls", runs, [&](int run) {
        const auto picture = slice::reformation_along(path, slice::ReformationKind::kStraightened, 7.0 * run, 60.0);
        (void)slice::sampled(scan, picture);
        (void)slice::walls_of(picture, [&](const slice::RowLine& line, std::vector<slice::CutTriangle>& pieces) {
            lines.add_pieces(line, pieces);
        });
    });
    return {};
}

Result<void> time_all(int branches, double detail, int runs) {
    RAMUS_TRY(tree, test::grown_tree(branches));
    mesh::SurfaceOptions options;
    options.detail = detail;
    Job job;
    RAMUS_TRY(surface, mesh::make_surface(tree, options, job));
    std::printf("%zu branches, %zu triangles\n", tree.branches.size(), surface.mesh.triangles.size());
    render::Frame frame;
    frame.mesh = app::paged(surface.mesh, tree);
    frame.centerlines = app::centerlines_of(tree, options).lines;
    Bounds<glm::dvec3> box;
    for (const tree::Point& point : tree.points) box.hold(point.position);
    const auto scan = std::make_shared<const volume::Volume>(scan_over(box));
    std::printf("%-52s %8s %8s %8s\n", "512 x 512 pixels, new positions, ms", "median", "least", "most");
    slices(frame, scan, runs);
    return along(tree, surface.mesh, *scan, runs);
}

} // namespace

int main(int count, char** words) {
    CLI::App app{"How long slices take"};
    int branches = 3000, runs = 31;
    double detail = 16.0;
    app.add_option("--branches", branches);
    app.add_option("--detail", detail);
    app.add_option("--runs", runs)->check(CLI::PositiveNumber);
    CLI11_PARSE(app, count, words);
    if (const auto done = time_all(branches, detail, runs); !done) {
        std::fprintf(stderr, "%s\n", done.error().message().c_str());
        return 1;
    }
    return 0;
}
