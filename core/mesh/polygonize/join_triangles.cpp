#include "core/mesh/polygonize/join_triangles.h"

#include "core/base/huge_pages.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>
#include <oneapi/tbb/parallel_for.h>
#include <utility>

namespace ramus::mesh::bricks {

namespace {

// Marks indices of vertices that joining itself adds; they are numbered within the chunk until all chunks are done.
constexpr std::uint32_t kAddedBit = 0x80000000U;

// One of the cells around an edge.
struct Around {
    std::uint32_t vertex = 0;
    std::uint32_t brick = 0;
    std::int32_t cell = 0;
    std::int32_t level = 0;
    std::int32_t edge = 0; // the minimal edge's midpoint on the cell's quarter grid
    bool recorded = false;
};

struct JoinedChunk {
    std::vector<glm::uvec3> triangles;
    BrickChunk added;
};

class Joiner {
public:
    Joiner(const field::ConvolutionField& field, const BrickSet& set, const SurfaceCells& surface,
           const TriangleMesh& mesh)
        : field_(field), set_(set), surface_(surface), mesh_(mesh) {}

    void join_brick(std::uint32_t index, JoinedChunk& out) {
        const BrickCells& cells = surface_.cells[index];
        if (!cells.crossed) return;
        const GridBits inside = cells.grid_bits();
        join_axis<0>(index, cells, inside, out);
        join_axis<1>(index, cells, inside, out);
        join_axis<2>(index, cells, inside, out);
    }

private:
    template <int Axis>
    void join_axis(std::uint32_t index, const BrickCells& cells, GridBits inside, JoinedChunk& out) {
        constexpr std::array<int, 3> kPointStride{1, 5, 25};
        constexpr std::array<int, 3> kCellStride{1, 4, 16};
        constexpr int kU = (Axis + 1) % 3;
        constexpr int kV = (Axis + 2) % 3;
        constexpr auto kAxis = static_cast<std::size_t>(Axis);
        constexpr int kStepU = kCellStride[static_cast<std::size_t>(kU)];
        constexpr int kStepV = kCellStride[static_cast<std::size_t>(kV)];
        const int level = set_.bricks[index].level;
        GridBits crossed = (inside ^ (inside >> kPointStride[kAxis])) & kEdgeStarts[kAxis];
        for (; crossed != 0; crossed &= crossed - 1) {
            const int n = lowest_bit(crossed);
            const glm::ivec3 point(n % 5, n / 5 % 5, n / 25);
            const bool first_inside = (inside >> n & 1) != 0;
            const bool interior = point[kU] > 0 && point[kU] < 4 && point[kV] > 0 && point[kV] < 4;
            if (interior) {
                // Four cells of this brick; the common case is that corner signs say all about them.
                const int c = cell_index(point.x, point.y, point.z);
                const std::array<int, 4> ring{c - kStepU - kStepV, c - kStepV, c, c - kStepU};
                std::uint64_t recorded = 0;
                for (const int cell : ring) recorded |= cells.recorded >> cell;
                if ((recorded & 1U) == 0) {
                    constexpr std::array<int, 4> kEdge{4 * Axis + 3, 4 * Axis + 2, 4 * Axis, 4 * Axis + 1};
                    std::array<std::uint32_t, 4> v;
                    for (std::size_t q = 0; q < 4; ++q) {
                        const auto cell = static_cast<std::size_t>(ring[q]);
                        v[q] = cells.first_vertex + cells.first[cell] +
                               kCornerCases[cells.mask[cell]].loop_of_edge[static_cast<std::size_t>(kEdge[q])];
                    }
                    emit_quad(first_inside ? glm::uvec4(v[0], v[1], v[2], v[3]) : glm::uvec4(v[3], v[2], v[1], v[0]),
                              out);
                    continue;
                }
            }
            join_edge(index, level, Axis, point, first_inside, out);
        }
    }

