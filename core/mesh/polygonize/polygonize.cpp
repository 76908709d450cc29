#include "core/mesh/polygonize/polygonize.h"

#include "core/mesh/polygonize/join/join_triangles.h"

#include <chrono>
#include <cmath>
#include <unistd.h>
#include <utility>

namespace ramus::mesh {

namespace {

// Peak bytes per triangle of all steps together, measured on real trees.
constexpr double kBytesPerTriangle = 120.0;

double default_triangle_limit() {
    const double memory = static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGE_SIZE));
    return 0.5 * memory / kBytesPerTriangle;
}

double seconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

} // namespace

Result<TriangleMesh> polygonize(const field::ConvolutionField& field, const PolygonizeOptions& options, Job& job,
                                PolygonizeStatistics* statistics) {
    if (field.segments().empty()) return fail("the tree has no segments", {}, "nothing to make a surface of");
    const field::CullingSegments culling(field);
    const bricks::Sizing sizing = bricks::make_sizing(field, culling.origin, options.detail, options.cell_mm);
    const double limit = options.max_triangles > 0.0 ? options.max_triangles : default_triangle_limit();
    const char* remedy = options.cell_mm > 0.0 ? "raise --cell" : "lower --detail, or prune with --prune";
    if (!(sizing.expected_triangles <= limit))
        return fail("the surface would have about " + std::to_string(std::llround(sizing.expected_triangles / 1e6)) +
                        " million triangles, more than memory holds",
                    {}, remedy);
    if (bricks::levels_needed(field, sizing) > bricks::kMaximumLevels)
        return fail("the thinnest vessel is too thin for the tree's extent", {},
                    "scale or prune the tree, or set --cell");

    PolygonizeStatistics figures;
    auto start = std::chrono::steady_clock::now();
    const bricks::Octree octree = bricks::build_octree(field, culling, sizing, job);
    auto neighbours = bricks::find_neighbours(octree);
    figures.bricks_s = seconds_since(start);
    figures.bricks = octree.bricks.size();
    job.report(0.15F);

    start = std::chrono::steady_clock::now();
    bricks::SurfaceCells cells = bricks::fill_bricks(field, octree, std::move(neighbours), job);
    for (const auto& tile : cells.tiles) figures.evaluations += tile.evaluations, figures.samples += tile.samples;
    figures.cells_s = seconds_since(start);

    start = std::chrono::steady_clock::now();
    TriangleMesh mesh;
    if (!job.cancelled()) mesh = bricks::join_triangles(field, octree, std::move(cells), job);
    figures.join_s = seconds_since(start);
    if (job.cancelled()) return fail("cancelled");
    job.report(1.0F);
    if (statistics != nullptr) *statistics = figures;
    return mesh;
}

} // namespace ramus::mesh
