// Removes circuits of cells, and their vertices, from a subtree that has just been filled.
#pragma once

#include "core/mesh/polygonize/cells/circuit_walk.h"

#include <span>

namespace ramus::mesh::bricks {

// `circuits` must be in bricks of the subtree. The vertices of the subtree must be the last ones of `vertices`.
void leave_out_circuits(const Subtree& subtree, std::span<const CircuitPlace> circuits, ChunkedArray<BrickCells>& cells,
                        SubtreeCells& made, SurfaceVertices& vertices);

} // namespace ramus::mesh::bricks
