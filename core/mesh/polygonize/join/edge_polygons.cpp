#include "core/mesh/polygonize/join/edge_polygons.h"

#include <algorithm>
#include <cassert>
#include <glm/geometric.hpp>

namespace ramus::mesh::bricks {

namespace {

constexpr std::uint32_t kNoArcVertex = 0xFFFFFFFFU;

} // namespace

void JoinedSubtree::write_triangles(const VertexSpan& vertices, std::uint64_t first_added,
                                    std::span<glm::uvec3> out) const {
    cut_quads(vertices, quads, out);
    auto next = out.begin() + static_cast<std::ptrdiff_t>(2 * quads.size());
    for (glm::uvec3 triangle : triangles) {
        for (int i = 0; i < 3; ++i)
            if ((triangle[i] & kAddedBit) != 0)
                triangle[i] = static_cast<std::uint32_t>(first_added) + (triangle[i] & ~kAddedBit);
        *next++ = triangle;
    }
}

void JoinedSubtree::clear() {
    quads.clear();
    triangles.clear();
    added.count = 0;
}

void EdgePolygons::add(std::uint32_t index, int axis, glm::ivec3 point, bool first_inside, JoinedSubtree& out) const {
    const Edge edge{index, axis, point, !first_inside, false};
    Ring ring = ring_around(edge);
    if (ring.count == 0) return;
    if (!first_inside) std::ranges::reverse(std::span(ring.cells).first(ring.count));
    if (!emit_with_arcs(ring.span(), edge, out)) emit(ring.span(), edge, out);
}

void EdgePolygons::add_wall(std::uint32_t index, int axis, glm::ivec3 point, JoinedSubtree& out) const {
    const Edge lower{index, axis, point, false, true};
    const Edge upper{index, axis, point, true, true};
    const Ring first = ring_around(lower);
    if (first.count < 2) return;
    Ring second = ring_around(upper);
    assert(second.count == first.count);
    const auto reversed = [](Ring ring) {
        std::ranges::reverse(std::span(ring.cells).first(ring.count));
        return ring;
    };
    if (first.count == 2) {
        // The wall ends in the two others: what is left are triangles with the arc between these, if it has a vertex.
        const bool across_start = first.cells[0].place == 0 && first.cells[1].place == 3;
        const std::size_t from = across_start ? 1 : 0;
        const std::uint32_t low = arc_vertex(first.cells[from], first.cells[1 - from]);
        const std::uint32_t high = arc_vertex(second.cells[from], second.cells[1 - from]);
        if (low != kNoArcVertex)
            out.triangles.emplace_back(first.cells[from].vertex, low, first.cells[1 - from].vertex);
        if (high != kNoArcVertex)
            out.triangles.emplace_back(second.cells[1 - from].vertex, high, second.cells[from].vertex);
        return;
    }
    if (first.count == 3) {
        if (!emit_with_arcs(first.span(), lower, out)) emit(first.span(), lower, out);
        second = reversed(second);
        if (!emit_with_arcs(second.span(), upper, out)) emit(second.span(), upper, out);
        return;
    }
    // A hair lies between the two sides, and what bends one bends the other: cut along the same diagonal they do not
    // meet.
    const auto length2 = [&](std::size_t a, std::size_t b) {
        const glm::vec3 between =
            vertices_.positions[first.cells[a].vertex] - vertices_.positions[first.cells[b].vertex];
        return glm::dot(between, between);
    };
    const auto [allow_02, allow_13] = diagonals_of(first.span(), lower);
    const bool along_02 = allow_02 && (!allow_13 || length2(0, 2) <= length2(1, 3));
    const auto cut = [&](const Ring& ring, bool turned) {
        const auto v = [&](std::size_t n) { return ring.cells[(n + (along_02 ? 0 : 1)) & 3].vertex; };
        if (turned) {
            out.triangles.emplace_back(v(2), v(1), v(0));
            out.triangles.emplace_back(v(3), v(2), v(0));
        } else {
            out.triangles.emplace_back(v(0), v(1), v(2));
            out.triangles.emplace_back(v(0), v(2), v(3));
        }
    };
    if (!emit_with_arcs(first.span(), lower, out)) cut(first, false);
    if (!emit_with_arcs(reversed(second).span(), upper, out)) cut(second, true);
}

EdgePolygons::Ring EdgePolygons::ring_around(const Edge& edge) const {
    const auto& [index, axis, point, upper, walled] = edge;
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
        if (around.kind(direction[q]) == Neighbour::kFiner) return {};
    }
    if (!interior) {
        // The first cell of the edge's own level, in an order that all bricks share, decides whose edge it is.
        for (std::size_t q = 0; q < 4; ++q) {
            if (around.kind(direction[q]) != Neighbour::kSame) continue;
            if (direction[q] != kSelf) return {};
            break;
        }
    }
    const auto is_same_cell = [](const Around& a, const Around& b) { return a.brick == b.brick && a.cell == b.cell; };
    Ring ring;
    for (std::size_t q = 0; q < 4; ++q) {
        const std::uint32_t brick = around.brick[static_cast<std::size_t>(direction[q])];
        Around entry;
        if (around.kind(direction[q]) == Neighbour::kSame) {
            entry = same_level(brick, edge, cell[q], kLow[q][0] + 2 * kLow[q][1]);
        } else {
            // An absent region is free of surface, so no crossed edge can touch it.
            assert(around.kind(direction[q]) == Neighbour::kCoarser);
            entry = coarser(brick, edge, cell[q]);
        }
        if (entry.vertex == SurfaceCells::kAbsent) continue;
        if (ring.count > 0 && is_same_cell(ring.cells[ring.count - 1], entry)) continue;
        if (q == 3 && is_same_cell(ring.cells[0], entry)) continue;
        entry.place = static_cast<std::int32_t>(q);
        ring.cells[ring.count++] = entry;
    }
    return ring;
}

