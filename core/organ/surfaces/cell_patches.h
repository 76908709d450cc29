// The pieces of border in a cell: a cube of eight voxel centres. Corner c is at (c & 1, c >> 1 & 1, c >> 2). Edge 4 a +
// b + 2 c runs along axis a, at b and c on the next two axes; it carries a polygon if its two labels differ.
#pragma once

#include <array>
#include <cstdint>

namespace ramus::organ::surfaces {

using Labels = std::array<int, 8>;

[[nodiscard]] constexpr int edge_number(int axis, int b, int c) { return 4 * axis + b + 2 * c; }

// A side of a cell: four corners in a circle, and edge m between corners m and m + 1.
struct CellSide {
    std::array<int, 4> corners, edges;
};
[[nodiscard]] constexpr CellSide cell_side(int axis, int upper) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3, base = upper << axis;
    return {{base, base | 1 << u, base | 1 << u | 1 << v, base | 1 << v},
            {edge_number(u, 0, upper), edge_number(v, upper, 1), edge_number(u, 1, upper), edge_number(v, upper, 0)}};
}

// How the polygons of the four edges of a side are joined: one or two groups, -1: the labels are equal.
struct Joints {
    std::array<int, 4> group{-1, -1, -1, -1};
    int groups = 0;
    [[nodiscard]] int first_of(int which) const { // an edge of a group
        int m = 0;
        while (group[static_cast<std::size_t>(m)] != which) ++m;
        return m;
    }
};
[[nodiscard]] Joints joints_of(const Labels& labels, const CellSide& side);

// The patch of each edge of a cell: polygons that are joined at its sides.
struct Patches {
    std::array<std::int8_t, 12> of_edge; // -1: no polygon
    std::int8_t count = 0;
};
[[nodiscard]] Patches patches_of(const Labels& labels);

} // namespace ramus::organ::surfaces