    void emit_quad(glm::uvec4 v, JoinedChunk& out) {
        if (prefers_02(v)) {
            out.triangles.emplace_back(v[0], v[1], v[2]);
            out.triangles.emplace_back(v[0], v[2], v[3]);
        } else {
            out.triangles.emplace_back(v[1], v[2], v[3]);
            out.triangles.emplace_back(v[1], v[3], v[0]);
        }
    }

    // The edge from grid point `point` along `axis`, whose first end is inside or not.
    void join_edge(std::uint32_t index, int level, int axis, glm::ivec3 point, bool first_inside, JoinedChunk& out) {
        const int u = (axis + 1) % 3;
        const int v = (axis + 2) % 3;
        const Neighbourhood& around = surface_.neighbours[index];
        std::array<glm::ivec3, 4> cell;
        std::array<int, 4> direction;
        const bool interior = point[u] > 0 && point[u] < 4 && point[v] > 0 && point[v] < 4;
        // Counter-clockwise about the axis.
        constexpr int kLow[4][2] = {{1, 1}, {0, 1}, {0, 0}, {1, 0}};
        for (std::size_t q = 0; q < 4; ++q) {
            cell[q] = point;
            cell[q][u] -= kLow[q][0];
            cell[q][v] -= kLow[q][1];
            direction[q] = kSelf;
            if (interior) continue;
            glm::ivec3 d(0);
            d[u] = cell[q][u] < 0 ? -1 : cell[q][u] > 3 ? 1 : 0;
            d[v] = cell[q][v] < 0 ? -1 : cell[q][v] > 3 ? 1 : 0;
            direction[q] = direction_index(d.x, d.y, d.z);
            // Split by finer cells: its halves are theirs to join.
            if (around.kind[static_cast<std::size_t>(direction[q])] == Neighbour::kFiner) return;
        }
        if (!interior) {
            // The first cell of the edge's own level, in an order that all bricks share, decides whose edge it is.
            for (std::size_t q = 0; q < 4; ++q) {
                if (around.kind[static_cast<std::size_t>(direction[q])] != Neighbour::kSame) continue;
                if (direction[q] != kSelf) return;
                break;
            }
        }
        std::array<Around, 4> ring;
        std::size_t count = 0;
        for (std::size_t q = 0; q < 4; ++q) {
            const auto d = static_cast<std::size_t>(direction[q]);
            Around entry;
            if (around.kind[d] == Neighbour::kSame) {
                entry = same_level(around.brick[d], axis, cell[q], kLow[q][0] + 2 * kLow[q][1]);
            } else {
                if (around.kind[d] == Neighbour::kAbsent) return; // cannot be: absent regions are free of surface
                entry = coarser(index, around.brick[d], axis, point, cell[q]);
            }
            if (count > 0 && same_cell(ring[count - 1], entry)) continue;
            if (q == 3 && same_cell(ring[0], entry)) continue;
            ring[count++] = entry;
        }
        if (!first_inside) {
            std::reverse(ring.begin(), ring.begin() + static_cast<std::ptrdiff_t>(count));
        }
        emit(std::span<const Around>(ring.data(), count), level, axis, out, index, point);
    }

    static bool same_cell(const Around& a, const Around& b) { return a.brick == b.brick && a.cell == b.cell; }

    Around same_level(std::uint32_t brick, int axis, glm::ivec3 cell, int side) const {
        Around entry;
        entry.brick = brick;
        entry.cell = cell_index(cell.x & 3, cell.y & 3, cell.z & 3);
        entry.level = set_.bricks[brick].level;
        const int edge = 4 * axis + side;
        entry.edge = kEdges[static_cast<std::size_t>(edge)].midpoint;
        entry.recorded = surface_.is_recorded(brick, entry.cell);
        entry.vertex = surface_.vertex_of_whole_edge(brick, entry.cell, edge);
        return entry;
    }

