// Fills regular grids with a convolution field, in bricks of 4 x 4 x 4 points, for polygonizers that want a grid. Only
// bricks that some segment's support comes near are sampled: the field is exactly zero in all others.
#pragma once

#include "core/field/convolution_field.h"

#include <functional>
#include <glm/vec3.hpp>

namespace ramus::peers {

inline constexpr int kBrickPoints = 4; // along an edge
inline constexpr int kBlockBricks = 2; // along an edge of a block, which is as large as a leaf of OpenVDB

// Points lie at origin + cell_mm * (i, j, k), and whole blocks of bricks are there. The outermost points lie beyond all
// supports.
struct BrickGrid {
    glm::dvec3 origin{0.0}; // mm
    double cell_mm = 0.0;
    glm::ivec3 blocks{0};

    [[nodiscard]] glm::ivec3 bricks() const { return kBlockBricks * blocks; }
    [[nodiscard]] glm::ivec3 points() const { return kBrickPoints * bricks(); }
};

[[nodiscard]] BrickGrid brick_grid(const field::ConvolutionField& field, double cell_mm);

// Calls put(brick, samples) for every brick that may not be zero; the groups of kOwnGroups are filled in. Layers of
// blocks go in parallel; within a layer the bricks of a block come one after the other.
void fill_bricks(const field::ConvolutionField& field, const BrickGrid& grid,
                 const std::function<void(glm::ivec3, const field::GridGroups&)>& put);

} // namespace ramus::peers
