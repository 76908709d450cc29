// Takes loops of cells, and their vertices, out of a subtree that has just been filled.
#pragma once

#include "core/mesh/polygonize/cells/loop_walk.h"

#include <span>

namespace ramus::mesh::bricks {

// `loops`: of bricks of the subtree. `vertices` ends with the subtree's own.
void leave_out_loops(const Subtree& subtree, std::span<const LoopPlace> loops, ChunkedArray<BrickCells>& cells,
                     SubtreeCells& made, SurfaceVertices& vertices);

} // namespace ramus::mesh::bricks
