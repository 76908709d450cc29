#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/mesh/polygonize/join/join_triangles.cpp"
// clang-format off: foreach_target compiles this file once per instruction set and must come first.
#include <hwy/foreach_target.h>
// clang-format on
#include "core/mesh/polygonize/join/join_triangles.h"

#include <array>
#include <atomic>
#include <bit>
#include <hwy/highway.h>
#include <oneapi/tbb/parallel_for.h>
#include <type_traits>
#include <utility>

HWY_BEFORE_NAMESPACE();
namespace ramus::mesh::bricks::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

constexpr int kEdgesPerAxis = 64; // that a brick may have to join

// Cells at and next to a brick, at x + 5 y + 25 z: its own cells have the coordinates 0 to 3, cells beyond an upper
// side 4. By set of upper sides (bits of the index): the cells beyond exactly these sides.
constexpr std::array<GridBits, 8> kBeyond = [] {
    std::array<GridBits, 8> beyond{};
    for (int d = 0; d < 8; ++d) {
        const GridBits x = grid_points_below(4, 5, 5);
        const GridBits y = grid_points_below(5, 4, 5);
        const GridBits z = grid_points_below(5, 5, 4);
        beyond[static_cast<std::size_t>(d)] =
            grid_points_below(5, 5, 5) & ((d & 1) != 0 ? ~x : x) & ((d & 2) != 0 ? ~y : y) & ((d & 4) != 0 ? ~z : z);
    }
    return beyond;
}();

// The brick of the lowest cell around an edge is responsible for it. These are the edges that do not begin on the lower
// sides along the other two axes: 4 x 4 x 4 for each axis, in the order of their first points.
constexpr std::array<GridBits, 3> kOwnEdges{kEdgeStarts[0] & ~kLowerSides[1] & ~kLowerSides[2],
                                            kEdgeStarts[1] & ~kLowerSides[2] & ~kLowerSides[0],
                                            kEdgeStarts[2] & ~kLowerSides[0] & ~kLowerSides[1]};
constexpr std::array<std::array<std::uint8_t, kEdgesPerAxis>, 3> kOwnEdgePoints = [] {
    std::array<std::array<std::uint8_t, kEdgesPerAxis>, 3> points{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        std::size_t n = 0;
        for (int p = 0; p < 125; ++p)
            if ((kOwnEdges[axis] >> p & 1) != 0) points[axis][n++] = static_cast<std::uint8_t>(p);
    }
    return points;
}();

// Compresses the bits of the edges along the axis for which a brick is responsible.
template <std::size_t Axis> HWY_INLINE std::uint64_t own_edges(GridBits bits) {
#if HWY_ARCH_X86_64 && HWY_TARGET <= HWY_AVX3 // some processors without AVX-512 take long for this instruction
    constexpr auto kLow = static_cast<std::uint64_t>(kOwnEdges[Axis]);
    constexpr auto kHigh = static_cast<std::uint64_t>(kOwnEdges[Axis] >> 64);
    return _pext_u64(static_cast<std::uint64_t>(bits), kLow) | _pext_u64(static_cast<std::uint64_t>(bits >> 64), kHigh)
                                                                   << std::popcount(kLow);
#else
    std::uint64_t own = 0;
    for (std::size_t row = 0; row < kEdgesPerAxis; row += 4)
        own |= static_cast<std::uint64_t>(bits >> kOwnEdgePoints[Axis][row] & 15U) << row;
    return own;
#endif
}

// The offsets of the four cells around an edge from its first point, counter-clockwise about it: for an edge whose
// first point is outside, and inside.
template <int Axis>
constexpr std::array<std::array<std::int8_t, 4>, 2> kAround = [] {
    constexpr auto kU = static_cast<std::int8_t>(-kGridStep[(Axis + 1) % 3]);
    constexpr auto kV = static_cast<std::int8_t>(-kGridStep[(Axis + 2) % 3]);
    return std::array<std::array<std::int8_t, 4>, 2>{{{kU, 0, kV, kU + kV}, {kU + kV, kV, 0, kU}}};
}();

class BrickJoiner {
public:
    BrickJoiner(const SurfaceCells& surface, const EdgePolygons& general) : surface_(surface), general_(general) {}

