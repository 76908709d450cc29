// Sizing: the required cell size at each place. A vessel of radius r requires cells of 2 pi r / detail around itself.
// With the distance from the vessel, cells may grow with a slope so small that neighbouring bricks never differ by more
// than one level. So the octree is balanced without a separate pass, and a brick depends only on nearby vessels.
//
// Proof of balance. For a cube of edge s (a brick: cells of s / 4) with centre c, let g = min over pieces of
// h_i + slope max(0, dist(c, axis_i) - reach_i - sqrt(3)/2 s). A brick is not divided if s / 4 <= g. The centre of a
// cube of edge s / 2 that touches it is at most sqrt(3) 3/4 s away, so g differs by at most slope sqrt(3)/2 s between
// the two. With slope <= 1 / (4 sqrt 3) = 0.1443 the smaller cube has g >= s / 8, so it is not divided either.
#pragma once

#include "core/base/large_array.h"
#include "core/field/field.h"
#include "core/mesh/polygonize/octree/lattice.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace ramus::mesh::bricks {

// A straight stretch of vessel with a nearly constant radius, and so with one required cell size.
struct SizingPiece {
    glm::vec3 start{0.0F}; // relative to the middle of the extent, mm
    glm::vec3 direction{0.0F};
    float length = 0.0F;   // mm
    float cell_mm = 0.0F;  // required cell size within reach_mm of the axis
    float reach_mm = 0.0F; // beyond, cells may grow with kSlope
    std::int32_t branch = 0;
    bool operator==(const SizingPiece&) const = default;
};

struct Sizing {
    static constexpr float kSlope = 0.14F; // below 1 / (4 sqrt 3), see the proof
    // Cell sizes differ by powers of two, and the size nearest to the required one is used. So cells may be larger than
    // required by this factor. Cells around the thinnest vessel have exactly the required size.
    static constexpr double kRounding = 1.4142135623730951;
    LargeArray<SizingPiece> pieces; // empty: one cell size everywhere
    // Conservative stand-ins for groups of nearby pieces: a cube that a group does not reach, none of its pieces
    // reaches. The pieces of group n are the entries of `grouped` from kGroupPieces * n on.
    static constexpr std::size_t kGroupPieces = 16;
    std::vector<SizingPiece> groups;
    LargeArray<std::uint32_t> grouped;
    double cell_per_radius = 0.0; // required cell size over the radius of a vessel; 0: one cell size everywhere
    double finest_cell_mm = 0.0;
    double expected_triangles = 0.0; // a rough forecast, to refuse surfaces that cannot fit into memory
};

// `detail`: cells around a vessel. `cell_mm` > 0: one cell size everywhere instead.
[[nodiscard]] Sizing make_sizing(const field::Field& field, int detail, double cell_mm,
                                 const LargeAllocator<std::byte>& memory = {});

// For each of `pieces` (indices into `all`), one bit per child of a cube: whether the piece requires smaller cells than
// those of the child as a brick.
void active_children(std::span<const SizingPiece> all, std::span<const std::uint32_t> pieces,
                     const field::ChildCubes& cubes, std::span<std::uint8_t> active);

[[nodiscard]] inline std::span<const std::uint32_t> pieces_of_group(const Sizing& sizing, std::uint32_t group) {
    const std::size_t first = Sizing::kGroupPieces * group;
    return std::span(sizing.grouped).subspan(first, std::min(Sizing::kGroupPieces, sizing.grouped.size() - first));
}

// An upper bound of the cell size (mm) wherever the field of a vessel of this radius (mm) reaches.
[[nodiscard]] float most_asked(const Sizing& sizing, float radius);

// Whether a piece may require cells smaller than `most` in a cube, or in a part of it. `middle`: relative to the middle
// of the extent, mm.
[[nodiscard]] bool can_matter(const SizingPiece& piece, glm::vec3 middle, float side, float most);

// The level of the cells that a vessel of this radius requires.
[[nodiscard]] int level_of_radius(const Sizing& sizing, double radius, const Lattice& lattice);

} // namespace ramus::mesh::bricks
