// How small the cells must be, and where. Every vessel asks for cells of 2 pi r / detail around itself, and cells may
// grow with the distance from it at a slope so gentle that neighbouring bricks never differ by more than one level:
// the octree comes out balanced without a pass that balances it, and a brick depends on what is near it alone.
//
// Proof of balance. For a cube of edge s (a brick: cells s / 4) with centre c let g = min over pieces of
// h_i + slope max(0, dist(c, axis_i) - reach_i - sqrt(3)/2 s). A brick stays whole when s / 4 <= g. For a cube of edge
// s / 2 that touches it the centres are at most sqrt(3) 3/4 s apart, so g changes by at most slope sqrt(3)/2 s between
// the two; with slope <= 1 / (4 sqrt 3) = 0.1443 the smaller one has g >= s / 8 and stays whole as well.
#pragma once

#include "core/field/convolution_field.h"
#include "core/mesh/polygonize/octree/lattice.h"

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace ramus::mesh::bricks {

// A stretch of vessel over which the radius, and so the wanted cell size, changes by little.
struct SizingPiece {
    glm::vec3 start{0.0F}; // relative to the culling origin, mm
    glm::vec3 direction{0.0F};
    float length = 0.0F;
    float cell_mm = 0.0F;
    float reach_mm = 0.0F;
};

struct Sizing {
    static constexpr float kSlope = 0.14F; // below 1 / (4 sqrt 3), see the proof
    std::vector<SizingPiece> pieces;       // empty: one cell size everywhere
    double finest_cell_mm = 0.0;
    double expected_triangles = 0.0; // a rough forecast, for refusing what cannot fit
};

// detail: cells around a vessel; cell_mm > 0 overrides it with one size everywhere. `origin`: what pieces are relative
// to.
[[nodiscard]] Sizing make_sizing(const field::ConvolutionField& field, glm::dvec3 origin, int detail, double cell_mm);

// Which of `pieces` ask the children of the cube at `middle` (mm, relative to the culling origin), bricks with edge
// `child_side`, for cells smaller than their own: one bit per child for each piece, children numbered as in
// field/culling.h.
void active_children(const Sizing& sizing, std::span<const std::uint32_t> pieces, glm::vec3 middle, float child_side,
                     std::span<std::uint8_t> active);

// The level of the smallest cells that any of `pieces` asks for.
[[nodiscard]] int finest_level(const Sizing& sizing, std::span<const std::uint32_t> pieces, const Lattice& lattice);

} // namespace ramus::mesh::bricks