EdgePolygons::Around EdgePolygons::same_level(std::uint32_t brick, const Edge& edge, glm::ivec3 cell, int side) const {
    Around entry;
    entry.brick = brick;
    entry.cell = cell_index(cell.x & 3, cell.y & 3, cell.z & 3);
    entry.level = octree_.bricks[brick].level;
    entry.crossing = edge_midpoint(4 * edge.axis + side) + (edge.walled && edge.upper ? kUpperEnd : 0);
    entry.recorded = surface_.is_recorded(brick, entry.cell);
    entry.vertex = surface_.vertex(octree_.bricks[brick], brick, entry.cell, entry.crossing);
    return entry;
}

// The cell of a coarser brick that covers our cell (in cells of the edge's brick, maybe outside it).
EdgePolygons::Around EdgePolygons::coarser(std::uint32_t brick, const Edge& edge, glm::ivec3 cell) const {
    const Brick& own = octree_.bricks[edge.brick];
    const Brick& other = octree_.bricks[brick];
    const int size = cell_units(own.level);
    glm::ivec3 middle = own.corner + edge.point * size;
    middle[edge.axis] += size / 2;
    const glm::ivec3 covered = (own.corner + cell * size - other.corner) >> glm::ivec3(other.level + 2);
    const glm::ivec3 quarter = (middle - other.corner - covered * cell_units(other.level)) >> glm::ivec3(other.level);
    Around entry;
    entry.brick = brick;
    entry.cell = cell_index(covered.x, covered.y, covered.z);
    entry.level = other.level;
    entry.crossing = quarter_index(quarter.x, quarter.y, quarter.z) + (edge.walled && edge.upper ? kUpperEnd : 0);
    entry.recorded = true;
    entry.vertex = surface_.vertex(octree_.bricks[brick], brick, entry.cell, entry.crossing);
    return entry;
}

// The vertex on the arc between two neighbouring cells of the ring, or kNoArcVertex.
std::uint32_t EdgePolygons::arc_vertex(const Around& a, const Around& b) const {
    const glm::ivec3 la = low_corner(a);
    const glm::ivec3 lb = low_corner(b);
    const int sa = cell_units(a.level);
    const int sb = cell_units(b.level);
    for (int axis = 0; axis < 3; ++axis) {
        int side_of_a = -1;
        if (la[axis] + sa == lb[axis]) side_of_a = 1;
        if (lb[axis] + sb == la[axis]) side_of_a = 0;
        if (side_of_a < 0) continue;
        // Where a cell between them has no vertex, they only meet at the edge.
        const int u = (axis + 1) % 3;
        const int v = (axis + 2) % 3;
        if (la[u] + sa <= lb[u] || lb[u] + sb <= la[u] || la[v] + sa <= lb[v] || lb[v] + sb <= la[v])
            return kNoArcVertex;
        const bool a_owns = a.level != b.level ? a.level < b.level : side_of_a == 1;
        const Around& owner = a_owns ? a : b;
        if (!owner.recorded) return kNoArcVertex;
        const int face = 2 * axis + (a_owns ? side_of_a : 1 - side_of_a);
        const CellRecord& record = surface_.record(octree_.bricks[owner.brick], owner.brick, owner.cell);
        const auto& vertices = surface_.subtrees[octree_.bricks[owner.brick].subtree].arc_vertices;
        for (std::uint32_t n = record.arcs_begin; n < record.arcs_begin + record.arcs_count; ++n)
            if (vertices[n].face == face && vertices[n].edge == owner.crossing)
                return surface_.cells[owner.brick].first_vertex + vertices[n].vertex;
        return kNoArcVertex;
    }
    return kNoArcVertex;
}

