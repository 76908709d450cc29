// The convolution surface as a triangle mesh: closed, oriented, edge- and vertex-manifold, with triangles as small as
// the local vessel needs, vertices on the isosurface, normals from the field's gradient, and the dominating branch and
// local radius at each vertex.
//
// The steps, a folder each: octree (which cubes of space the surface may cross, how fine, and what is beside each) ->
// cells (samples, loops, vertices) -> join (triangles). Every step works brick by brick in a fixed order, so the result
// has the same bits for any number of threads. Not promised: that the surface has no loops of its own where vessels
// pass closer than a cell (make_surface() cuts them: loops/cut_false_loops.h), nor that triangles of different sheets
// never intersect there.
#pragma once

#include "core/base/bounds.h"
#include "core/base/error.h"
#include "core/base/job.h"
#include "core/field/field.h"
#include "core/mesh/surface_sink.h"
#include "core/mesh/triangle_mesh.h"

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace ramus::mesh {

struct PolygonizeOptions {
    int detail = 16;           // cells around a vessel
    double cell_mm = 0.0;      // > 0: one cell size everywhere instead
    double memory_bytes = 0.0; // refuse what is forecast to take more; 0 = half of the machine's
};

// How a surface is made: as one mesh, in parts that a sink takes (polygonize_to()), or with all that it takes to
// follow its tree (polygonizer.h).
enum class PolygonizeMode { kWhole, kStream, kFollow };

// Whether a surface can be made in that mode, or would be refused. As rough as the forecast of its triangles.
[[nodiscard]] bool is_feasible(const field::Field& field, const PolygonizeOptions& options, PolygonizeMode mode);

struct PolygonizeStatistics {
    std::uint64_t evaluations = 0; // kernel evaluations, one per segment and point
    std::uint64_t samples = 0;     // points at which the field was taken
    std::uint64_t bricks = 0;
    double bricks_s = 0.0, cells_s = 0.0, join_s = 0.0;
};

// Fails when the options ask for more than memory holds or finer cells than the lattice can count, or when cancelled.
// `walled`: boxes, mm, that hold all walls between vessels, whose sides may meet though neither of them folds.
[[nodiscard]] Result<TriangleMesh> polygonize(const field::Field& field, const PolygonizeOptions& options, Job& job,
                                              PolygonizeStatistics* statistics = nullptr,
                                              std::vector<Bounds<glm::vec3>>* walled = nullptr);

// Polygonizes into a sink, for surfaces that are more than memory holds: of the surface only the subtrees at work are
// kept (subtree_schedule.h), of the octree all of it.
//
// Hands the mesh that polygonize() makes to `sink`, a part for each subtree. Fails when even so it takes more memory
// than the options allow, when it has more vertices than 31 bits count or is finer than the lattice can be, when the
// sink takes no more, when cancelled, or, at the end, if the surface is not closed (core/mesh/edge_balance.h): a model
// that does not keep its promises (core/field/field.h) makes such. `first_vertex`: the sink has that many already, of
// surfaces before this one.
[[nodiscard]] Result<void> polygonize_to(SurfaceSink& sink, const field::Field& field, const PolygonizeOptions& options,
                                         Job& job, PolygonizeStatistics* statistics = nullptr,
                                         std::size_t first_vertex = 0);

} // namespace ramus::mesh
