// Polygonizes into a sink, for surfaces that are more than memory holds: of the surface only the subtrees at work are
// kept (subtree_schedule.h), of the octree all of it.
#pragma once

#include "core/mesh/polygonize/polygonize.h"
#include "core/mesh/surface_sink.h"

namespace ramus::mesh {

// Hands the mesh that polygonize() makes to `sink`, a part for each subtree. Fails when even so it takes more memory
// than the options allow, when it has more vertices than 31 bits count or is finer than the lattice can be, when the
// sink takes no more, or when cancelled.
[[nodiscard]] Result<void> polygonize_to(SurfaceSink& sink, const field::Field& field, const PolygonizeOptions& options,
                                         Job& job, PolygonizeStatistics* statistics = nullptr);

} // namespace ramus::mesh
