// How small the cells must be, and where. Every vessel asks for cells of 2 pi r / detail around itself, and cells may
// grow with the distance from it at a slope so gentle that neighbouring bricks never differ by more than one level:
// the octree comes out balanced without a pass that balances it, and a brick depends on what is near it alone.
//
// Proof of balance. For a cube of edge s (a brick: cells s / 4) with centre c let g = min over pieces of
// h_i + slope max(0, dist(c, axis_i) - reach_i - sqrt(3)/2 s). A brick stays whole when s / 4 <= g. For a cube of edge
// s / 2 that touches it the centres are at most sqrt(3) 3/4 s apart, so g changes by at most slope sqrt(3)/2 s between
// the two; with slope <= 1 / (4 sqrt 3) = 0.1443 the smaller one has g >= s / 8 and stays whole as well.
#pragma once

#include "core/field/field.h"
#include "core/mesh/polygonize/octree/lattice.h"

#include <algorithm>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace ramus::mesh::bricks {

// A stretch of vessel over which the radius, and so the cell size asked for, changes by little.
struct SizingPiece {
    glm::vec3 start{0.0F}; // relative to the middle of the frame, mm
    glm::vec3 direction{0.0F};
    float length = 0.0F;
    float cell_mm = 0.0F;
    float reach_mm = 0.0F;
    std::int32_t branch = 0; // whose it is
    bool operator==(const SizingPiece&) const = default;
};

struct Sizing {
    static constexpr float kSlope = 0.14F; // below 1 / (4 sqrt 3), see the proof
    // Cell sizes are powers of two apart: the nearest to what is asked for is taken, so up to this much more. Cells
    // around the thinnest vessel are exactly as asked.
    static constexpr double kRounding = 1.4142135623730951;
    std::vector<SizingPiece> pieces; // empty: one cell size everywhere
    // Pieces near each other as one that asks for at least as much as each of them: who it does not reach, none of them
    // does. A group's pieces are those that `grouped` names from kGroupPieces times its index on.
    static constexpr std::size_t kGroupPieces = 16;
    std::vector<SizingPiece> groups;
    std::vector<std::uint32_t> grouped;
    double cell_per_radius = 0.0; // cell size that a vessel asks for, in its radii; 0: one cell size everywhere
    double finest_cell_mm = 0.0;
    double expected_triangles = 0.0; // a rough forecast, for refusing what cannot fit
};

// detail: cells around a vessel; cell_mm > 0 overrides it with one size everywhere.
[[nodiscard]] Sizing make_sizing(const field::Field& field, int detail, double cell_mm);

// Which of `pieces` (of `all`) ask the children of a cube, as bricks, for cells smaller than their own: one bit
// per child for each piece.
void active_children(std::span<const SizingPiece> all, std::span<const std::uint32_t> pieces,
                     const field::ChildCubes& cubes, std::span<std::uint8_t> active);

[[nodiscard]] inline std::span<const std::uint32_t> pieces_of_group(const Sizing& sizing, std::uint32_t group) {
    const std::size_t first = Sizing::kGroupPieces * group;
    return std::span(sizing.grouped).subspan(first, std::min(Sizing::kGroupPieces, sizing.grouped.size() - first));
}

// Wherever a vessel of this radius reaches, cells are at most so large.
[[nodiscard]] float most_asked(const Sizing& sizing, float radius);

// Whether a piece may make cells of a cube, or of a part of it, smaller than `most`. `middle` relative to the middle of
// the frame, mm.
[[nodiscard]] bool can_matter(const SizingPiece& piece, glm::vec3 middle, float side, float most);

// The level of the cells that a vessel of this radius asks for.
[[nodiscard]] int level_of_radius(const Sizing& sizing, double radius, const Lattice& lattice);

} // namespace ramus::mesh::bricks
