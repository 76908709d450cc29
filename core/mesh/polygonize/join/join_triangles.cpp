#include "core/mesh/polygonize/join/join_triangles.h"

#include <algorithm>
#include <atomic>
#include <oneapi/tbb/parallel_for.h>

namespace ramus::mesh::bricks {

namespace {

// The quads of one brick whose cells are all of one size and have one vertex each, which most are. Of the cells it sees
// its own, places 0 .. 3 along every axis, and those just beyond its upper sides, place 4, at x + 5 y + 25 z.
class BrickJoiner {
public:
    BrickJoiner(const field::ConvolutionField& field, const Octree& octree, const SurfaceCells& surface,
                const VertexSpan& vertices)
        : surface_(surface), general_(field, octree, surface, vertices) {}

    void join(std::uint32_t index, JoinedTile& out) {
        const BrickCells& cells = surface_.cells[index];
        if (!cells.crossed) return;
        const Neighbourhood& around = surface_.neighbours[index];
        special_ = records_of(cells);
        seen_[0] = &cells;
        for (int d = 1; d < 8; ++d) {
            const glm::ivec3 step(d & 1, d >> 1 & 1, d >> 2);
            const int direction = direction_index(step.x, step.y, step.z);
            const auto place = static_cast<std::size_t>(d);
            if (around.kind(direction) != Neighbour::kSame) {
                special_ |= kBeyond[place];
                continue;
            }
            seen_[place] = &surface_.cells[around.brick[static_cast<std::size_t>(direction)]];
            // If it is not crossed, neither are the edges between the two.
            if (seen_[place]->crossed && seen_[place]->recorded != 0) add_records_beyond(*seen_[place], step);
        }
        const GridBits inside = cells.grid_bits();
        join_axis<0>(index, around, inside, out);
        join_axis<1>(index, around, inside, out);
        join_axis<2>(index, around, inside, out);
    }

private:
    static constexpr std::array<int, 3> kStride{1, 5, 25};

    // Places beyond the upper sides that the bits of the index name: 4 along its axes, 0 .. 3 along the others.
    static constexpr std::array<GridBits, 8> kBeyond = [] {
        std::array<GridBits, 8> beyond{};
        for (int d = 0; d < 8; ++d) {
            const GridBits x = grid_points_below(4, 5, 5);
            const GridBits y = grid_points_below(5, 4, 5);
            const GridBits z = grid_points_below(5, 5, 4);
            beyond[static_cast<std::size_t>(d)] = grid_points_below(5, 5, 5) & ((d & 1) != 0 ? ~x : x) &
                                                  ((d & 2) != 0 ? ~y : y) & ((d & 4) != 0 ? ~z : z);
        }
        return beyond;
    }();

    // Whose cell is at each place: which of the bricks seen, and its number there.
    struct PlacedCell {
        std::uint8_t brick, cell;
    };
    static constexpr std::array<PlacedCell, 125> kPlacedCells = [] {
        std::array<PlacedCell, 125> placed{};
        for (int p = 0; p < 125; ++p) {
            const int x = p % 5;
            const int y = p / 5 % 5;
            const int z = p / 25;
            placed[static_cast<std::size_t>(p)] = {static_cast<std::uint8_t>((x >> 2) | (y >> 2) << 1 | (z >> 2) << 2),
                                                   static_cast<std::uint8_t>(cell_index(x & 3, y & 3, z & 3))};
        }
        return placed;
    }();

    static GridBits records_of(const BrickCells& cells) {
        GridBits bits = 0;
        for (int row = 0; row < 16 && cells.recorded != 0; ++row)
            bits |= GridBits{cells.recorded >> (4 * row) & 0xF} << (5 * (row & 3) + 25 * (row >> 2));
        return bits;
    }

    void add_records_beyond(const BrickCells& cells, glm::ivec3 step) {
        const glm::ivec3 count = glm::ivec3(kBrickCells) - step * (kBrickCells - 1);
        for (int z = 0; z < count.z; ++z) {
            for (int y = 0; y < count.y; ++y) {
                const std::uint64_t row = cells.recorded >> cell_index(0, y, z) & ((std::uint64_t{1} << count.x) - 1);
                special_ |= GridBits{row} << (4 * step.x + 5 * (y + 4 * step.y) + 25 * (z + 4 * step.z));
            }
        }
    }

