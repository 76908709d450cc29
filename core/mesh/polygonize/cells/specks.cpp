#include "core/mesh/polygonize/cells/specks.h"

#include "core/field/separation.h"
#include "core/mesh/line_box.h"
#include "core/mesh/polygonize/cells/hanging_corners.h"
#include "core/mesh/polygonize/cells/leave_out_circuits.h"

#include <algorithm>
#include <functional>
#include <glm/vector_relational.hpp>

namespace ramus::mesh::bricks {

namespace {

constexpr GridBits kAllPoints = (GridBits{1} << field::kGridPoints) - 1;

// The points of a set, and the points of `of` that are adjacent to them without a wall between.
GridBits grown(GridBits points, GridBits of, const std::array<GridBits, 3>& walls) {
    GridBits beside = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const GridBits open = kEdgeStarts[axis] & ~walls[axis];
        beside |= (points & open) << kGridStep[axis] | (points >> kGridStep[axis] & open);
    }
    return points | (beside & of);
}

// The box around a set of a brick's points.
Bounds<glm::ivec3> box_around(GridBits points) {
    Bounds<glm::ivec3> box;
    for (GridBits left = points; left != 0; left &= left - 1) box.hold(grid_point(lowest_bit(left)));
    return box;
}

// Whether a set of points extends over at most kMostCells - 2 steps along every axis: a speck with the cells around it
// fits into kMostCells cells.
bool is_small(GridBits points) {
    constexpr int kMost = CircuitWalk::kMostCells - 2;
    return glm::all(glm::lessThanEqual(box_around(points).size(), glm::ivec3(kMost)));
}

// The points in rows of four along an axis without a wall between: most points of sets that are not small.
GridBits in_long_rows(GridBits points, const std::array<GridBits, 3>& walls) {
    GridBits rows = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const int step = kGridStep[axis];
        const GridBits pairs = points & points >> step & kEdgeStarts[axis] & ~walls[axis];
        const GridBits first = pairs & pairs >> step & pairs >> 2 * step;
        rows |= first | first << step | first << 2 * step | first << 3 * step;
    }
    return rows;
}

// All points of `of` that are connected to `points`.
GridBits connected(GridBits points, GridBits of, const std::array<GridBits, 3>& walls) {
    for (GridBits before = 0; before != points;) before = std::exchange(points, grown(points, of, walls));
    return points;
}

// Calls visit(points) for each small connected subset of `all`.
template <class Visit> void for_small_parts(GridBits all, const std::array<GridBits, 3>& walls, const Visit& visit) {
    for (GridBits left = all & ~connected(in_long_rows(all, walls), all, walls); left != 0;) {
        const GridBits part = connected(left & -left, all, walls);
        left &= ~part;
        if (is_small(part)) visit(part);
    }
}

// Whether a part of the surface encloses only the gap of a wall: the last crossing along an axis enters a vessel.
bool is_slit(const CircuitWalk::Part& part) {
    const int axis = part.edges.front().axis;
    const CircuitEdge* last = nullptr;
    const auto is_beyond = [&](const CircuitEdge& edge, const CircuitEdge& other) {
        return std::pair(edge.middle[axis], edge.upper) > std::pair(other.middle[axis], other.upper);
    };
    for (const CircuitEdge& edge : part.edges)
        if (edge.axis == axis && (last == nullptr || is_beyond(edge, *last))) last = &edge;
    return last->upper;
}

// Whether all points of a line in a brick without walls have the sign `inside`.
bool goes_on_among(const BrickCells& cells, const std::array<glm::ivec3, 4>& line, bool inside) {
    const GridBits bits = cells.grid_bits();
    return std::ranges::all_of(
        line, [&](const glm::ivec3& p) { return ((bits >> (p.x + 5 * p.y + 25 * p.z) & 1) != 0) == inside; });
}

} // namespace

