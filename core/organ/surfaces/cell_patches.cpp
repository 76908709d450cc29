#include "core/organ/surfaces/cell_patches.h"

#include "core/organ/label_surfaces.h"

#include <algorithm>

namespace ramus::organ::surfaces {

Joints joints_of(const Labels& labels, const CellSide& side) {
    std::array<int, 4> at{};
    for (std::size_t m = 0; m < 4; ++m) at[m] = labels[static_cast<std::size_t>(side.corners[m])];
    Joints joints;
    int polygons = 0;
    for (std::size_t m = 0; m < 4; ++m)
        if (at[m] != at[(m + 1) % 4]) joints.group[m] = 0, ++polygons;
    if (polygons == 0) return joints;
    joints.groups = 1;
    const bool even = at[0] == at[2], odd = at[1] == at[3];
    if (polygons < 4 || (!even && !odd)) return joints;
    joints.groups = 2;
    // Of two labels that touch crosswise the lower one of the organ is connected.
    const bool even_wins = at[1] == kOutside || (at[0] != kOutside && at[0] < at[1]);
    if (even && (!odd || even_wins))
        joints.group = {0, 0, 1, 1}; // around corners 1 and 3
    else
        joints.group = {0, 1, 1, 0}; // around corners 0 and 2
    return joints;
}

Patches patches_of(const Labels& labels) {
    static constexpr std::array<CellSide, 6> kSides{cell_side(0, 0), cell_side(0, 1), cell_side(1, 0),
                                                    cell_side(1, 1), cell_side(2, 0), cell_side(2, 1)};
    std::array<std::int8_t, 12> stands{}; // the lowest edge that an edge is joined with, -1: no polygon
    stands.fill(-1);
    for (const CellSide& side : kSides) {
        const Joints joints = joints_of(labels, side);
        for (int group = 0; group < joints.groups; ++group) {
            std::int8_t first = -1;
            for (std::size_t m = 0; m < 4; ++m) {
                if (joints.group[m] != group) continue;
                const auto edge = static_cast<std::size_t>(side.edges[m]);
                if (stands[edge] < 0) stands[edge] = static_cast<std::int8_t>(edge);
                if (first < 0) first = stands[edge];
                const std::int8_t low = std::min(first, stands[edge]), high = std::max(first, stands[edge]);
                for (std::int8_t& one : stands)
                    if (one == high) one = low;
                first = low;
            }
        }
    }
    Patches patches{stands, 0};
    std::array<std::int8_t, 12> numbers{};
    for (std::size_t edge = 0; edge < 12; ++edge) {
        if (stands[edge] < 0) continue;
        if (stands[edge] == static_cast<std::int8_t>(edge)) numbers[edge] = patches.count++;
        patches.of_edge[edge] = numbers[static_cast<std::size_t>(stands[edge])];
    }
    return patches;
}

} // namespace ramus::organ::surfaces