    // The cell of a coarser brick that covers our cell (in cells of brick `index`, maybe outside it).
    Around coarser(std::uint32_t index, std::uint32_t brick, int axis, glm::ivec3 point, glm::ivec3 cell) const {
        const Brick& own = set_.bricks[index];
        const Brick& other = set_.bricks[brick];
        const int size = cell_units(own.level);
        glm::ivec3 middle = own.corner + point * size;
        middle[axis] += size / 2;
        const glm::ivec3 covered = (own.corner + cell * size - other.corner) >> glm::ivec3(other.level + 2);
        const glm::ivec3 quarter =
            (middle - other.corner - covered * cell_units(other.level)) >> glm::ivec3(other.level);
        Around entry;
        entry.brick = brick;
        entry.cell = cell_index(covered.x, covered.y, covered.z);
        entry.level = other.level;
        entry.edge = quarter_index(quarter.x, quarter.y, quarter.z);
        entry.recorded = true;
        entry.vertex = surface_.vertex(brick, entry.cell, entry.edge);
        return entry;
    }

    // The vertex on the arc between two neighbouring cells of the ring, or kNone.
    std::uint32_t arc_vertex(const Around& a, const Around& b) const {
        const glm::ivec3 la = low_corner(a);
        const glm::ivec3 lb = low_corner(b);
        const int sa = cell_units(a.level);
        const int sb = cell_units(b.level);
        for (int axis = 0; axis < 3; ++axis) {
            int side_of_a = -1;
            if (la[axis] + sa == lb[axis]) side_of_a = 1;
            if (lb[axis] + sb == la[axis]) side_of_a = 0;
            if (side_of_a < 0) continue;
            const bool a_owns = a.level != b.level ? a.level < b.level : side_of_a == 1;
            const Around& owner = a_owns ? a : b;
            if (!owner.recorded) return kNone;
            const int face = 2 * axis + (a_owns ? side_of_a : 1 - side_of_a);
            const CellRecord& record = surface_.record(owner.brick, owner.cell);
            const auto& vertices = surface_.chunks[owner.brick / kChunkBricks].arc_vertices;
            for (std::uint32_t n = record.arcs_begin; n < record.arcs_begin + record.arcs_count; ++n)
                if (vertices[n].face == face && vertices[n].edge == owner.edge)
                    return surface_.cells[owner.brick].first_vertex + vertices[n].vertex;
            return kNone;
        }
        return kNone;
    }

    glm::ivec3 low_corner(const Around& a) const {
        const Brick& brick = set_.bricks[a.brick];
        return brick.corner + glm::ivec3(a.cell & 3, a.cell >> 2 & 3, a.cell >> 4) * cell_units(a.level);
    }

    void emit(std::span<const Around> ring, int level, int axis, JoinedChunk& out, std::uint32_t index,
              glm::ivec3 point) {
        const bool any_record = std::ranges::any_of(ring, [](const Around& a) { return a.recorded; });
        if (any_record) {
            std::array<std::uint32_t, 8> polygon{};
            std::size_t count = 0;
            bool extra = false;
            for (std::size_t n = 0; n < ring.size(); ++n) {
                polygon[count++] = ring[n].vertex;
                const std::uint32_t between = arc_vertex(ring[n], ring[(n + 1) % ring.size()]);
                if (between == kNone) continue;
                polygon[count++] = between;
                extra = true;
            }
            if (extra) {
                emit_fan(std::span<const std::uint32_t>(polygon.data(), count), axis, out, index, point);
                return;
            }
        }
        if (ring.size() == 3) {
            out.triangles.emplace_back(ring[0].vertex, ring[1].vertex, ring[2].vertex);
            return;
        }
        // Between cells of different size only a diagonal that ends in one as small as the edge is unique to this edge.
        const bool allow_02 = ring[0].level == level || ring[2].level == level;
        const bool allow_13 = ring[1].level == level || ring[3].level == level;
        const glm::uvec4 v(ring[0].vertex, ring[1].vertex, ring[2].vertex, ring[3].vertex);
        if (allow_02 && allow_13) {
            emit_quad(v, out);
        } else if (allow_02) {
            out.triangles.emplace_back(v[0], v[1], v[2]);
            out.triangles.emplace_back(v[0], v[2], v[3]);
        } else {
            out.triangles.emplace_back(v[1], v[2], v[3]);
            out.triangles.emplace_back(v[1], v[3], v[0]);
        }
    }