// A quick test that rules out a speck around `points`: whether a straight line of connected points continues from one
// of them through the next brick. Most small sets in a brick are the end of a vessel in the next one. Also true if the
// test would have to look beyond the subtree, and `may_look_beyond` is false.
bool Specks::goes_on(const FilledSubtree& in, std::uint32_t brick, GridBits points, bool inside, bool may_look_beyond) {
    const Neighbourhood& around = in.neighbours[brick];
    for (GridBits left = points; left != 0; left &= left - 1) {
        const glm::ivec3 p = grid_point(lowest_bit(left));
        for (int axis = 0; axis < 3; ++axis) {
            if (p[axis] % kBrickCells != 0) continue;
            glm::ivec3 step(0);
            step[axis] = p[axis] == 0 ? -1 : 1;
            const int direction = direction_index(step.x, step.y, step.z);
            if (around.kind(direction) == Neighbour::kAbsent && inside == ((around.full >> direction & 1U) != 0))
                return true;
            if (around.kind(direction) != Neighbour::kSame) continue;
            const std::uint32_t next = around.brick[static_cast<std::size_t>(direction)];
            std::array<glm::ivec3, 4> line;
            for (int n = 0; n < 4; ++n) line[static_cast<std::size_t>(n)] = p + (n - kBrickCells) * step;
            const Brick& there = in.octree.bricks[next];
            if (there.subtree != in.index && !may_look_beyond) return true;
            if (there.subtree == in.index && in.cells[next].walls == kNoWalls) {
                if (!in.cells[next].crossed || goes_on_among(in.cells[next], line, inside)) return true;
            } else if (goes_on_in(in.octree, there, line, inside)) {
                return true;
            }
        }
    }
    return false;
}

// Whether all points of a line in a brick are connected: all outside, or all inside and of one vessel.
bool Specks::goes_on_in(const Octree& octree, const Brick& brick, const std::array<glm::ivec3, 4>& line, bool inside) {
    std::array<field::LatticePoint, 4> points;
    std::array<float, 4> values;
    for (std::size_t n = 0; n < 4; ++n) points[n] = lattice_point(line[n]);
    looked_beyond_ = true;
    beyond_->enter(octree.segments_of(brick), grid_axes(octree.lattice, brick));
    const field::LatticeAxes lattice = lattice_axes(octree.lattice, brick);
    (void)beyond_->sample_lattice(lattice, points, values);
    if (std::ranges::any_of(values, [&](float value) { return (value >= isovalue_) != inside; })) return false;
    field::Separation* separation = beyond_->separation();
    if (!inside || separation == nullptr) return true;
    std::array<field::Owner, 4> owners;
    (void)separation->find_owners(lattice, points, owners);
    for (std::size_t n = 1; n < 4; ++n)
        if (separation->apart(owners[n - 1], owners[n])) return false;
    return true;
}

// Circuits through half edges only go around hanging corners.
void Specks::add_around_hanging_corners(const BrickCells& cells, const SubtreeCells& made, std::uint32_t brick) {
    for (std::uint64_t left = cells.recorded; left != 0; left &= left - 1) {
        const int cell = std::countr_zero(left);
        if (cells.first[static_cast<std::size_t>(cell)] == kNoVertex) continue;
        const CellRecord& record = record_of(cells, made, cell);
        std::uint64_t seen = 0, whole = 0;
        for (int m = 0; m < kCrossings; ++m) {
            const std::uint8_t circuit = circuit_of(record, made, m);
            if (circuit == kNoCircuit) continue;
            seen |= std::uint64_t{1} << circuit;
            const auto [from, to] = ends_of_edge(m);
            const glm::ivec3 along = to - from;
            if (along.x + along.y + along.z == 4) whole |= std::uint64_t{1} << circuit;
        }
        for (std::uint64_t circuits = seen & ~whole; circuits != 0; circuits &= circuits - 1)
            candidates_.push_back({{brick, cell, static_cast<std::uint8_t>(std::countr_zero(circuits))}});
    }
}

