#include "core/mesh/polygonize/cells/hanging_corners.h"

#include <array>
#include <utility>

namespace ramus::mesh::bricks {

namespace {

constexpr std::uint32_t direction_bit(const int (&d)[3]) {
    return std::uint32_t{1} << direction_index(d[0], d[1], d[2]);
}

// By direction: the cells of a brick that touch the neighbour.
constexpr std::array<std::uint64_t, kDirections> make_touching_cells() {
    std::array<std::uint64_t, kDirections> touching{};
    for (int d = 0; d < kDirections; ++d) {
        const int direction[3] = {d % 3 - 1, d / 3 % 3 - 1, d / 9 - 1};
        for (int cell = 0; cell < kCellsPerBrick; ++cell) {
            const int c[3] = {cell & 3, cell >> 2 & 3, cell >> 4};
            bool touches = d != kSelf;
            for (int axis = 0; axis < 3; ++axis) {
                if (direction[axis] == -1 && c[axis] != 0) touches = false;
                if (direction[axis] == 1 && c[axis] != kBrickCells - 1) touches = false;
            }
            if (touches) touching[static_cast<std::size_t>(d)] |= std::uint64_t{1} << cell;
        }
    }
    return touching;
}
constexpr std::array<std::uint64_t, kDirections> kTouchingCells = make_touching_cells();

// For every face and edge of every cell, the directions in which a finer neighbour divides it.
struct Splitters {
    std::array<std::uint32_t, 6> faces{};
    std::array<std::uint32_t, 12> edges{};
};
constexpr std::array<Splitters, kCellsPerBrick> make_splitters() {
    std::array<Splitters, kCellsPerBrick> made{};
    for (int cell = 0; cell < kCellsPerBrick; ++cell) {
        const int c[3] = {cell & 3, cell >> 2 & 3, cell >> 4};
        const auto outward = [&](int axis, int side) {
            return side == 0 ? (c[axis] == 0 ? -1 : 0) : (c[axis] == kBrickCells - 1 ? 1 : 0);
        };
        Splitters& entry = made[static_cast<std::size_t>(cell)];
        for (int face = 0; face < 6; ++face) {
            int d[3] = {0, 0, 0};
            d[face / 2] = outward(face / 2, face & 1);
            if (d[face / 2] != 0) entry.faces[static_cast<std::size_t>(face)] = direction_bit(d);
        }
        for (int edge = 0; edge < 12; ++edge) {
            const int u = (edge / 4 + 1) % 3;
            const int v = (edge / 4 + 2) % 3;
            for (int m = 1; m < 4; ++m) {
                int d[3] = {0, 0, 0};
                d[u] = (m & 1) != 0 ? outward(u, edge & 1) : 0;
                d[v] = (m & 2) != 0 ? outward(v, edge >> 1 & 1) : 0;
                if (d[u] != 0 || d[v] != 0) entry.edges[static_cast<std::size_t>(edge)] |= direction_bit(d);
            }
        }
    }
    return made;
}
constexpr std::array<Splitters, kCellsPerBrick> kSplitters = make_splitters();

// The interior of a face or an edge of the brick: its possible hanging corners, and the directions in which a finer
// neighbour makes them hanging corners.
struct Region {
    std::uint32_t directions = 0;
    std::vector<field::LatticePoint> points;
};

const std::vector<Region>& regions() {
    static const std::vector<Region> made = [] {
        std::vector<Region> all;
        for (int d = 0; d < kDirections; ++d) {
            const int direction[3] = {d % 3 - 1, d / 3 % 3 - 1, d / 9 - 1};
            Region region;
            for (int m = 1; m < 8; ++m) {
                const int part[3] = {(m & 1) != 0 ? direction[0] : 0, (m & 2) != 0 ? direction[1] : 0,
                                     (m & 4) != 0 ? direction[2] : 0};
                region.directions |= direction_bit(part) & ~(std::uint32_t{1} << kSelf);
            }
            constexpr int kLast = 2 * kBrickCells; // half cells
            const auto range = [&](int axis) {
                return direction[axis] == 0  ? std::pair(1, kLast - 1)
                       : direction[axis] < 0 ? std::pair(0, 0)
                                             : std::pair(kLast, kLast);
            };
            for (int z = range(2).first; z <= range(2).second; ++z)
                for (int y = range(1).first; y <= range(1).second; ++y)
                    for (int x = range(0).first; x <= range(0).second; ++x)
                        if (((x | y | z) & 1) != 0)
                            region.points.push_back({static_cast<std::uint8_t>(2 * x), static_cast<std::uint8_t>(2 * y),
                                                     static_cast<std::uint8_t>(2 * z)});
            if (d != kSelf && !region.points.empty()) all.push_back(std::move(region));
        }
        return all;
    }();
    return made;
}

} // namespace

void list_hanging_corners(std::uint32_t finer, std::vector<field::LatticePoint>& points) {
    points.clear();
    for (const Region& region : regions())
        if ((region.directions & finer) != 0) points.insert(points.end(), region.points.begin(), region.points.end());
}

std::uint64_t cells_beside_finer(std::uint32_t finer) {
    std::uint64_t cells = 0;
    for (std::size_t d = 0; d < kDirections; ++d) {
        const bool corner = d % 3 != 1 && d / 3 % 3 != 1 && d / 9 != 1;
        if (!corner && (finer >> d & 1) != 0) cells |= kTouchingCells[d];
    }
    return cells;
}

std::uint64_t cells_toward(int direction) { return kTouchingCells[static_cast<std::size_t>(direction)]; }

std::uint64_t cells_touching(int x, int y, int z) {
    const int p[3] = {x, y, z};
    std::uint64_t cells = 0;
    for (int corner = 0; corner < 8; ++corner) {
        int c[3];
        bool valid = true;
        for (int axis = 0; axis < 3; ++axis) {
            c[axis] = (p[axis] - (corner >> axis & 1)) >> 1;
            valid = valid && c[axis] >= 0 && c[axis] < kBrickCells;
        }
        if (valid) cells |= std::uint64_t{1} << cell_index(c[0], c[1], c[2]);
    }
    return cells;
}

CellShape split_shape(int cell, std::uint32_t finer) {
    const Splitters& splitters = kSplitters[static_cast<std::size_t>(cell)];
    CellShape shape;
    for (std::size_t face = 0; face < 6; ++face)
        shape.split_faces |= static_cast<std::uint8_t>(((splitters.faces[face] & finer) != 0 ? 1 : 0) << face);
    for (std::size_t edge = 0; edge < 12; ++edge)
        shape.split_edges |= static_cast<std::uint16_t>(((splitters.edges[edge] & finer) != 0 ? 1 : 0) << edge);
    return shape;
}

} // namespace ramus::mesh::bricks
