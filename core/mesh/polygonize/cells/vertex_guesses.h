// First guesses for the vertices of plain cells (cells with exactly one circuit): the mean of the crossings of the
// cell's edges. Vectorised over the cells.
#pragma once

#include "core/field/brick_field.h"

#include <cstdint>
#include <span>

namespace ramus::mesh::bricks {

// In cells: half of the edge of the box around a cell's centre in which its vertex must stay. The box is a little
// larger than the cell, since the point of a curved surface nearest to the mean of the crossings may be just outside.
inline constexpr float kVertexReach = 0.62F;
// In edges: the least distance of crossings from corners. If the surface passes through a corner, the vertices of all
// cells around it would otherwise coincide there.
inline constexpr float kCrossingMargin = 0.05F;

// `depths`: at the brick's grid points, from BrickField::find_depths(). `corners`: the grid point at the low corner of
// each cell; the array must extend a vector's width beyond its end. Adds one point per cell to `points`, relative to
// the brick's corner, mm.
void add_vertex_guesses(const field::GridValues& depths, std::span<const std::uint8_t> corners, float cell_mm,
                        field::Projection& points);

} // namespace ramus::mesh::bricks