// Whether the axis of a segment that reaches the brick passes through a box (lattice units).
bool Specks::has_axis(const Octree& octree, std::uint32_t brick, const Bounds<glm::ivec3>& box) const {
    const Bounds<glm::dvec3> place{octree.lattice.position(box.least), octree.lattice.position(box.most)};
    return std::ranges::any_of(octree.segments_of(octree.bricks[brick]), [&](std::uint32_t n) {
        const field::FieldSegment& s = skeleton_.segments()[n];
        const glm::dvec3 start(s.ax, s.ay, s.az);
        return line_meets_box(start, start + static_cast<double>(s.length) * glm::dvec3(s.ux, s.uy, s.uz), place);
    });
}

// Adds circuits with both crossings of an edge, where a wall ends, and circuits along walls only. So every brick that
// contains a part of a slit has a candidate for it.
void Specks::add_along_walls(const BrickCells& cells, const SubtreeCells& made, std::uint32_t brick) {
    for (std::uint64_t left = cells.recorded; left != 0; left &= left - 1) {
        const int cell = std::countr_zero(left);
        const CellRecord& record = record_of(cells, made, cell);
        if (record.walls == kNoWalls) continue;
        const auto& upper = made.upper_circuits[record.walls];
        for (std::size_t m = 0; m < kQuarterPoints; ++m)
            if (upper[m] != kNoCircuit && upper[m] == record.circuit_of[m])
                candidates_.push_back({{brick, cell, upper[m]}});
        for (std::uint64_t circuits = circuits_along_walls(record, made); circuits != 0; circuits &= circuits - 1)
            candidates_.push_back(
                {{brick, cell, static_cast<std::uint8_t>(std::countr_zero(circuits))}, CircuitWalk::Kind::kSlit});
    }
}

// A speck encloses a small connected set of points inside or outside, or is a slit: a wall that ends on all sides.
void Specks::list_candidates(const FilledSubtree& in, std::uint32_t brick, bool parted) {
    const BrickCells& cells = in.cells[brick];
    const SubtreeCells& made = in.made;
    candidates_.clear();
    const auto add_all_of = [&](int cell) {
        if (cells.first[static_cast<std::size_t>(cell)] == kNoVertex) return;
        if ((cells.recorded >> cell & 1U) == 0) return candidates_.push_back({{brick, cell, 0}});
        const CellRecord& record = record_of(cells, made, cell);
        std::uint64_t seen = 0;
        for (int m = 0; m < kCrossings; ++m) {
            const std::uint8_t circuit = circuit_of(record, made, m);
            if (circuit == kNoCircuit || (seen >> circuit & 1U) != 0) continue;
            seen |= std::uint64_t{1} << circuit;
            candidates_.push_back({{brick, cell, circuit}});
        }
    };
    const auto add_around = [&](GridBits points, bool inside) {
        if (goes_on(in, brick, points, inside, parted)) return;
        std::uint64_t touching = 0;
        for (GridBits left = points; left != 0; left &= left - 1) {
            const glm::ivec3 p = 2 * grid_point(lowest_bit(left));
            touching |= cells_touching(p.x, p.y, p.z);
        }
        for (; touching != 0; touching &= touching - 1) add_all_of(std::countr_zero(touching));
    };
    static constexpr std::array<GridBits, 3> kNone{};
    // A thin vessel away from others may be small, and is kept.
    const auto is_vessel = [&](GridBits points) {
        const Brick& at = in.octree.bricks[brick];
        const Bounds<glm::ivec3> box = box_around(points);
        const int cell = cell_units(at.level);
        return has_axis(in.octree, brick, {at.corner + cell * (box.least - 1), at.corner + cell * (box.most + 1)});
    };
    const GridBits inside = cells.grid_bits();
    for_small_parts(inside, cells.walls == kNoWalls ? kNone : made.walls[cells.walls].edges, [&](GridBits points) {
        if (parted || !is_vessel(points)) add_around(points, true);
    });
    for_small_parts(kAllPoints & ~inside, kNone, [&](GridBits points) { add_around(points, false); });
    if (in.neighbours[brick].finer != 0) add_around_hanging_corners(cells, made, brick);
    if (cells.walls != kNoWalls) add_along_walls(cells, made, brick);
}

