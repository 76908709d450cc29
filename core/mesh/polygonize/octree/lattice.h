// Lattice: the integer grid of all bricks. Its unit is a quarter of the finest cell. So corners, hanging corners and
// centres of faces between cells of different size are integer points, and a point has the same position (in doubles),
// whichever brick computes it.
//
// A brick of level l is a cube of 4 x 4 x 4 cells; a cell of level l has an edge of 4 << l units.
#pragma once

#include <glm/vec3.hpp>

namespace ramus::mesh::bricks {

inline constexpr int kBrickCells = 4;

struct Lattice {
    glm::dvec3 origin{0.0};
    double unit_mm = 0.0;

    [[nodiscard]] glm::dvec3 position(glm::ivec3 n) const { return origin + glm::dvec3(n) * unit_mm; }
    [[nodiscard]] double cell_mm(int level) const { return unit_mm * static_cast<double>(4LL << level); }
};

inline constexpr int cell_units(int level) { return 4 << level; }
inline constexpr int brick_units(int level) { return 16 << level; }

} // namespace ramus::mesh::bricks
