// First guesses for the vertices of plain cells, those that the surface crosses in one loop: the mean of the crossings
// of the cell's edges. Vectorised over the cells.
#pragma once

#include "core/field/projection.h"

#include <cstdint>
#include <span>

namespace ramus::mesh::bricks {

// Half the box around a cell's centre, in cells, that its vertex must stay in. A little beyond the cell: where the mean
// of the crossings lies off a bent surface the nearest point of it may be just outside.
inline constexpr float kVertexReach = 0.62F;
// Guesses keep this far, in edges, from corners: where the surface runs through a corner, the vertices of all cells
// around it would otherwise meet there.
inline constexpr float kCrossingMargin = 0.05F;

// Grid points of a brick, padded to whole vectors.
inline constexpr std::size_t kGridStride = 128;

// `values`: the field at the brick's grid points, x + 5 y + 25 z. `corners`: the grid point at the low corner of each
// cell; the array goes on for at least a vector's width. Adds one point per cell to `points`, relative to the brick's
// corner.
void add_vertex_guesses(std::span<const float, kGridStride> values, float isovalue,
                        std::span<const std::uint8_t> corners, float cell_mm, field::Projection& points);

} // namespace ramus::mesh::bricks