bool Specks::is_speck(const Octree& octree, const CircuitWalk::Part& part, CircuitWalk::Kind kind) const {
    if (kind == CircuitWalk::Kind::kSlit) return is_slit(part);
    constexpr float kThinCells = 2.0F; // radius of a vessel that may be as small as a speck
    const auto cell_mm = static_cast<float>(octree.lattice.cell_mm(part.most_level));
    if (part.parted && part.most_radius >= kThinCells * cell_mm) return true;
    Bounds<glm::ivec3> box;
    for (const CircuitEdge& edge : part.edges) {
        glm::ivec3 half(0);
        half[edge.axis] = cell_units(edge.level) / 2;
        box.hold(edge.middle - half), box.hold(edge.middle + half);
    }
    return std::ranges::none_of(part.circuits,
                                [&](const CircuitPlace& circuit) { return has_axis(octree, circuit.brick, box); });
}

// Either all subtrees with a part of a speck remove it, or none does, since bricks that keep no vessels apart do not
// look beyond their subtree.
void Specks::find(const FilledSubtree& in) {
    circuits_.clear(), edges_.clear();
    walk_.begin(in);
    const Subtree& subtree = in.octree.subtrees[in.index];
    for (std::uint32_t brick = subtree.first_brick; brick < subtree.first_brick + subtree.brick_count; ++brick) {
        if (!in.cells[brick].crossed) continue;
        const bool parted = std::ranges::binary_search(in.parted, brick, std::greater());
        list_candidates(in, brick, parted);
        for (const auto& [circuit, of_walls] : candidates_) {
            if (std::ranges::find(circuits_, circuit) != circuits_.end()) continue;
            const CircuitWalk::Kind kind = parted ? of_walls : CircuitWalk::Kind::kWithin;
            const CircuitWalk::Part* const part = walk_.part_of(circuit, kind);
            if (part == nullptr || !(part->parted || part->within) || !is_speck(in.octree, *part, kind)) continue;
            circuits_.insert(circuits_.end(), part->circuits.begin(), part->circuits.end());
            edges_.insert(edges_.end(), part->edges.begin(), part->edges.end());
        }
    }
}

// Marks the edges of specks in every brick that contains them, even if none of its cells has a circuit there.
void Specks::mark_edges(const Octree& octree, std::uint32_t subtree, ChunkedArray<BrickCells>& cells,
                        SubtreeCells& made) const {
    for (const CircuitEdge& edge : edges_)
        for (int n = 0; n < 4; ++n) {
            const std::uint32_t index = brick_at(octree, unit_beside(edge, n));
            if (index == kNoBrick || octree.bricks[index].subtree != subtree) continue;
            const Brick& brick = octree.bricks[index];
            if (brick.level != edge.level || !cells[index].crossed) continue;
            glm::ivec3 first = edge.middle - brick.corner;
            first[edge.axis] -= cell_units(edge.level) / 2;
            first /= cell_units(edge.level);
            if (cells[index].walls == kNoWalls) {
                cells[index].walls = static_cast<std::uint32_t>(made.walls.size());
                made.walls.emplace_back();
            }
            const auto row = static_cast<std::size_t>(edge.axis + (edge.upper ? 3 : 0));
            made.walls[cells[index].walls].left_out[row] |= GridBits{1} << (first.x + 5 * first.y + 25 * first.z);
        }
}

void Specks::leave_out(const Octree& octree, std::uint32_t subtree, const ChunkedArray<Neighbourhood>& neighbours,
                       std::span<const std::uint32_t> parted, ChunkedArray<BrickCells>& cells, SubtreeCells& made,
                       SurfaceVertices& vertices) {
    looked_beyond_ = false;
    find({octree, subtree, neighbours, cells, made, parted});
    made.looked_beyond = looked_beyond_ || walk_.looked_beyond();
    made.looked_far = walk_.looked_far();
    if (circuits_.empty()) return;
    mark_edges(octree, subtree, cells, made);
    std::erase_if(circuits_,
                  [&](const CircuitPlace& circuit) { return octree.bricks[circuit.brick].subtree != subtree; });
    leave_out_circuits(octree.subtrees[subtree], circuits_, cells, made, vertices);
}

} // namespace ramus::mesh::bricks
