// Hanging corners: points on the faces and edges of a brick's cells at which finer cells of a neighbour have corners.
// Coordinates are in half cells of the brick, 0 to 8 along every axis.
#pragma once

#include "core/field/brick_field.h"
#include "core/mesh/polygonize/cells/brick_cells.h"

#include <cstdint>
#include <vector>

namespace ramus::mesh::bricks {

// Lists the hanging corners of a brick, in quarter cells. `finer`: the directions of finer neighbours, one bit each.
void list_hanging_corners(std::uint32_t finer, std::vector<field::LatticePoint>& points);

// One bit per cell: whether it has a face or an edge with finer cells beyond. A corner alone has no hanging corners.
[[nodiscard]] std::uint64_t cells_beside_finer(std::uint32_t finer);

// One bit per cell: whether it touches the neighbour in a direction.
[[nodiscard]] std::uint64_t cells_toward(int direction);

// One bit per cell: whether it touches a point.
[[nodiscard]] std::uint64_t cells_touching(int x, int y, int z);

// The divided faces and edges of a cell. Fills in the shape except for the signs.
[[nodiscard]] CellShape split_shape(int cell, std::uint32_t finer);

} // namespace ramus::mesh::bricks
