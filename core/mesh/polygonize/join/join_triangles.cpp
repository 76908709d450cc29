#include "core/mesh/polygonize/join/join_triangles.h"

#include "core/mesh/polygonize/join/edge_polygons.h"
#include "core/mesh/polygonize/join/quad_diagonals.h"
#include "core/mesh/resize_vertices.h"

#include <algorithm>
#include <atomic>
#include <oneapi/tbb/parallel_for.h>
#include <utility>

namespace ramus::mesh::bricks {

namespace {

// The quads of one brick whose cells are all of one size and have one vertex each, which most are. Of the cells it sees
// its own, places 0 .. 3 along every axis, and those just beyond its upper sides, place 4, at x + 5 y + 25 z.
class BrickJoiner {
public:
    BrickJoiner(const field::ConvolutionField& field, const Octree& octree, const SurfaceCells& surface,
                const TriangleMesh& mesh)
        : surface_(surface), general_(field, octree, surface, mesh) {}

    void join(std::uint32_t index, JoinedTile& out) {
        const BrickCells& cells = surface_.cells[index];
        if (!cells.crossed) return;
        const Neighbourhood& around = surface_.neighbours[index];
        special_ = 0;
        see_cells(cells, {0, 0, 0});
        for (int d = 1; d < 8; ++d) {
            const glm::ivec3 step(d & 1, d >> 1 & 1, d >> 2);
            const int direction = direction_index(step.x, step.y, step.z);
            if (around.kind(direction) != Neighbour::kSame)
                special_ |= kBeyond[static_cast<std::size_t>(d)];
            else if (const BrickCells& beyond = surface_.cells[around.brick[static_cast<std::size_t>(direction)]];
                     beyond.crossed) // if not, neither are the edges between the two
                see_cells(beyond, step);
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

    void see_cells(const BrickCells& cells, glm::ivec3 step) {
        const glm::ivec3 count = glm::ivec3(kBrickCells) - step * (kBrickCells - 1);
        for (int z = 0; z < count.z; ++z) {
            for (int y = 0; y < count.y; ++y) {
                const int cell = cell_index(0, y, z);
                const int place = 4 * step.x + 5 * (y + 4 * step.y) + 25 * (z + 4 * step.z);
                for (int x = 0; x < count.x; ++x)
                    vertex_[static_cast<std::size_t>(place + x)] =
                        cells.first_vertex + cells.first[static_cast<std::size_t>(cell + x)];
                const std::uint64_t row = cells.recorded >> cell & ((std::uint64_t{1} << count.x) - 1);
                special_ |= GridBits{row} << place;
            }
        }
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
            const auto at = [&](int back) { return vertex_[static_cast<std::size_t>(n - back)]; };
            const glm::uvec4 quad(at(kStepU + kStepV), at(kStepV), at(0), at(kStepU));
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
    std::array<std::uint32_t, 125> vertex_{}; // the cells' vertices
    GridBits special_ = 0;                    // cells that need the general way
};

void copy_vertices(const TileCells& from, std::size_t first, TriangleMesh& mesh) {
    const auto at = static_cast<std::ptrdiff_t>(first);
    std::copy_n(from.positions.begin(), from.vertex_count, mesh.positions.begin() + at);
    std::copy_n(from.normals.begin(), from.vertex_count, mesh.normals.begin() + at);
    std::copy_n(from.radii.begin(), from.vertex_count, mesh.radii.begin() + at);
    std::copy_n(from.branches.begin(), from.vertex_count, mesh.branches.begin() + at);
}

// Room for the few vertices that joining adds, so that they do not move all others.
void reserve_vertices(TriangleMesh& mesh, std::size_t count) {
    mesh.positions.reserve(count);
    mesh.normals.reserve(count);
    mesh.radii.reserve(count);
    mesh.branches.reserve(count);
}

// Gathers the tiles' vertices into the mesh and turns the bricks' first vertices into indices of the mesh.
void gather_vertices(const Octree& octree, SurfaceCells& surface, TriangleMesh& mesh) {
    std::vector<std::size_t> first(surface.tiles.size() + 1, 0);
    for (std::size_t t = 0; t < surface.tiles.size(); ++t) first[t + 1] = first[t] + surface.tiles[t].vertex_count;
    reserve_vertices(mesh, first.back() + first.back() / 64);
    resize_vertices(mesh, first.back());
    tbb::parallel_for(std::size_t{0}, surface.tiles.size(), [&](std::size_t t) {
        TileCells& tile = surface.tiles[t];
        copy_vertices(tile, first[t], mesh);
        tile.positions = {}, tile.normals = {}, tile.radii = {}, tile.branches = {};
        const Tile& place = octree.tiles[t];
        for (std::uint32_t b = place.first_brick; b < place.first_brick + place.brick_count; ++b)
            surface.cells[b].first_vertex += static_cast<std::uint32_t>(first[t]);
    });
}

} // namespace

TriangleMesh join_triangles(const field::ConvolutionField& field, const Octree& octree, SurfaceCells surface,
                            Job& job) {
    TriangleMesh mesh;
    gather_vertices(octree, surface, mesh);
    std::vector<JoinedTile> joined(surface.tiles.size());
    std::atomic<std::size_t> done{0};
    tbb::parallel_for(std::size_t{0}, joined.size(), [&](std::size_t t) {
        if (job.cancelled()) return;
        BrickJoiner joiner(field, octree, surface, mesh);
        joined[t].quads.reserve(surface.tiles[t].vertex_count * 9 / 8 + 64); // Euler: about as many quads as vertices
        const Tile& place = octree.tiles[t];
        for (std::uint32_t b = place.first_brick; b < place.first_brick + place.brick_count; ++b)
            joiner.join(b, joined[t]);
        job.report(0.8F + 0.2F * static_cast<float>(++done) / static_cast<float>(joined.size()));
    });
    if (job.cancelled()) return {};

    std::vector<std::size_t> first_triangle(joined.size() + 1, 0);
    std::vector<std::size_t> first_added(joined.size() + 1, mesh.positions.size());
    for (std::size_t t = 0; t < joined.size(); ++t) {
        first_triangle[t + 1] = first_triangle[t] + 2 * joined[t].quads.size() + joined[t].triangles.size();
        first_added[t + 1] = first_added[t] + joined[t].added.vertex_count;
    }
    mesh.triangles.resize(first_triangle.back());
    if (first_added.back() > mesh.positions.size()) resize_vertices(mesh, first_added.back());
    tbb::parallel_for(std::size_t{0}, joined.size(), [&](std::size_t t) {
        copy_vertices(joined[t].added, first_added[t], mesh);
        const auto out = std::span(mesh.triangles).subspan(first_triangle[t]);
        cut_quads(mesh, joined[t].quads, out);
        std::size_t n = 2 * joined[t].quads.size();
        for (glm::uvec3 triangle : joined[t].triangles) {
            for (int i = 0; i < 3; ++i)
                if ((triangle[i] & kAddedBit) != 0)
                    triangle[i] = static_cast<std::uint32_t>(first_added[t]) + (triangle[i] & ~kAddedBit);
            out[n++] = triangle;
        }
        joined[t] = {};
    });
    return mesh;
}

} // namespace ramus::mesh::bricks