    // Of the two diagonals of a quad, the better: none of its triangles may face away from the surface, and then the
    // one that stays closer to it. A chord's distance from the surface is its length times the turn of the normal,
    // over 8.
    [[nodiscard]] bool prefers_02(glm::uvec4 v) const {
        const glm::vec3 p0 = mesh_.positions[v[0]], p1 = mesh_.positions[v[1]], p2 = mesh_.positions[v[2]],
                        p3 = mesh_.positions[v[3]];
        const glm::vec3 n0 = mesh_.normals[v[0]], n1 = mesh_.normals[v[1]], n2 = mesh_.normals[v[2]],
                        n3 = mesh_.normals[v[3]];
        const glm::vec3 d02 = p2 - p0;
        const glm::vec3 d13 = p3 - p1;
        // On a flat stretch both chords are on the surface, and the shorter diagonal makes the rounder triangles.
        constexpr float kFlat = 0.02F;
        const float l02 = glm::dot(d02, d02);
        const float l13 = glm::dot(d13, d13);
        const float size = std::sqrt(std::max(l02, l13));
        const bool closer_02 = std::abs(glm::dot(d02, n2 - n0)) * size + kFlat * l02 <
                               std::abs(glm::dot(d13, n3 - n1)) * size + kFlat * l13;
        // Signed squares of the triangles' areas as seen from outside: one that faces away, or nearly, is negative or
        // small. The worse of a diagonal's two triangles counts.
        const glm::vec3 facing = n0 + n1 + n2 + n3;
        const auto score = [&](const glm::vec3& area) {
            const float along = glm::dot(area, facing);
            return along * std::abs(along);
        };
        const auto worst_02 = [&] {
            return std::min(score(glm::cross(p1 - p0, d02)), score(glm::cross(d02, p3 - p0)));
        };
        const auto worst_13 = [&] {
            return std::min(score(glm::cross(p2 - p1, d13)), score(glm::cross(d13, p0 - p1)));
        };
        constexpr float kThin = 0.01F; // a tenth of the area of a square on the diagonals; tuned on real trees
        const float enough = kThin * l02 * l13 * glm::dot(facing, facing);
        const float worst = closer_02 ? worst_02() : worst_13();
        if (worst >= enough) return closer_02;
        const float other = closer_02 ? worst_13() : worst_02();
        return (other > worst) != closer_02;
    }

    // A polygon with vertices on its arcs is fanned about a vertex at its edge's crossing, so that no new edge can
    // coincide with another polygon's.
    void emit_fan(std::span<const std::uint32_t> polygon, int axis, JoinedChunk& out, std::uint32_t index,
                  glm::ivec3 point) {
        const Brick& brick = set_.bricks[index];
        const auto cell = static_cast<float>(set_.lattice.cell_mm(brick.level));
        field::Projection projection;
        projection.origin = set_.lattice.position(brick.corner);
        glm::vec3 sum(0.0F);
        for (const std::uint32_t v : polygon) sum += glm::vec3(glm::dvec3(mesh_.positions[v]) - projection.origin);
        glm::vec3 middle = glm::vec3(point) * cell;
        middle[axis] += 0.5F * cell;
        projection.add(sum / static_cast<float>(polygon.size()), middle, 0.6F * cell);
        const auto centre = kAddedBit | static_cast<std::uint32_t>(out.added.positions.size());
        append_projected(field_, set_.segments_of(brick), projection, out.added);
        for (std::size_t n = 0; n < polygon.size(); ++n)
            out.triangles.emplace_back(centre, polygon[n], polygon[(n + 1) % polygon.size()]);
    }

