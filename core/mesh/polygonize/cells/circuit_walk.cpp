#include "core/mesh/polygonize/cells/circuit_walk.h"

#include <algorithm>
#include <glm/common.hpp>

namespace ramus::mesh::bricks {

namespace {

constexpr std::size_t kMostPartCircuits = 160; // a limit on the work; few cells rarely have so many circuits
constexpr std::size_t kMostSlitCircuits = 320;

constexpr std::uint64_t key_of(const CircuitPlace& circuit) {
    return std::uint64_t{circuit.brick} << 16 | static_cast<std::uint64_t>(circuit.cell) << 8 | circuit.number;
}

glm::ivec3 low_corner_of(const Brick& brick, int cell) {
    return brick.corner + glm::ivec3(cell & 3, cell >> 2 & 3, cell >> 4) * cell_units(brick.level);
}

} // namespace

void CircuitWalk::begin(const FilledSubtree& in) {
    in_ = &in;
    beyond_.clear();
    looked_far_ = false;
    for (auto& of_kind : others_) of_kind.clear();
}

CircuitWalk::Filled CircuitWalk::filled(std::uint32_t brick) {
    const Octree& octree = in_->octree;
    const auto from = [](const BrickCells& cells, const SubtreeCells& made, bool parted) {
        const std::size_t first = made.first_vertex + (cells.crossed ? cells.first_vertex : 0);
        return Filled{&cells, &made, std::span(made.vertices->radii).subspan(first), parted};
    };
    if (octree.bricks[brick].subtree == in_->index) {
        const bool parted = std::ranges::binary_search(in_->parted, brick, std::greater());
        return from(in_->cells[brick], in_->made, parted);
    }
    std::unique_ptr<Beyond>& there = beyond_[brick];
    if (there == nullptr) {
        there = std::make_unique<Beyond>();
        if (sampler_ == nullptr) sampler_ = std::make_unique<BrickSampler>(field_);
        there->made.vertices = &there->vertices;
        sampler_->begin(octree, brick, 1, there->vertices);
        sampler_->fill(brick, neighbourhood_of(octree, brick), there->cells, there->made);
        there->parted = sampler_->parts_vessels();
    }
    return from(there->cells, there->made, there->parted);
}

std::vector<CircuitEdge> CircuitWalk::edges_of(const CircuitPlace& circuit) {
    const Brick& brick = in_->octree.bricks[circuit.brick];
    const Filled there = filled(circuit.brick);
    const glm::ivec3 low = low_corner_of(brick, circuit.cell);
    std::vector<CircuitEdge> edges;
    const auto add = [&](int crossing) {
        const int quarter = crossing % kQuarterPoints;
        const auto [a, b] = ends_of_edge(crossing);
        CircuitEdge edge;
        edge.middle = low + (glm::ivec3(quarter % 5, quarter / 5 % 5, quarter / 25) << brick.level);
        const glm::ivec3 along = b - a;
        edge.axis = along.x != 0 ? 0 : along.y != 0 ? 1 : 2;
        edge.level = along[edge.axis] == 4 ? brick.level : brick.level - 1;
        edge.upper = crossing >= kUpperEnd;
        edges.push_back(edge);
    };
    if ((there.cells->recorded >> circuit.cell & 1U) != 0) {
        const CellRecord& record = record_of(*there.cells, *there.made, circuit.cell);
        for (int m = 0; m < kCrossings; ++m)
            if (circuit_of(record, *there.made, m) == circuit.number) add(m);
        return edges;
    }
    const GridBits inside = there.cells->grid_bits();
    const int corner = (circuit.cell & 3) + 5 * (circuit.cell >> 2 & 3) + 25 * (circuit.cell >> 4);
    for (int edge = 0; edge < 12; ++edge) {
        const auto [a, b] = ends_of_edge(edge_midpoint(edge));
        const auto is_inside = [&](const glm::ivec3& quarter) {
            const glm::ivec3 p = quarter / 4;
            return (inside >> (corner + p.x + 5 * p.y + 25 * p.z) & 1) != 0;
        };
        if (is_inside(a) != is_inside(b)) add(edge_midpoint(edge));
    }
    return edges;
}

// The circuit through an edge, in the cell that contains the cube `unit`.
std::optional<CircuitPlace> CircuitWalk::circuit_at(std::uint32_t brick, const glm::ivec3& unit,
                                                    const CircuitEdge& edge) {
    const Filled there = filled(brick);
    if (!there.cells->crossed) return std::nullopt;
    const Brick& in = in_->octree.bricks[brick];
    const glm::ivec3 cell = (unit - in.corner) / cell_units(in.level);
    CircuitPlace place{brick, cell_index(cell.x, cell.y, cell.z), 0};
    if (there.cells->first[static_cast<std::size_t>(place.cell)] == kNoVertex) return std::nullopt;
    if ((there.cells->recorded >> place.cell & 1U) == 0) return place;
    const glm::ivec3 quarter = (edge.middle - low_corner_of(in, place.cell)) >> glm::ivec3(in.level);
    const int crossing = quarter_index(quarter.x, quarter.y, quarter.z) + (edge.upper ? kUpperEnd : 0);
    place.number = circuit_of(record_of(*there.cells, *there.made, place.cell), *there.made, crossing);
    return place.number == kNoCircuit ? std::nullopt : std::optional(place);
}

bool CircuitWalk::is_along_walls(const Filled& there, const CircuitPlace& circuit) {
    if ((there.cells->recorded >> circuit.cell & 1U) == 0) return false;
    const CellRecord& record = record_of(*there.cells, *there.made, circuit.cell);
    return record.walls != kNoWalls && (circuits_along_walls(record, *there.made) >> circuit.number & 1U) != 0;
}

bool CircuitWalk::add(const CircuitPlace& circuit, Kind kind) {
    const Brick& brick = in_->octree.bricks[circuit.brick];
    const glm::ivec3 low = low_corner_of(brick, circuit.cell), high = low + cell_units(brick.level);
    low_ = part_.circuits.empty() ? low : glm::min(low_, low);
    high_ = part_.circuits.empty() ? high : glm::max(high_, high);
    least_level_ = part_.circuits.empty() ? brick.level : std::min(least_level_, brick.level);
    part_.most_level = std::max(part_.most_level, brick.level);
    part_.circuits.push_back(circuit);
    const glm::ivec3 size = high_ - low_;
    const bool slit = kind == Kind::kSlit;
    const int longest = std::max({size.x, size.y, size.z}), unit = cell_units(least_level_);
    if (longest > (slit ? kMostSlitCells : kMostCells) * unit) return false;
    if (part_.circuits.size() > (slit ? kMostSlitCircuits : kMostPartCircuits)) return false;
    if (others_[static_cast<std::size_t>(kind)].contains(key_of(circuit))) return false;
    looked_far_ = looked_far_ || longest > kMostCells * unit;
    const Filled there = filled(circuit.brick);
    if (slit && !is_along_walls(there, circuit)) return false;
    part_.parted = part_.parted && there.parted;
    part_.within = part_.within && brick.subtree == in_->index;
    const std::size_t vertex = std::size_t{there.cells->first[static_cast<std::size_t>(circuit.cell)]} + circuit.number;
    part_.most_radius = std::max(part_.most_radius, there.radii[vertex]);
    return true;
}

// Visits the subtree first, since bricks beyond must be computed.
const CircuitWalk::Part* CircuitWalk::part_of(const CircuitPlace& circuit, Kind kind) {
    part_ = {};
    beyond_edges_.clear();
    bool fits = add(circuit, kind);
    const auto go_on = [&](const CircuitEdge& edge, bool beyond) {
        for (int n = 0; n < 4 && fits; ++n) {
            const glm::ivec3 unit = unit_beside(edge, n);
            const std::uint32_t brick = brick_at(in_->octree, unit);
            if (brick == kNoBrick) continue;
            if ((in_->octree.bricks[brick].subtree != in_->index) != beyond) {
                if (!beyond) beyond_edges_.push_back(edge);
                fits = kind != Kind::kWithin;
                continue;
            }
            const auto there = circuit_at(brick, unit, edge);
            if (there && std::ranges::find(part_.circuits, *there) == part_.circuits.end()) fits = add(*there, kind);
        }
    };
    std::size_t next = 0;
    const auto go_through = [&] {
        for (; fits && next < part_.circuits.size(); ++next)
            for (const CircuitEdge& edge : edges_of(part_.circuits[next])) {
                if (std::ranges::find(part_.edges, edge) != part_.edges.end()) continue;
                part_.edges.push_back(edge);
                go_on(edge, false);
                if (!fits) break;
            }
    };
    go_through();
    while (fits && !beyond_edges_.empty()) {
        const CircuitEdge edge = beyond_edges_.back();
        beyond_edges_.pop_back();
        go_on(edge, true);
        go_through();
    }
    if (fits) return &part_;
    for (const CircuitPlace& of : part_.circuits) others_[static_cast<std::size_t>(kind)].insert(key_of(of));
    return nullptr;
}

} // namespace ramus::mesh::bricks
