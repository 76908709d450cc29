// The surface of a tree as a page has it: divided by branch, simplified to what an eye can tell, packed, and no larger
// than asked for.
#pragma once

#include "app/reports/page/packed_mesh.h"
#include "core/base/error.h"
#include "core/base/job.h"
#include "core/tree/dependency.h"

#include <cstddef>

namespace ramus::app {

struct PageSurfaceChoice {
    std::size_t most_bytes = 0; // of the packed surface, as base64
    double most_step_mm = 0.02; // of the grid
};

struct PageSurface {
    PackedMesh packed;
    std::size_t triangles_before = 0; // of the surface
    // From the vertices of the surface to the triangles of their branch that the page has: measured.
    double largest_deviation_mm = 0.0, percentile_95_mm = 0.0;
    bool for_size = false; // simplified more than is usual, to be no larger than most_bytes
};

// Fails if the surface would be larger than most_bytes, or a branch would have no triangle left, or when cancelled.
[[nodiscard]] Result<PageSurface> page_surface(const mesh::TriangleMesh& mesh, const tree::Dependency& dependency,
                                               const PageSurfaceChoice& choice, const JobRange& job);

// A surface next to the tree. Its detail follows its size.
[[nodiscard]] PackedMesh page_mesh(const mesh::TriangleMesh& mesh);

} // namespace ramus::app