    const field::ConvolutionField& field_;
    const BrickSet& set_;
    const SurfaceCells& surface_;
    const TriangleMesh& mesh_;
};

void copy_vertices(const BrickChunk& from, std::size_t first, TriangleMesh& mesh) {
    const auto at = static_cast<std::ptrdiff_t>(first);
    std::ranges::copy(from.positions, mesh.positions.begin() + at);
    std::ranges::copy(from.normals, mesh.normals.begin() + at);
    std::ranges::copy(from.radii, mesh.radii.begin() + at);
    std::ranges::copy(from.branches, mesh.branches.begin() + at);
}

void resize_vertices(TriangleMesh& mesh, std::size_t count) {
    resize_large(mesh.positions, count);
    resize_large(mesh.normals, count);
    resize_large(mesh.radii, count);
    resize_large(mesh.branches, count);
}

// Gathers the chunks' vertices into the mesh and turns the bricks' first vertices into indices of the mesh.
void gather_vertices(SurfaceCells& surface, TriangleMesh& mesh) {
    std::vector<std::size_t> first(surface.chunks.size() + 1, 0);
    for (std::size_t c = 0; c < surface.chunks.size(); ++c)
        first[c + 1] = first[c] + surface.chunks[c].positions.size();
    resize_vertices(mesh, first.back());
    tbb::parallel_for(std::size_t{0}, surface.chunks.size(), [&](std::size_t c) {
        BrickChunk& chunk = surface.chunks[c];
        copy_vertices(chunk, first[c], mesh);
        chunk.vertex_count = chunk.positions.size();
        chunk.positions = {}, chunk.normals = {}, chunk.radii = {}, chunk.branches = {};
        for (std::size_t b = c * kChunkBricks; b < std::min(surface.cells.size(), (c + 1) * kChunkBricks); ++b)
            surface.cells[b].first_vertex += static_cast<std::uint32_t>(first[c]);
    });
}

} // namespace

TriangleMesh join_triangles(const field::ConvolutionField& field, const BrickSet& set, SurfaceCells surface, Job& job) {
    TriangleMesh mesh;
    gather_vertices(surface, mesh);
    std::vector<JoinedChunk> joined(surface.chunks.size());
    std::atomic<std::size_t> done{0};
    tbb::parallel_for(std::size_t{0}, joined.size(), [&](std::size_t c) {
        if (job.cancelled()) return;
        Joiner joiner(field, set, surface, mesh);
        joined[c].triangles.reserve(2 * surface.chunks[c].vertex_count + 64); // Euler: two triangles a vertex, nearly
        for (std::size_t b = c * kChunkBricks; b < std::min(set.bricks.size(), (c + 1) * kChunkBricks); ++b)
            joiner.join_brick(static_cast<std::uint32_t>(b), joined[c]);
        job.report(0.8F + 0.2F * static_cast<float>(++done) / static_cast<float>(joined.size()));
    });
    if (job.cancelled()) return {};

    std::vector<std::size_t> first_triangle(joined.size() + 1, 0);
    std::vector<std::size_t> first_added(joined.size() + 1, mesh.positions.size());
    for (std::size_t c = 0; c < joined.size(); ++c) {
        first_triangle[c + 1] = first_triangle[c] + joined[c].triangles.size();
        first_added[c + 1] = first_added[c] + joined[c].added.positions.size();
    }
    resize_large(mesh.triangles, first_triangle.back());
    if (first_added.back() > mesh.positions.size()) resize_vertices(mesh, first_added.back());
    tbb::parallel_for(std::size_t{0}, joined.size(), [&](std::size_t c) {
        copy_vertices(joined[c].added, first_added[c], mesh);
        auto out = mesh.triangles.begin() + static_cast<std::ptrdiff_t>(first_triangle[c]);
        for (glm::uvec3 triangle : joined[c].triangles) {
            for (int i = 0; i < 3; ++i)
                if ((triangle[i] & kAddedBit) != 0)
                    triangle[i] = static_cast<std::uint32_t>(first_added[c]) + (triangle[i] & ~kAddedBit);
            *out++ = triangle;
        }
        joined[c] = {};
    });
    return mesh;
}

} // namespace ramus::mesh::bricks
