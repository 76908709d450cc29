// First guesses for the vertices of plain cells, those that the surface crosses in one loop: the mean of the crossings
// of the cell's edges. Vectorised over the cells.
#pragma once

#include "core/field/brick_field.h"

#include <cstdint>
#include <span>

namespace ramus::mesh::bricks {

// Half the box around a cell's centre, in cells, that its vertex must stay in. A little beyond the cell: where the mean
// of the crossings lies off a bent surface the nearest point of it may be just outside.
inline constexpr float kVertexReach = 0.62F;
// Guesses keep this far, in edges, from corners: where the surface runs through a corner, the vertices of all cells
// around it would otherwise meet there.
inline constexpr float kCrossingMargin = 0.05F;

// `depths`: at the brick's grid points, as BrickField finds them. `corners`: the grid point at the low corner of each
// cell; the array goes on for at least a vector's width. Adds one point per cell to `points`, relative to the brick's
// corner.
void add_vertex_guesses(const field::GridValues& depths, std::span<const std::uint8_t> corners, float cell_mm,
                        field::Projection& points);

} // namespace ramus::mesh::bricks
