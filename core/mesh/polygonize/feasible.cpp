#include "core/mesh/polygonize/feasible.h"

#include "core/base/memory.h"
#include "core/mesh/polygonize/octree/octree.h"

#include <cmath>
#include <string>

namespace ramus::mesh {

namespace {

// Bytes at the peak, to begin with and for every triangle that is forecast, of which there are up to twice as many in
// the end: above all that was measured on grown and on real trees.
struct Needs {
    double first, per_triangle;
};
constexpr Needs kWhole{32e6, 80.0};
constexpr Needs kStream{64e6, 16.0};
constexpr Needs kFollow{32e6, 150.0};

double memory_for(const bricks::Sizing& sizing, PolygonizeMode mode) {
    const Needs& needs = mode == PolygonizeMode::kWhole ? kWhole : mode == PolygonizeMode::kStream ? kStream : kFollow;
    return needs.first + needs.per_triangle * sizing.expected_triangles;
}

} // namespace

Result<void> check_feasible(const field::Field& field, const bricks::Sizing& sizing, const PolygonizeOptions& options,
                            PolygonizeMode mode) {
    const double limit = memory_limit(options.memory_bytes);
    const double needed = memory_for(sizing, mode);
    if (!(needed <= limit)) {
        const char* remedy = options.cell_mm > 0.0 ? "raise --cell or --memory"
                                                   : "lower --detail, prune with --prune, or raise --memory";
        return fail("the surface would have about " + std::to_string(std::llround(sizing.expected_triangles / 1e6)) +
                        " million triangles or more and may take " + megabytes(needed) + " of memory; " +
                        megabytes(limit) + " are left to it",
                    {}, remedy);
    }
    if (bricks::levels_needed(field.frame(), sizing) > bricks::kMaximumLevels)
        return fail("the thinnest vessel is too thin for the tree's extent", {},
                    "scale or prune the tree, or set --cell");
    return {};
}

bool is_feasible(const field::Field& field, const PolygonizeOptions& options, PolygonizeMode mode) {
    const bricks::Sizing sizing = bricks::make_sizing(field, options.detail, options.cell_mm);
    return check_feasible(field, sizing, options, mode).has_value();
}

} // namespace ramus::mesh