    HWY_INLINE void join(std::uint32_t index, JoinedSubtree& out) {
        const BrickCells& cells = surface_.cells[index];
        if (!cells.crossed) return;
        const Neighbourhood& around = surface_.neighbours[index];
        special_ = 0;
        number<0>(cells);
        look_beyond(around, std::make_integer_sequence<int, 8>());
        const GridBits inside = cells.grid_bits();
        if (HWY_UNLIKELY(cells.walls != kNoWalls)) left_out_ = general_.walls(index).left_out;
        glm::uvec4* next = quads_.data();
        std::array<GridBits, 3> special;
        next = add_quads<0>(inside, around, next, special[0]);
        next = add_quads<1>(inside, around, next, special[1]);
        next = add_quads<2>(inside, around, next, special[2]);
        out.quads.insert(out.quads.end(), quads_.data(), next);
        for (int axis = 0; axis < 3; ++axis) {
            for (GridBits left = special[static_cast<std::size_t>(axis)]; left != 0; left &= left - 1) {
                const int n = lowest_bit(left);
                general_.add(index, axis, grid_point(n), (inside >> n & 1) != 0, out);
            }
        }
        if (HWY_UNLIKELY(cells.walls != kNoWalls)) {
            add_walls(index, around, out);
            left_out_ = {};
        }
        general_.finish(index, out);
    }

private:
    void add_walls(std::uint32_t index, const Neighbourhood& around, JoinedSubtree& out) const {
        const std::array<GridBits, 3>& walls = general_.walls(index).edges;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            // On the lower sides another brick is responsible, unless that brick is larger.
            const GridBits own = around.coarser == 0 ? kOwnEdges[axis] : kEdgeStarts[axis];
            for (GridBits left = walls[axis] & own; left != 0; left &= left - 1) {
                const int n = lowest_bit(left);
                const auto bits =
                    static_cast<unsigned>((left_out_[axis] >> n & 1) | (left_out_[axis + 3] >> n & 1) << 1);
                general_.add_wall(index, static_cast<int>(axis), grid_point(n), bits, out);
            }
        }
    }

    // Stores the vertices of the cells beyond the upper sides in the bits of D (0: the brick's own cells), and the
    // cells that need the general case.
    template <int D> HWY_INLINE void number(const BrickCells& cells) {
        constexpr int kX = (D & 1) != 0 ? 1 : 4;
        constexpr int kY = (D & 2) != 0 ? 1 : 4;
        constexpr int kZ = (D & 4) != 0 ? 1 : 4;
        constexpr int kFirst = ((D & 1) != 0 ? 4 : 0) + ((D & 2) != 0 ? 20 : 0) + ((D & 4) != 0 ? 100 : 0);
        const hn::CappedTag<std::uint32_t, kX> d;
        const hn::Rebind<std::uint16_t, decltype(d)> d16;
        const auto base = hn::Set(d, cells.first_vertex);
        for (int z = 0; z < kZ; ++z)
            for (int y = 0; y < kY; ++y)
                for (int x = 0; x < kX; x += static_cast<int>(hn::Lanes(d))) { // cells without a vertex are not asked
                    const auto within = hn::LoadU(d16, cells.first.data() + x + 4 * y + 16 * z);
                    hn::StoreU(hn::Add(base, hn::PromoteTo(d, within)), d,
                               vertices_.data() + kFirst + x + 5 * y + 25 * z);
                }
        if (HWY_LIKELY(cells.recorded == 0)) return;
        for (int z = 0; z < kZ; ++z)
            for (int y = 0; y < kY; ++y) {
                const std::uint64_t row = cells.recorded >> (4 * y + 16 * z) & ((1U << kX) - 1);
                special_ |= GridBits{row} << (kFirst + 5 * y + 25 * z);
            }
    }

    template <int... D> HWY_INLINE void look_beyond(const Neighbourhood& around, std::integer_sequence<int, D...>) {
        const auto look = [&](auto beyond) {
            constexpr int kSides = beyond.value;
            constexpr int kDirection = direction_index(kSides & 1, kSides >> 1 & 1, kSides >> 2);
            if constexpr (kSides == 0) return;
            if ((around.same >> kDirection & 1) == 0) {
                special_ |= kBeyond[kSides];
            } else if (const BrickCells& cells = surface_.cells[around.brick[kDirection]]; cells.crossed) {
                number<kSides>(cells);
            } // else the edges between the two are not crossed either
        };
        (look(std::integral_constant<int, D>()), ...);
    }

    // Writes the quads of the edges along the axis and returns their end. Edges that need the general case go to
    // `special`.
    template <int Axis>
    HWY_INLINE glm::uvec4* add_quads(GridBits inside, const Neighbourhood& around, glm::uvec4* next,
                                     GridBits& special) const {
        constexpr int kU = (Axis + 1) % 3;
        constexpr int kV = (Axis + 2) % 3;
        const GridBits crossed = (inside ^ (inside >> kGridStep[Axis])) & kEdgeStarts[Axis] & ~left_out_[Axis];
        const GridBits touched = special_ | special_ << kGridStep[kU] | special_ << kGridStep[kV] |
                                 special_ << (kGridStep[kU] + kGridStep[kV]);
        const std::uint64_t from_inside = own_edges<Axis>(inside);
        for (std::uint64_t left = own_edges<Axis>(crossed & ~touched); left != 0; left &= left - 1) {
            const int n = std::countr_zero(left);
            const std::uint32_t* at = vertices_.data() + kOwnEdgePoints[Axis][static_cast<std::size_t>(n)];
            const auto& of = kAround<Axis>[from_inside >> n & 1];
            *next++ = {at[of[0]], at[of[1]], at[of[2]], at[of[3]]};
        }
        special = crossed & kOwnEdges[Axis] & touched;
        if (around.coarser == 0) return next;
        // On the lower sides another brick is responsible, unless that brick is larger.
        constexpr auto kBit = [](int along) {
            std::array<int, 3> step{};
            step[static_cast<std::size_t>(along)] = -1;
            return std::uint32_t{1} << direction_index(step[0], step[1], step[2]);
        };
        if ((around.coarser & kBit(kU)) != 0) special |= crossed & kLowerSides[kU];
        if ((around.coarser & kBit(kV)) != 0) special |= crossed & kLowerSides[kV];
        return next;
    }

    const SurfaceCells& surface_;
    const EdgePolygons& general_;
    std::array<std::uint32_t, 128> vertices_{}; // of the cells seen, by coordinates
    std::array<glm::uvec4, 3 * kEdgesPerAxis> quads_;
    GridBits special_ = 0;               // cells that need the general case
    std::array<GridBits, 6> left_out_{}; // edges, as in BrickWalls
};