glm::ivec3 EdgePolygons::low_corner(const Around& a) const {
    const Brick& brick = octree_.bricks[a.brick];
    return brick.corner + glm::ivec3(a.cell & 3, a.cell >> 2 & 3, a.cell >> 4) * cell_units(a.level);
}

bool EdgePolygons::emit_with_arcs(std::span<const Around> ring, const Edge& edge, JoinedSubtree& out) const {
    if (std::ranges::none_of(ring, &Around::recorded)) return false;
    std::array<std::uint32_t, 8> polygon{};
    std::size_t count = 0;
    bool extra = false;
    for (std::size_t n = 0; n < ring.size(); ++n) {
        polygon[count++] = ring[n].vertex;
        const std::uint32_t between = arc_vertex(ring[n], ring[(n + 1) % ring.size()]);
        if (between == kNoArcVertex) continue;
        polygon[count++] = between;
        extra = true;
    }
    if (extra) emit_fan(std::span<const std::uint32_t>(polygon.data(), count), edge, out);
    return extra;
}

// Between cells of different size only a diagonal that ends in one as small as the edge is unique to this edge.
std::pair<bool, bool> EdgePolygons::diagonals_of(std::span<const Around> ring, const Edge& edge) const {
    const int level = octree_.bricks[edge.brick].level;
    return {ring[0].level == level || ring[2].level == level, ring[1].level == level || ring[3].level == level};
}

void EdgePolygons::emit(std::span<const Around> ring, const Edge& edge, JoinedSubtree& out) const {
    if (ring.size() == 3) {
        out.triangles.emplace_back(ring[0].vertex, ring[1].vertex, ring[2].vertex);
        return;
    }
    const auto [allow_02, allow_13] = diagonals_of(ring, edge);
    const glm::uvec4 v(ring[0].vertex, ring[1].vertex, ring[2].vertex, ring[3].vertex);
    if (allow_02 && allow_13) {
        out.quads.push_back(v);
    } else if (allow_02) {
        out.triangles.emplace_back(v[0], v[1], v[2]);
        out.triangles.emplace_back(v[0], v[2], v[3]);
    } else {
        out.triangles.emplace_back(v[1], v[2], v[3]);
        out.triangles.emplace_back(v[1], v[3], v[0]);
    }
}

// A polygon with vertices on its arcs is fanned about a vertex at its edge's crossing, so that no new edge can
// coincide with another polygon's.
void EdgePolygons::emit_fan(std::span<const std::uint32_t> polygon, const Edge& edge, JoinedSubtree& out) const {
    const Brick& brick = octree_.bricks[edge.brick];
    const auto cell = static_cast<float>(octree_.lattice.cell_mm(brick.level));
    const field::GridAxes axes = grid_axes(octree_.lattice, brick);
    const auto field = field_.in_brick();
    field->enter(octree_.segments_of(brick), axes);
    field::Projection guesses;
    glm::vec3 sum(0.0F);
    for (const std::uint32_t v : polygon) sum += glm::vec3(glm::dvec3(vertices_.positions[v]) - axes.corner());
    glm::vec3 middle = glm::vec3(edge.point) * cell;
    middle[edge.axis] += 0.5F * cell;
    guesses.add(sum / static_cast<float>(polygon.size()), middle, 0.6F * cell);
    field::OwnedGuess whose{0, field::kNoOwner, edge.walled};
    if (field->parts_vessels()) {
        glm::ivec3 inside = edge.point;
        inside[edge.axis] += edge.upper ? 1 : 0;
        const auto at = [](const std::array<double, 8>& along, int n) { return along[static_cast<std::size_t>(n)]; };
        field::LatticeAxes lattice;
        lattice.x[0] = at(axes.x, inside.x), lattice.y[0] = at(axes.y, inside.y), lattice.z[0] = at(axes.z, inside.z);
        constexpr std::array<field::LatticePoint, 1> kFirst{};
        (void)field->find_owners(lattice, kFirst, std::span(&whose.owner, 1));
    }
    const auto centre = kAddedBit | static_cast<std::uint32_t>(out.added.count);
    (void)append_projected(*field, guesses, out.added, std::span(&whose, field->parts_vessels() ? 1 : 0));
    for (std::size_t n = 0; n < polygon.size(); ++n)
        out.triangles.emplace_back(centre, polygon[n], polygon[(n + 1) % polygon.size()]);
}

} // namespace ramus::mesh::bricks