    [[nodiscard]] std::uint32_t vertex(int place) const {
        const PlacedCell placed = kPlacedCells[static_cast<std::size_t>(place)];
        const BrickCells& cells = *seen_[placed.brick];
        return cells.first_vertex + cells.first[placed.cell];
    }

    template <int Axis>
    void join_axis(std::uint32_t index, const Neighbourhood& around, GridBits inside, JoinedTile& out) {
        constexpr int kU = (Axis + 1) % 3;
        constexpr int kV = (Axis + 2) % 3;
        constexpr int kStepU = kStride[kU];
        constexpr int kStepV = kStride[kV];
        const GridBits crossed = (inside ^ (inside >> kStride[Axis])) & kEdgeStarts[Axis];
        // An edge is joined by the brick of the lowest cell around it.
        const GridBits own = crossed & kUpper[Axis];
        const GridBits touched = special_ | special_ << kStepU | special_ << kStepV | special_ << (kStepU + kStepV);
        for (GridBits plain = own & ~touched; plain != 0; plain &= plain - 1) {
            const int n = lowest_bit(plain);
            const glm::uvec4 quad(vertex(n - kStepU - kStepV), vertex(n - kStepV), vertex(n), vertex(n - kStepU));
            out.quads.push_back((inside >> n & 1) != 0 ? quad : glm::uvec4(quad.w, quad.z, quad.y, quad.x));
        }
        GridBits special = own & touched;
        // On the lower sides that brick is another one, unless it is of another size.
        glm::ivec3 u(0);
        glm::ivec3 v(0);
        u[kU] = v[kV] = -1;
        const auto bit = [](glm::ivec3 d) { return std::uint32_t{1} << direction_index(d.x, d.y, d.z); };
        const std::uint32_t lower = bit(u) | bit(v) | bit(u + v);
        if ((around.same & lower) != lower) special |= crossed & ~kUpper[Axis];
        for (; special != 0; special &= special - 1) {
            const int n = lowest_bit(special);
            general_.add(index, Axis, {n % 5, n / 5 % 5, n / 25}, (inside >> n & 1) != 0, out);
        }
    }

    // Grid points off the lower sides that an edge along the axis can lie on.
    static constexpr std::array<GridBits, 3> kUpper{
        kEdgeStarts[0] & ~grid_points_below(5, 1, 5) & ~grid_points_below(5, 5, 1),
        kEdgeStarts[1] & ~grid_points_below(1, 5, 5) & ~grid_points_below(5, 5, 1),
        kEdgeStarts[2] & ~grid_points_below(1, 5, 5) & ~grid_points_below(5, 1, 5)};

    const SurfaceCells& surface_;
    EdgePolygons general_;
    std::array<const BrickCells*, 8> seen_{}; // itself and its upper neighbours of the same size, by direction
    GridBits special_ = 0;                    // cells that need the general way
};

} // namespace

void join_tiles(const field::ConvolutionField& field, const Octree& octree, std::span<const std::uint32_t> tiles,
                const SurfaceCells& surface, const VertexSpan& vertices, std::vector<JoinedTile>& joined,
                const JobStretch& job) {
    joined.resize(tiles.size());
    std::atomic<std::size_t> done{0};
    tbb::parallel_for(std::size_t{0}, tiles.size(), [&](std::size_t t) {
        if (job.cancelled()) return;
        BrickJoiner joiner(field, octree, surface, vertices);
        const Tile& tile = octree.tiles[tiles[t]];
        joined[t].clear();
        // Euler: about as many quads as vertices.
        joined[t].quads.reserve(surface.tiles[tiles[t]].vertex_count * 9 / 8 + 64);
        for (std::uint32_t b = tile.first_brick; b < tile.first_brick + tile.brick_count; ++b)
            joiner.join(b, joined[t]);
        job.report(static_cast<float>(++done) / static_cast<float>(joined.size()));
    });
}

} // namespace ramus::mesh::bricks