// Appends the polygons of the bricks from `first` up to `end`. Most edges have cells of one size with one vertex each,
// and are processed a brick at a time with tables and bit operations. The others are handled by EdgePolygons.
void join_bricks(const SurfaceCells& surface, const EdgePolygons& general, std::uint32_t first, std::uint32_t end,
                 JoinedSubtree& out) {
    BrickJoiner joiner(surface, general);
    for (std::uint32_t b = first; b < end; ++b) joiner.join(b, out);
}

} // namespace ramus::mesh::bricks::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace ramus::mesh::bricks {

HWY_EXPORT(join_bricks);

void join_subtrees(const field::Field& field, const Octree& octree, std::span<const std::uint32_t> subtrees,
                   const SurfaceCells& surface, const VertexSpan& vertices, std::vector<JoinedSubtree>& joined,
                   const JobRange& job) {
    joined.resize(subtrees.size());
    std::atomic<std::size_t> done{0};
    const EdgePolygons general(field, octree, surface, vertices);
    tbb::parallel_for(std::size_t{0}, subtrees.size(), [&](std::size_t t) {
        if (job.cancelled()) return;
        const Subtree& subtree = octree.subtrees[subtrees[t]];
        joined[t].clear();
        // By Euler's formula there are about as many quads as vertices.
        joined[t].quads.reserve(surface.subtrees[subtrees[t]].vertex_count * 9 / 8 + 64);
        HWY_DYNAMIC_DISPATCH(join_bricks)
        (surface, general, subtree.first_brick, subtree.first_brick + subtree.brick_count, joined[t]);
        job.report(static_cast<float>(++done) / static_cast<float>(joined.size()));
    });
}

} // namespace ramus::mesh::bricks
#endif
