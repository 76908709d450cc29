#include "core/mesh/polygonize/brick_sampler.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

namespace ramus::mesh::bricks {

namespace {

constexpr int kPointsPerFineStep = 2; // the lattice axes run in quarter cells

// Half the box around a cell's centre, in cells, that its vertex must stay in. A little beyond the cell: where the mean
// of the crossings lies off a bent surface the nearest point of it may be just outside.
constexpr float kVertexReach = 0.62F;
// First guesses keep this far, in edges, from corners: where the surface runs through a corner, the vertices of all
// cells around it would otherwise meet there.
constexpr float kCrossingMargin = 0.05F;
constexpr float kSharedReach = 0.3F; // about its first guess, where a cell has several

// ln F is nearly quadratic in the distance from the axis, so linear interpolation in it lands close to the surface.
// A base-2 logarithm to 0.01 is enough: Newton's method has the last word.
float log_field(float value) {
    const auto bits = std::bit_cast<std::uint32_t>(std::max(value, 1e-8F));
    const float exponent = static_cast<float>(static_cast<int>(bits >> 23) - 127);
    const float m = std::bit_cast<float>((bits & 0x7FFFFFU) | 0x3F800000U);
    return exponent + (-0.33333333F * m + 2.0F) * m - 1.66666667F;
}

// Cells of a brick that touch the neighbour in each direction.
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

// Cells on a face or an edge of the brick with finer cells beyond; at a corner alone nothing hangs.
std::uint64_t cells_beside_finer(const Neighbourhood& neighbours) {
    std::uint64_t cells = 0;
    for (std::size_t d = 0; d < kDirections; ++d) {
        const bool corner = d % 3 != 1 && d / 3 % 3 != 1 && d / 9 != 1;
        if (!corner && neighbours.kind[d] == Neighbour::kFiner) cells |= kTouchingCells[d];
    }
    return cells;
}

// From cell numbers to grid points.
GridBits spread(std::uint64_t cells) {
    GridBits bits = 0;
    for (int z = 0; z < kBrickCells && cells != 0; ++z)
        for (int y = 0; y < kBrickCells; ++y) bits |= GridBits{cells >> (4 * y + 16 * z) & 15U} << (5 * y + 25 * z);
    return bits;
}

// Cells that touch a point given in half cells.
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

// The inside of a face or an edge of the brick: its possible hanging corners (in quarter cells), and the directions
// whose being finer makes them real.
struct HangingRegion {
    std::vector<int> directions;
    std::vector<field::LatticePoint> points;
};

const std::vector<HangingRegion>& hanging_regions() {
    static const std::vector<HangingRegion> regions = [] {
        std::vector<HangingRegion> made;
        for (int d = 0; d < kDirections; ++d) {
            const int direction[3] = {d % 3 - 1, d / 3 % 3 - 1, d / 9 - 1};
            HangingRegion region;
            for (int m = 1; m < 8; ++m) {
                const int part = direction_index((m & 1) != 0 ? direction[0] : 0, (m & 2) != 0 ? direction[1] : 0,
                                                 (m & 4) != 0 ? direction[2] : 0);
                if (part != kSelf && std::ranges::find(region.directions, part) == region.directions.end())
                    region.directions.push_back(part);
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
                            region.points.push_back({static_cast<std::uint8_t>(kPointsPerFineStep * x),
                                                     static_cast<std::uint8_t>(kPointsPerFineStep * y),
                                                     static_cast<std::uint8_t>(kPointsPerFineStep * z)});
            if (d != kSelf && !region.points.empty()) made.push_back(std::move(region));
        }
        return made;
    }();
    return regions;
}

} // namespace

void BrickSampler::fill(const field::ConvolutionField& field, const BrickSet& set, const Brick& brick,
                        const Neighbourhood& neighbours, BrickCells& cells, BrickChunk& chunk) {
    isovalue_ = static_cast<float>(field.kernel().isovalue);
    cell_mm_ = static_cast<float>(set.lattice.cell_mm(brick.level));
    cells.first.fill(kNoVertex);
    sample(field, set, brick, neighbours, cells, chunk);
    cells.crossed = is_crossed(cells);
    if (!cells.crossed) return;

    for (std::size_t n = 0; n < field::kGridStride; ++n) logs_[n] = log_field(values_[n]);
    projection_.clear();
    projection_.origin = set.lattice.position(brick.corner);
    cells.first_vertex = static_cast<std::uint32_t>(chunk.positions.size());
    cells.first_record = static_cast<std::uint32_t>(chunk.records.size());
    const auto list = set.segments_of(brick);
    trace_cells(field, list, neighbours, cells, chunk);
    append_projected(field, list, projection_, chunk);
}

void BrickSampler::sample(const field::ConvolutionField& field, const BrickSet& set, const Brick& brick,
                          const Neighbourhood& neighbours, BrickCells& cells, BrickChunk& chunk) {
    const int quarter = 1 << brick.level; // lattice units
    for (int n = 0; n < field::kLatticeSide; ++n) {
        const glm::dvec3 p = set.lattice.position(brick.corner + glm::ivec3(n * quarter));
        const auto i = static_cast<std::size_t>(n);
        axes_.x[i] = p.x, axes_.y[i] = p.y, axes_.z[i] = p.z;
    }
    field::GridAxes grid;
    for (std::size_t n = 0; n < field::kGridSide; ++n)
        grid.x[n] = axes_.x[4 * n], grid.y[n] = axes_.y[4 * n], grid.z[n] = axes_.z[4 * n];
    const auto list = set.segments_of(brick);
    cells.inside = field::sample_grid(field, list, grid, values_);
    chunk.evaluations += static_cast<std::uint64_t>(list.size()) * field::kGridPoints;
    chunk.samples += field::kGridPoints;

    half_crossed_ = 0;
    hanging_ = std::ranges::find(neighbours.kind, Neighbour::kFiner) != neighbours.kind.end();
    if (hanging_) sample_hanging(field, list, neighbours, chunk);
}

void BrickSampler::sample_hanging(const field::ConvolutionField& field, std::span<const std::uint32_t> list,
                                  const Neighbourhood& neighbours, BrickChunk& chunk) {
    points_.clear();
    for (const HangingRegion& region : hanging_regions()) {
        const bool wanted = std::ranges::any_of(region.directions, [&](int d) {
            return neighbours.kind[static_cast<std::size_t>(d)] == Neighbour::kFiner;
        });
        if (wanted) points_.insert(points_.end(), region.points.begin(), region.points.end());
    }
    point_values_.resize(points_.size());
    field::sample_lattice(field, list, axes_, points_, point_values_);
    chunk.evaluations += static_cast<std::uint64_t>(list.size()) * points_.size();
    chunk.samples += points_.size();
    for (std::size_t n = 0; n < points_.size(); ++n) {
        const int x = points_[n].i / kPointsPerFineStep;
        const int y = points_[n].j / kPointsPerFineStep;
        const int z = points_[n].k / kPointsPerFineStep;
        fine_values_[static_cast<std::size_t>(fine_index(x, y, z))] = point_values_[n];
        // The corner below a hanging corner belongs to all cells that touch it: where the two differ, a cell whose
        // corners agree is crossed nevertheless.
        const bool corner_inside = values_[static_cast<std::size_t>(x / 2 + 5 * (y / 2) + 25 * (z / 2))] >= isovalue_;
        if ((point_values_[n] >= isovalue_) != corner_inside) half_crossed_ |= cells_touching(x, y, z);
    }
}

bool BrickSampler::is_crossed(const BrickCells& cells) const {
    const bool none = cells.inside[0] == 0 && cells.inside[1] == 0;
    const bool all =
        cells.inside[0] == ~std::uint64_t{0} && cells.inside[1] == (std::uint64_t{1} << (field::kGridPoints - 64)) - 1;
    if (!none && !all) return true;
    return half_crossed_ != 0;
}

CellShape BrickSampler::shape_of(int x, int y, int z, const Neighbourhood& neighbours) const {
    CellShape shape;
    const int cell[3] = {x, y, z};
    const auto finer = [&](int dx, int dy, int dz) {
        return neighbours.kind[static_cast<std::size_t>(direction_index(dx, dy, dz))] == Neighbour::kFiner;
    };
    // Where the cell's low and high sides lie on the brick's boundary.
    const auto outward = [&](int axis, int side) {
        return side == 0 ? (cell[axis] == 0 ? -1 : 0) : (cell[axis] == kBrickCells - 1 ? 1 : 0);
    };
    if (hanging_) {
        for (int face = 0; face < 6; ++face) {
            int d[3] = {0, 0, 0};
            d[face / 2] = outward(face / 2, face & 1);
            if (d[face / 2] != 0 && finer(d[0], d[1], d[2])) shape.split_faces |= static_cast<std::uint8_t>(1 << face);
        }
        for (int edge = 0; edge < 12; ++edge) {
            const int u = (edge / 4 + 1) % 3;
            const int v = (edge / 4 + 2) % 3;
            const int du = outward(u, edge & 1);
            const int dv = outward(v, edge >> 1 & 1);
            for (int m = 1; m < 4; ++m) {
                int d[3] = {0, 0, 0};
                d[u] = (m & 1) != 0 ? du : 0;
                d[v] = (m & 2) != 0 ? dv : 0;
                if ((d[u] != 0 || d[v] != 0) && finer(d[0], d[1], d[2]))
                    shape.split_edges |= static_cast<std::uint16_t>(1 << edge);
            }
        }
    }
    for (int c = 0; c < 27; ++c) {
        const int cx = c % 3;
        const int cy = c / 3 % 3;
        const int cz = c / 9;
        bool inside = false;
        if (cx != 1 && cy != 1 && cz != 1)
            inside = values_[static_cast<std::size_t>(x + cx / 2 + 5 * (y + cy / 2) + 25 * (z + cz / 2))] >= isovalue_;
        else if (hanging_) // points that are no hanging corners hold stale values and are not looked at
            inside = is_inside(fine_index(2 * x + cx, 2 * y + cy, 2 * z + cz));
        shape.inside |= static_cast<std::uint32_t>(inside) << c;
    }
    return shape;
}

void BrickSampler::trace_cells(const field::ConvolutionField& field, std::span<const std::uint32_t> list,
                               const Neighbourhood& neighbours, BrickCells& cells, BrickChunk& chunk) {
    // Pass one: corner signs; cells that need tracing ask for the face centres they need.
    struct Pending {
        CellShape shape;
        CellLoops loops; // as they are when no face centre was asked for
        std::size_t first_centre, centre_count;
    };
    thread_local std::vector<Pending> pending;
    pending.clear();
    points_.clear();
    const GridBits inside = cells.grid_bits();
    GridBits some = 0;
    GridBits all = ~GridBits{0};
    for (const int shift : {0, 1, 5, 6, 25, 26, 30, 31}) some |= inside >> shift, all &= inside >> shift;
    const std::uint64_t hanging_cells = hanging_ ? cells_beside_finer(neighbours) : 0;
    std::uint64_t recorded = 0;
    std::uint64_t plain = 0;
    for (GridBits left = kCellCorners & ((some & ~all) | spread(half_crossed_)); left != 0; left &= left - 1) {
        const int n = lowest_bit(left);
        const int x = n % 5;
        const int y = n / 5 % 5;
        const int z = n / 25;
        const int cell = cell_index(x, y, z);
        const auto at = static_cast<unsigned>(inside >> n);
        const unsigned mask = (at & 3U) | (at >> 3 & 0xCU) | (at >> 21 & 0x30U) | (at >> 24 & 0xC0U);
        cells.mask[static_cast<std::size_t>(cell)] = static_cast<std::uint8_t>(mask);
        const bool hangs = (hanging_cells >> cell & 1U) != 0;
        if (!hangs && kCornerCases[mask].ambiguous_faces == 0) {
            plain |= std::uint64_t{1} << cell;
            continue;
        }
        const CellShape shape = shape_of(x, y, z, neighbours);
        const std::size_t first = points_.size();
        CellLoops loops = trace_loops(shape, [&](int centre) {
            points_.push_back({static_cast<std::uint8_t>(4 * x + centre % 5),
                               static_cast<std::uint8_t>(4 * y + centre / 5 % 5),
                               static_cast<std::uint8_t>(4 * z + centre / 25)});
            return false;
        });
        if (loops.loop_count == 0) continue;
        recorded |= std::uint64_t{1} << cell;
        pending.push_back({shape, std::move(loops), first, points_.size() - first});
    }
    point_values_.resize(points_.size());
    field::sample_lattice(field, list, axes_, points_, point_values_);
    chunk.evaluations += static_cast<std::uint64_t>(list.size()) * points_.size();
    chunk.samples += points_.size();

    // Pass two: vertices in the order of the cells.
    cells.recorded = recorded;
    std::size_t next = 0;
    for (std::uint64_t left = recorded | plain; left != 0; left &= left - 1) {
        const int cell = std::countr_zero(left);
        const int x = cell & 3;
        const int y = cell >> 2 & 3;
        const int z = cell >> 4;
        if ((recorded >> cell & 1U) != 0) {
            Pending& item = pending[next++]; // the same order: both run over ascending cells
            std::size_t answer = item.first_centre;
            if (item.centre_count > 0)
                item.loops = trace_loops(item.shape, [&](int) { return point_values_[answer++] >= isovalue_; });
            cells.first[static_cast<std::size_t>(cell)] = static_cast<std::uint16_t>(projection_.size());
            CellRecord record;
            add_recorded_vertices(x, y, z, item.loops, neighbours, cells, chunk, record);
            chunk.records.push_back(record);
            continue;
        }
        const CornerCase& corner_case = kCornerCases[cells.mask[static_cast<std::size_t>(cell)]];
        cells.first[static_cast<std::size_t>(cell)] = static_cast<std::uint16_t>(projection_.size());
        add_table_vertices(x, y, z, corner_case);
    }
}

void BrickSampler::add_vertex(glm::vec3 guess, int x, int y, int z, int loops) {
    const glm::vec3 centre = (glm::vec3(x, y, z) + 0.5F) * cell_mm_;
    // Where a cell has several loops, each vertex keeps to the neighbourhood of its own crossings: in one common box
    // two of them could end up at the same corner.
    if (loops == 1)
        projection_.add(guess, centre, kVertexReach * cell_mm_);
    else
        projection_.add(guess, guess, kSharedReach * cell_mm_);
}

void BrickSampler::add_table_vertices(int x, int y, int z, const CornerCase& corner_case) {
    std::array<glm::vec3, 4> sum{};
    std::array<int, 4> count{};
    const float log_iso = log_field(isovalue_);
    const float* logs = logs_.data() + x + 5 * y + 25 * z;
    constexpr std::array<int, 8> kCornerOffset{0, 1, 5, 6, 25, 26, 30, 31};
    for (std::size_t n = 0; n < corner_case.edge_count; ++n) {
        const std::size_t e = corner_case.crossed_edges[n];
        const std::uint8_t loop = corner_case.loop_of_edge[e];
        const EdgeGeometry& edge = kEdges[e];
        const float a = logs[kCornerOffset[edge.from]];
        const float b = logs[kCornerOffset[edge.to]];
        glm::vec3 at(edge.from & 1, edge.from >> 1 & 1, edge.from >> 2);
        at[static_cast<int>(e / 4)] = std::clamp((log_iso - a) / (b - a), kCrossingMargin, 1.0F - kCrossingMargin);
        sum[loop] += at;
        ++count[loop];
    }
    for (std::size_t n = 0; n < corner_case.loop_count; ++n)
        add_vertex((glm::vec3(x, y, z) + sum[n] / static_cast<float>(count[n])) * cell_mm_, x, y, z,
                   corner_case.loop_count);
}

glm::vec3 BrickSampler::crossing(int fine_a, int fine_b, glm::vec3 a, glm::vec3 b) const {
    const auto value = [&](int fine) {
        const int x = fine % kFineSide;
        const int y = fine / kFineSide % kFineSide;
        const int z = fine / (kFineSide * kFineSide);
        return ((x | y | z) & 1) == 0 ? logs_[static_cast<std::size_t>(x / 2 + 5 * (y / 2) + 25 * (z / 2))]
                                      : log_field(fine_values_[static_cast<std::size_t>(fine)]);
    };
    const float la = value(fine_a);
    const float lb = value(fine_b);
    return a + std::clamp((log_field(isovalue_) - la) / (lb - la), kCrossingMargin, 1.0F - kCrossingMargin) * (b - a);
}

void BrickSampler::add_recorded_vertices(int x, int y, int z, const CellLoops& loops, const Neighbourhood& neighbours,
                                         BrickCells& cells, BrickChunk& chunk, CellRecord& record) {
    record.loop_of = loops.loop_of;
    std::array<glm::vec3, kQuarterPoints> at{}; // crossing of each minimal edge, in cells within the brick
    std::vector<glm::vec3> sum(static_cast<std::size_t>(loops.loop_count), glm::vec3(0.0F));
    std::vector<int> count(static_cast<std::size_t>(loops.loop_count), 0);
    for (int m = 0; m < kQuarterPoints; ++m) {
        const std::uint8_t loop = loops.loop_of[static_cast<std::size_t>(m)];
        if (loop == kNoLoop) continue;
        // The ends of a minimal edge: one step along its axis for a half edge (odd coordinate), two for a whole one.
        const int c[3] = {m % 5, m / 5 % 5, m / 25};
        int axis = -1;
        int step = 1;
        for (int i = 0; i < 3; ++i)
            if ((c[i] & 1) != 0) axis = i;
        if (axis < 0) {
            step = 2;
            for (int i = 0; i < 3; ++i)
                if (c[i] == 2) axis = i;
        }
        int a[3] = {c[0], c[1], c[2]};
        int b[3] = {c[0], c[1], c[2]};
        a[axis] -= step;
        b[axis] += step;
        const auto fine = [&](const int* p) {
            return fine_index(2 * x + p[0] / 2, 2 * y + p[1] / 2, 2 * z + p[2] / 2);
        };
        const auto place = [&](const int* p) { return glm::vec3(x, y, z) + 0.25F * glm::vec3(p[0], p[1], p[2]); };
        at[static_cast<std::size_t>(m)] = crossing(fine(a), fine(b), place(a), place(b));
        sum[loop] += at[static_cast<std::size_t>(m)];
        ++count[loop];
    }
    for (std::size_t n = 0; n < sum.size(); ++n)
        add_vertex(sum[n] / static_cast<float>(count[n]) * cell_mm_, x, y, z, loops.loop_count);

    // Arcs that need a vertex belong to the finer of the two cells, or the one on the negative side.
    record.arcs_begin = static_cast<std::uint32_t>(chunk.arc_vertices.size());
    const int cell[3] = {x, y, z};
    for (const FaceArc& arc : loops.shared_arcs) {
        const int axis = arc.face / 2;
        const int side = arc.face & 1;
        int d[3] = {0, 0, 0};
        if (side == 0 && cell[axis] == 0) d[axis] = -1;
        if (side == 1 && cell[axis] == kBrickCells - 1) d[axis] = 1;
        const bool beyond_is_coarser =
            neighbours.kind[static_cast<std::size_t>(direction_index(d[0], d[1], d[2]))] == Neighbour::kCoarser;
        if (side == 0 && !beyond_is_coarser) continue;
        const auto vertex = static_cast<std::uint16_t>(projection_.size());
        add_vertex(0.5F * (at[arc.first] + at[arc.second]) * cell_mm_, x, y, z, 2);
        chunk.arc_vertices.push_back({arc.face, arc.first, vertex});
        chunk.arc_vertices.push_back({arc.face, arc.second, vertex});
    }
    record.arcs_count = static_cast<std::uint32_t>(chunk.arc_vertices.size()) - record.arcs_begin;
}

} // namespace ramus::mesh::bricks
