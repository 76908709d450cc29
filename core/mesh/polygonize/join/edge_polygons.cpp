#include "core/mesh/polygonize/join/edge_polygons.h"

#include <algorithm>
#include <cassert>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace ramus::mesh::bricks {

namespace {

constexpr std::uint32_t kNoArcVertex = 0xFFFFFFFFU;

// Whether two open polygons have a common vertex other than their first and last ones.
bool meet_between_ends(const auto& a, const auto& b) {
    const auto inner = [](const auto& polygon) { return polygon.span().subspan(1, polygon.count - 2); };
    return std::ranges::find_first_of(inner(a), inner(b)) != inner(a).end();
}

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
    guesses.clear();
    owned.clear();
    inside.clear();
}

void EdgePolygons::add(std::uint32_t index, int axis, glm::ivec3 point, bool first_inside, JoinedSubtree& out) const {
    const Edge edge{index, axis, point, !first_inside, false};
    Ring ring = ring_around(edge);
    if (ring.count < 3) return;
    if (!first_inside) std::ranges::reverse(std::span(ring.cells).first(ring.count));
    add_polygon(ring, edge, out);
}

void EdgePolygons::add_polygon(const Ring& ring, const Edge& edge, JoinedSubtree& out) const {
    if (ring.count < 3) return;
    const Polygon polygon = polygon_of(ring.span(), false);
    if (polygon.extra)
        emit_fan(add_centre(polygon, edge, out), polygon, false, out);
    else
        emit(ring.span(), edge, out);
}

void EdgePolygons::add_wall(std::uint32_t index, int axis, glm::ivec3 point, unsigned left_out,
                            JoinedSubtree& out) const {
    const Edge lower{index, axis, point, false, true};
    const Edge upper{index, axis, point, true, true};
    const Ring first = (left_out & 1U) == 0 ? ring_around(lower) : Ring{};
    Ring second = (left_out & 2U) == 0 ? ring_around(upper) : Ring{};
    std::ranges::reverse(std::span(second.cells).first(second.count));
    std::uint32_t centre = 0;
    if (first.count >= 2) {
        if (first.open)
            centre = add_fan(first, lower, out);
        else
            add_polygon(first, lower, out);
    }
    if (second.count < 2) return;
    if (first.count < 2 || !first.open) {
        if (second.open)
            add_fan(second, upper, out);
        else
            add_polygon(second, upper, out);
        return;
    }
    // The wall ends at the edge: its two sides meet there.
    const Polygon side = polygon_of(second.span(), true);
    if (!meet_between_ends(polygon_of(first.span(), true), side)) return emit_fan(centre, side, true, out);
    // The wall also ends in a cell on the other side of the edge. With one centre, the edge to that cell's vertex would
    // have four triangles. So each side has its own centre, and two triangles close the rim between them.
    const std::uint32_t other = add_fan(second, upper, out);
    out.triangles.emplace_back(side.vertices[side.count - 1], centre, other);
    out.triangles.emplace_back(centre, side.vertices[0], other);
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
        // Finer cells divide the edge, and are responsible for its halves.
        if (around.kind(direction[q]) == Neighbour::kFiner) return {};
    }
    if (!interior) {
        // The brick of the first cell of the edge's own level, in an order common to all bricks, is responsible for it.
        for (std::size_t q = 0; q < 4; ++q) {
            if (around.kind(direction[q]) != Neighbour::kSame) continue;
            if (direction[q] != kSelf) return {};
            break;
        }
    }
    const auto is_same_cell = [](const Around& a, const Around& b) { return a.brick == b.brick && a.cell == b.cell; };
    Ring ring;
    std::size_t before_gap = 0; // entries; a coarser cell is one entry, however many places it covers
    for (std::size_t q = 0; q < 4; ++q) {
        const std::uint32_t brick = around.brick[static_cast<std::size_t>(direction[q])];
        Around entry;
        if (around.kind(direction[q]) == Neighbour::kSame) {
            entry = same_level(brick, edge, cell[q], kLow[q][0] + 2 * kLow[q][1]);
        } else {
            // An absent region has no surface, so no crossed edge touches it.
            assert(around.kind(direction[q]) == Neighbour::kCoarser);
            entry = coarser(brick, edge, cell[q]);
        }
        if (entry.vertex == SurfaceCells::kAbsent) {
            ring.open = true;
            if (before_gap == 0) before_gap = ring.count;
            continue;
        }
        if (ring.count > 0 && is_same_cell(ring.cells[ring.count - 1], entry)) continue;
        if (q == 3 && is_same_cell(ring.cells[0], entry)) continue;
        ring.cells[ring.count++] = entry;
    }
    const auto present = std::span(ring.cells).first(ring.count);
    std::rotate(present.begin(), present.begin() + static_cast<std::ptrdiff_t>(before_gap), present.end());
    return ring;
}

