#include "core/mesh/polygonize/feasible.h"

#include "core/base/memory.h"
#include "core/base/words.h"
#include "core/mesh/polygonize/octree/octree.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <limits>
#include <string>

namespace ramus::mesh {

namespace {

// Peak memory in bytes: a constant, and an amount for each forecast triangle. The surface may have up to twice as many
// triangles as the forecast. The numbers exceed all measurements on grown and real trees.
struct Needs {
    double first, per_triangle;
};
constexpr Needs kWhole{32e6, 80.0};
constexpr Needs kOnDisk{128e6, 4.0};
constexpr Needs kFollow{32e6, 150.0};

double memory_for(double triangles, PolygonizeMode mode) {
    const Needs& needs = mode == PolygonizeMode::kWhole ? kWhole : mode == PolygonizeMode::kOnDisk ? kOnDisk : kFollow;
    return needs.first + needs.per_triangle * triangles;
}

// As an integer, unless the number is so large that its digits have no meaning.
std::string millions(double count) {
    constexpr double kMostTold = 1e15;
    return count < 1e6 * kMostTold ? std::to_string(std::llround(count / 1e6)) : in_digits(count / 1e6, 3);
}

Result<void> check_resolved(const field::Field& field, const bricks::Sizing& sizing, const PolygonizeOptions& options) {
    const field::Extent& extent = field.extent();
    if (bricks::levels_needed(extent, sizing) > bricks::kMaximumLevels)
        return fail("the thinnest vessel is too thin for the tree's extent", {},
                    "scale or prune the tree, or set --cell");
    // Positions of a surface are in single precision. In cells smaller than its resolution, grid points would coincide.
    constexpr double kLeastSteps = 2.0; // least size of a cell, in steps of single precision
    const glm::dvec3 corner = glm::max(glm::abs(extent.lower), glm::abs(extent.upper));
    const double farthest = std::max({corner.x, corner.y, corner.z});
    if (sizing.finest_cell_mm >= kLeastSteps * farthest * static_cast<double>(std::numeric_limits<float>::epsilon()))
        return {};
    return fail("cells of " + in_digits(sizing.finest_cell_mm, 3) + " mm cannot be told apart " +
                    in_digits(farthest, 3) + " mm from the origin",
                {},
                options.cell_mm > 0.0 ? "raise --cell, or move the tree to the origin"
                                      : "check the radii and the unit, or move the tree to the origin");
}

} // namespace

Result<void> check_segments(const field::Field& field) {
    if (field.skeleton().segments().empty())
        return fail("the tree has no segments", {}, "nothing to make a surface of");
    if (field.skeleton().present().empty()) return fail("every branch is hidden", {}, "nothing to make a surface of");
    return {};
}

Result<void> check_feasible(const field::Field& field, const bricks::Sizing& sizing, const PolygonizeOptions& options,
                            PolygonizeMode mode, double share) {
    const double limit = memory_limit(options.memory_bytes);
    const double triangles = share * sizing.expected_triangles;
    const double needed = memory_for(triangles, mode);
    if (!(needed <= limit)) {
        const char* remedy = options.cell_mm > 0.0 ? "raise --cell or --memory"
                                                   : "lower --detail, prune with --prune, or raise --memory";
        return fail("the surface would have about " + millions(triangles) + " million triangles or more and may take " +
                        megabytes(needed) + " of memory; " + megabytes(limit) + " are left to it",
                    {}, remedy);
    }
    return check_resolved(field, sizing, options);
}

} // namespace ramus::mesh
