// The steps of polygonizing, into whatever store.
#pragma once

#include "core/mesh/polygonize/polygonize.h"
#include "core/mesh/polygonize/stream/surface_store.h"

namespace ramus::mesh {

// Fails when the surface is not feasible in that mode, when the store is full, or when cancelled.
[[nodiscard]] Result<void> make_surface_in(bricks::SurfaceStore& store, const field::Field& field,
                                           const PolygonizeOptions& options, PolygonizeMode mode, Job& job,
                                           PolygonizeStatistics* statistics);

} // namespace ramus::mesh
