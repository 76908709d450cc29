// The convolution surface as a triangle mesh: closed, oriented, edge- and vertex-manifold, with triangles as small as
// the local vessel needs, vertices on the isosurface, normals from the field's gradient, and the dominating branch and
// local radius at each vertex.
//
// The steps, a folder each: octree (which cubes of space the surface may cross, how fine, and the neighbours of each)
// -> cells (samples, circuits, vertices) -> join (triangles). Every step works brick by brick in a fixed order, so the
// result has the same bits for any number of threads. Not promised: that the surface has no loops of its own where
// vessels pass closer than a cell (make_surface() cuts them: loops/cut_false_loops.h), nor that triangles of different
// parts of the surface never intersect there.
#pragma once

#include "core/base/bounds.h"
#include "core/base/error.h"
#include "core/base/job.h"
#include "core/field/field.h"
#include "core/mesh/triangle_mesh.h"

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <vector>

namespace ramus::mesh {

struct PolygonizeOptions {
    int detail = 16;                             // cells around a vessel
    double cell_mm = 0.0;                        // > 0: one cell size everywhere instead
    double memory_bytes = 0.0;                   // refuse what is forecast to take more; 0 = half of the machine's
    std::shared_ptr<ArrayMemory> disk = nullptr; // where large arrays are, the mesh's too; null: in memory
};

// How a surface is made: in memory, on the disk (PolygonizeOptions::disk), or with all that it takes to follow its
// tree (polygonizer.h).
enum class PolygonizeMode { kWhole, kOnDisk, kFollow };

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

} // namespace ramus::mesh