EdgePolygons::Around EdgePolygons::same_level(std::uint32_t brick, const Edge& edge, glm::ivec3 cell, int side) const {
    Around entry;
    entry.brick = brick;
    entry.cell = cell_index(cell.x & 3, cell.y & 3, cell.z & 3);
    entry.level = octree_.bricks[brick].level;
    entry.crossing = edge_midpoint(4 * edge.axis + side) + (edge.walled && edge.upper ? kUpperEnd : 0);
    if (!surface_.cells[brick].crossed) { // a wall that only one of the two bricks knows of
        entry.vertex = SurfaceCells::kAbsent;
        return entry;
    }
    entry.recorded = surface_.is_recorded(brick, entry.cell);
    entry.vertex = surface_.vertex(octree_.bricks[brick], brick, entry.cell, entry.crossing);
    return entry;
}

// The cell of a coarser brick that covers `cell` (in cells of the edge's brick, possibly outside of it).
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
    entry.recorded = surface_.cells[brick].crossed;
    if (!entry.recorded) {
        entry.vertex = SurfaceCells::kAbsent;
        return entry;
    }
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
        // If a cell between them has no vertex, the two cells have only the edge in common.
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

EdgePolygons::Polygon EdgePolygons::polygon_of(std::span<const Around> ring, bool open) const {
    Polygon polygon;
    const bool any_arcs = std::ranges::any_of(ring, &Around::recorded);
    for (std::size_t n = 0; n < ring.size(); ++n) {
        polygon.vertices[polygon.count++] = ring[n].vertex;
        if (!any_arcs || (open && n + 1 == ring.size())) continue;
        const Around& next = ring[(n + 1) % ring.size()];
        const std::uint32_t between = arc_vertex(ring[n], next);
        if (between == kNoArcVertex) continue;
        polygon.vertices[polygon.count++] = between;
        polygon.extra = true;
    }
    return polygon;
}

// Between cells of different size, only a diagonal that ends in a cell of the edge's size belongs to no other polygon.
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

// A polygon with vertices on its arcs becomes a fan around a vertex at the crossing of its edge, so that no new edge
// coincides with an edge of another polygon. The same holds for an edge at which a wall ends, since its two sides meet
// there.
std::uint32_t EdgePolygons::add_centre(const Polygon& polygon, const Edge& edge, JoinedSubtree& out) const {
    const Brick& brick = octree_.bricks[edge.brick];
    const auto cell = static_cast<float>(octree_.lattice.cell_mm(brick.level));
    const glm::dvec3 corner = octree_.lattice.position(brick.corner);
    glm::vec3 sum(0.0F);
    for (const std::uint32_t v : polygon.span()) sum += glm::vec3(glm::dvec3(vertices_.positions[v]) - corner);
    glm::vec3 middle = glm::vec3(edge.point) * cell;
    middle[edge.axis] += 0.5F * cell;
    const glm::vec3 guess = sum / static_cast<float>(polygon.count);
    const auto number = static_cast<std::uint32_t>(out.guesses.size());
    out.guesses.add(guess, middle, 0.6F * cell);
    out.owned.push_back({number});
    glm::ivec3 inside = edge.point;
    if (edge.upper) ++inside[edge.axis];
    out.inside.push_back(lattice_point(inside));
    return kAddedBit | static_cast<std::uint32_t>(out.added.count + number);
}

std::uint32_t EdgePolygons::add_fan(const Ring& ring, const Edge& edge, JoinedSubtree& out) const {
    const Polygon polygon = polygon_of(ring.span(), ring.open);
    const std::uint32_t centre = add_centre(polygon, edge, out);
    emit_fan(centre, polygon, ring.open, out);
    return centre;
}

void EdgePolygons::emit_fan(std::uint32_t centre, const Polygon& polygon, bool open, JoinedSubtree& out) {
    for (std::size_t n = 0; n + (open ? 1 : 0) < polygon.count; ++n)
        out.triangles.emplace_back(centre, polygon.vertices[n], polygon.vertices[(n + 1) % polygon.count]);
}

// Finds the owners of the vertices on edges.
void EdgePolygons::find_owners(field::Separation& separation, std::uint32_t index, JoinedSubtree& out) const {
    std::vector<field::Owner> owners(out.owned.size(), field::kNoOwner);
    (void)separation.find_owners(lattice_axes(octree_.lattice, octree_.bricks[index]), out.inside, owners);
    for (std::size_t n = 0; n < owners.size(); ++n) out.owned[n].owner = owners[n];
}

void EdgePolygons::finish(std::uint32_t index, JoinedSubtree& out) const {
    if (out.guesses.size() == 0) return;
    const Brick& brick = octree_.bricks[index];
    field::BrickField& field = *fields_.local();
    field.enter(octree_.segments_of(brick), grid_axes(octree_.lattice, brick));
    if (auto* separation = field.separation()) find_owners(*separation, index, out);
    (void)append_projected(field, out.guesses, out.added, out.owned);
    out.guesses.clear();
    out.owned.clear();
    out.inside.clear();
}

} // namespace ramus::mesh::bricks
