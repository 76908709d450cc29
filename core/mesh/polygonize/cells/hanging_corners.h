// Hanging corners: the points inside a brick's faces and edges at which the finer cells of a neighbour have corners.
// Points are counted in half cells of the brick, 0 .. 8 along every axis.
#pragma once

#include "core/field/brick_field.h"
#include "core/mesh/polygonize/cells/brick_cells.h"

#include <cstdint>
#include <vector>

namespace ramus::mesh::bricks {

// The hanging corners of a brick, in quarter cells, when its neighbours in the directions `finer` (one bit each) are.
void list_hanging_corners(std::uint32_t finer, std::vector<field::LatticePoint>& points);

// Cells of the brick (one bit each) on a face or an edge beyond which cells are finer; at a corner alone nothing hangs.
[[nodiscard]] std::uint64_t cells_beside_finer(std::uint32_t finer);

// Cells of the brick that touch the neighbour in a direction.
[[nodiscard]] std::uint64_t cells_toward(int direction);

// Cells that touch the point.
[[nodiscard]] std::uint64_t cells_touching(int x, int y, int z);

// Which faces and edges of a cell are split. Fills in all of the shape but the signs.
[[nodiscard]] CellShape split_shape(int cell, std::uint32_t finer);

} // namespace ramus::mesh::bricks
