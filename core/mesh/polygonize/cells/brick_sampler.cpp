#include "core/mesh/polygonize/cells/brick_sampler.h"

#include "core/mesh/polygonize/cells/hanging_corners.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <utility>

namespace ramus::mesh::bricks {

namespace {

constexpr float kSharedReach = 0.3F; // about its first guess, where a cell has several vertices

// A base-2 logarithm to 0.01, as in the guesses of plain cells.
float rough_log2(float value) {
    const auto bits = std::bit_cast<std::uint32_t>(std::max(value, 1e-8F));
    const float exponent = static_cast<float>(static_cast<int>(bits >> 23) - 127);
    const float m = std::bit_cast<float>((bits & 0x7FFFFFU) | 0x3F800000U);
    return exponent + (-0.33333333F * m + 2.0F) * m - 1.66666667F;
}

// Of each cell the grid point that is its low corner.
constexpr std::array<std::uint8_t, kCellsPerBrick> kLowCorners = [] {
    std::array<std::uint8_t, kCellsPerBrick> corners{};
    for (unsigned cell = 0; cell < kCellsPerBrick; ++cell)
        corners[cell] = static_cast<std::uint8_t>((cell & 3) + 5 * (cell >> 2 & 3) + 25 * (cell >> 4));
    return corners;
}();

// Of 4 x 4 x 4 bits, x + 4 y + 16 z, those with x = 0 as y + 4 z, and those with y = 0 as x + 4 z.
constexpr unsigned every_fourth(std::uint64_t b) {
    b &= 0x1111111111111111U;
    b = (b | b >> 3) & 0x0303030303030303U;
    b = (b | b >> 6) & 0x000F000F000F000FU;
    b = (b | b >> 12) & 0x000000FF000000FFU;
    return static_cast<unsigned>((b | b >> 24) & 0xFFFFU);
}
constexpr unsigned first_rows(std::uint64_t b) {
    b &= 0x000F000F000F000FU;
    b = (b | b >> 12) & 0x000000FF000000FFU;
    return static_cast<unsigned>((b | b >> 24) & 0xFFFFU);
}

constexpr glm::ivec3 place_of(int cell) { return {cell & 3, cell >> 2 & 3, cell >> 4}; }

} // namespace

void BrickSampler::begin(const field::ConvolutionField& field, const Octree& octree, const Tile& tile,
                         const ChunkedArray<Neighbourhood>& neighbours, SurfaceVertices& vertices) {
    field_ = &field;
    octree_ = &octree;
    all_neighbours_ = &neighbours;
    first_brick_ = tile.first_brick;
    brick_count_ = tile.brick_count;
    vertices_ = &vertices;
    first_vertex_ = vertices.count;
    isovalue_ = static_cast<float>(field.kernel().isovalue);
    if (own_.size() < tile.brick_count) own_.resize(tile.brick_count);
}

void BrickSampler::fill(std::uint32_t index, BrickCells& cells, TileCells& tile) {
    index_ = index;
    brick_ = &octree_->bricks[index];
    neighbours_ = &(*all_neighbours_)[index];
    place_brick();
    sample_own(tile);
    add_upper_sides(tile);
    add_upper_edges(tile);
    inside_ = assemble_bits();
    half_crossed_ = 0;
    if (neighbours_->finer != 0) sample_hanging(tile);

    constexpr GridBits kAll = (GridBits{1} << field::kGridPoints) - 1;
    cells.crossed = (inside_ != 0 && inside_ != kAll) || half_crossed_ != 0;
    if (!cells.crossed) return;
    if (neighbours_->finer == 0) assemble_values();
    cells.inside = {static_cast<std::uint64_t>(inside_), static_cast<std::uint64_t>(inside_ >> 64)};
    cells.first.fill(kNoVertex);
    cells.first_vertex = static_cast<std::uint32_t>(vertices_->count - first_vertex_);
    cells.first_record = static_cast<std::uint32_t>(tile.records.size());
    projection_.clear();
    sort_cells(cells);
    decide_face_centres(tile);
    for (const TracedCell& traced : traced_) {
        if (traced.loops.loop_count == 0) continue;
        cells.recorded |= std::uint64_t{1} << traced.cell;
        cells.first[static_cast<std::size_t>(traced.cell)] = static_cast<std::uint16_t>(projection_.size());
        add_recorded_vertices(traced, tile, tile.records.emplace_back());
    }
    tile.evaluations += append_projected(local_, projection_, *vertices_);
    tile.samples += projection_.size();
}

void BrickSampler::place_brick() {
    field::GridAxes axes;
    for (int n = 0; n < field::kGridSide; ++n) {
        const glm::dvec3 p = octree_->lattice.position(brick_->corner + glm::ivec3(n * cell_units(brick_->level)));
        const auto i = static_cast<std::size_t>(n);
        axes.x[i] = p.x, axes.y[i] = p.y, axes.z[i] = p.z;
    }
    cell_mm_ = static_cast<float>(octree_->lattice.cell_mm(brick_->level));
    lattice_ready_ = false;
    field::gather_segments(*field_, octree_->segments_of(*brick_), axes, local_);
}

void BrickSampler::sample(unsigned groups, TileCells& tile) {
    if (groups == 0) return;
    tile.evaluations += field::sample_groups(local_, groups, samples_);
    tile.samples += field::kGroupPoints * static_cast<std::uint64_t>(std::popcount(groups));
}

void BrickSampler::sample_own(TileCells& tile) {
    sample(field::kOwnGroups, tile);
    OwnSamples& own = own_[index_ - first_brick_];
    std::memcpy(own.value.data(), samples_.value.data(), sizeof(own.value));
    std::memcpy(&own.inside, samples_.inside.data(), sizeof(own.inside));
}

BrickSampler::UpperPart BrickSampler::upper_part(int x, int y, int z) const {
    const int direction = direction_index(x, y, z);
    UpperPart part;
    switch (neighbours_->kind(direction)) {
    case Neighbour::kSame: {
        const std::uint32_t place = neighbours_->brick[static_cast<std::size_t>(direction)] - first_brick_;
        if (place < brick_count_) part.neighbour = &own_[place]; // of the same tile
        break;
    }
    case Neighbour::kAbsent:
        part.known = true;
        part.full = (neighbours_->full >> direction & 1U) != 0;
        break;
    default:
        break;
    }
    return part;
}

// The points on the upper sides: groups 4 to 6. Sampled where nobody has done so yet, unless their side of the surface
// is known and nothing next to them lies on the other.
void BrickSampler::add_upper_sides(TileCells& tile) {
    const std::uint64_t own = own_[index_ - first_brick_].inside;
    unsigned wanted = 0;
    const auto add = [&](std::size_t group, const UpperPart& part, unsigned beside, auto values, auto bits) {
        if (part.neighbour != nullptr) {
            values(part.neighbour->value.data(), samples_.value[group].data());
            samples_.inside[group] = static_cast<std::uint16_t>(bits(part.neighbour->inside));
        } else if (part.known && beside == (part.full ? 0xFFFFU : 0U)) {
            samples_.value[group].fill(part.full ? 1.0F : 0.0F);
            samples_.inside[group] = static_cast<std::uint16_t>(beside);
        } else {
            wanted |= 1U << group;
        }
    };
    add(
        4, upper_part(1, 0, 0), every_fourth(own >> 3),
        [](const float* from, float* to) {
            for (int n = 0; n < 16; ++n) to[n] = from[4 * n];
        },
        [](std::uint64_t bits) { return every_fourth(bits); });
    add(
        5, upper_part(0, 1, 0), first_rows(own >> 12),
        [](const float* from, float* to) {
            for (int z = 0; z < 4; ++z) std::copy_n(from + 16 * z, 4, to + 4 * z);
        },
        [](std::uint64_t bits) { return first_rows(bits); });
    add(
        6, upper_part(0, 0, 1), static_cast<unsigned>(own >> 48),
        [](const float* from, float* to) { std::copy_n(from, 16, to); },
        [](std::uint64_t bits) { return static_cast<unsigned>(bits & 0xFFFF); });
    sample(wanted, tile);
}

// The points on the upper edges and the upper corner: group 7, by the same rule.
void BrickSampler::add_upper_edges(TileCells& tile) {
    constexpr std::size_t kGroup = 7;
    const unsigned side_x = samples_.inside[4];
    const unsigned side_y = samples_.inside[5];
    const unsigned side_z = samples_.inside[6];
    auto& values = samples_.value[kGroup];
    unsigned bits = 0;
    bool sampled = false;
    // The part's `count` points, every `stride`-th of the neighbour's own from the first on.
    const auto add = [&](const UpperPart& part, unsigned beside, unsigned first, unsigned count, unsigned stride) {
        const unsigned all = (1U << count) - 1;
        if (part.neighbour != nullptr) {
            for (unsigned n = 0; n < count; ++n) {
                values[first + n] = part.neighbour->value[stride * n];
                bits |= static_cast<unsigned>(part.neighbour->inside >> (stride * n) & 1) << (first + n);
            }
        } else if (part.known && beside == (part.full ? all | all << 4 : 0U)) {
            for (unsigned n = 0; n < count; ++n) values[first + n] = part.full ? 1.0F : 0.0F;
            bits |= (part.full ? all : 0U) << first;
        } else {
            sampled = true;
        }
    };
    add(upper_part(0, 1, 1), (side_y >> 12) | (side_z >> 12) << 4, 0, 4, 1);
    add(upper_part(1, 0, 1), (side_x >> 12) | every_fourth(side_z >> 3) << 4, 4, 4, 4);
    add(upper_part(1, 1, 0), every_fourth(side_x >> 3) | every_fourth(side_y >> 3) << 4, 8, 4, 16);
    if (!sampled) {
        const unsigned ends = bits >> 3 & bits >> 7 & bits >> 11 & 1U; // of the edges, next to the corner
        const unsigned some = (bits >> 3 | bits >> 7 | bits >> 11) & 1U;
        add(upper_part(1, 1, 1), ends == some ? ends | ends << 4 : 2U, 12, 1, 1);
    }
    samples_.inside[kGroup] = static_cast<std::uint16_t>(bits);
    if (sampled) sample(1U << kGroup, tile);
}

GridBits BrickSampler::assemble_bits() const {
    const std::uint64_t own = own_[index_ - first_brick_].inside;
    const unsigned side_x = samples_.inside[4];
    const unsigned side_y = samples_.inside[5];
    const unsigned edges = samples_.inside[7];
    // 4 x 4 bits to rows of 5; 4 bits to a column.
    const auto rows = [](unsigned b) { return (b & 0xFU) | (b & 0xF0U) << 1 | (b & 0xF00U) << 2 | (b & 0xF000U) << 3; };
    const auto column = [](unsigned b) { return ((b & 1U) | (b & 2U) << 4 | (b & 4U) << 8 | (b & 8U) << 12) << 4; };
    GridBits bits =
        GridBits{rows(samples_.inside[6]) | column(edges >> 4 & 0xFU) | (edges & 0xFU) << 20 | (edges >> 12 & 1U) << 24}
        << 100;
    for (unsigned z = 0; z < 4; ++z) {
        const unsigned layer = rows(static_cast<unsigned>(own >> (16 * z) & 0xFFFF)) |
                               column(side_x >> (4 * z) & 0xFU) | (side_y >> (4 * z) & 0xFU) << 20 |
                               (edges >> (8 + z) & 1U) << 24;
        bits |= GridBits{layer} << (25 * z);
    }
    return bits;
}

void BrickSampler::assemble_values() {
    const float* own = own_[index_ - first_brick_].value.data();
    const auto& [g0, g1, g2, g3, side_x, side_y, side_z, edges] = samples_.value;
    for (std::size_t z = 0; z < 4; ++z) {
        float* layer = values_.data() + 25 * z;
        for (std::size_t y = 0; y < 4; ++y) {
            std::memcpy(layer + 5 * y, own + 16 * z + 4 * y, 4 * sizeof(float));
            layer[5 * y + 4] = side_x[4 * z + y];
        }
        std::memcpy(layer + 20, side_y.data() + 4 * z, 4 * sizeof(float));
        layer[24] = edges[8 + z];
    }
    float* top = values_.data() + 100;
    for (std::size_t y = 0; y < 4; ++y) {
        std::memcpy(top + 5 * y, side_z.data() + 4 * y, 4 * sizeof(float));
        top[5 * y + 4] = edges[4 + y];
    }
    std::memcpy(top + 20, edges.data(), 4 * sizeof(float));
    top[24] = edges[12];
}

// Coordinates of the brick's points at quarter-cell spacing, which few bricks need.
void BrickSampler::prepare_lattice() {
    if (lattice_ready_) return;
    for (int n = 0; n < field::kLatticeSide; ++n) {
        const glm::dvec3 p = octree_->lattice.position(brick_->corner + glm::ivec3(n << brick_->level));
        const auto i = static_cast<std::size_t>(n);
        lattice_axes_.x[i] = p.x, lattice_axes_.y[i] = p.y, lattice_axes_.z[i] = p.z;
    }
    lattice_ready_ = true;
}

void BrickSampler::sample_points(TileCells& tile) {
    if (points_.empty()) return;
    prepare_lattice();
    point_values_.resize(points_.size());
    tile.evaluations += field::sample_lattice(local_, lattice_axes_, points_, point_values_);
    tile.samples += points_.size();
}

void BrickSampler::sample_hanging(TileCells& tile) {
    assemble_values();
    list_hanging_corners(neighbours_->finer, points_);
    sample_points(tile);
    for (std::size_t n = 0; n < points_.size(); ++n) {
        const int x = points_[n].i / 2; // quarter cells to half cells
        const int y = points_[n].j / 2;
        const int z = points_[n].k / 2;
        fine_values_[static_cast<std::size_t>(fine_index(x, y, z))] = point_values_[n];
        // The corner below a hanging corner belongs to all cells that touch it: where the two differ, a cell whose
        // corners agree is crossed nevertheless.
        const bool corner_inside = (inside_ >> (x / 2 + 5 * (y / 2) + 25 * (z / 2)) & 1) != 0;
        if ((point_values_[n] >= isovalue_) != corner_inside) half_crossed_ |= cells_touching(x, y, z);
    }
}

// Guesses the vertices of plain cells and traces the others, as far as that goes without their faces' centres.
void BrickSampler::sort_cells(BrickCells& cells) {
    const GridBits inside = inside_;
    const std::uint32_t finer = neighbours_->finer;
    GridBits some = 0;
    GridBits all = ~GridBits{0};
    for (const int shift : {0, 1, 5, 6, 25, 26, 30, 31}) some |= inside >> shift, all &= inside >> shift;
    const std::uint64_t hanging = finer != 0 ? cells_beside_finer(finer) : 0;
    std::uint64_t crossed = half_crossed_;
    for (unsigned row = 0; row < 16; ++row)
        crossed |= static_cast<std::uint64_t>((some & ~all) >> kLowCorners[4 * row] & 15U) << (4 * row);
    // Eight bytes from the one with a cell's low corner on hold all its corners.
    std::array<std::uint8_t, sizeof(inside) + sizeof(std::uint64_t)> bytes;
    std::memcpy(bytes.data(), &inside, sizeof(inside));
    traced_.clear();
    points_.clear();
    std::size_t plain_count = 0;
    for (; crossed != 0; crossed &= crossed - 1) {
        const auto cell = static_cast<unsigned>(std::countr_zero(crossed));
        const unsigned n = kLowCorners[cell];
        std::uint64_t at;
        std::memcpy(&at, bytes.data() + n / 8, sizeof(at));
        at >>= n % 8;
        const auto corner_signs =
            static_cast<unsigned>((at & 3U) | (at >> 3 & 0xCU) | (at >> 21 & 0x30U) | (at >> 24 & 0xC0U));
        const bool hangs = (hanging >> cell & 1) != 0;
        if (hangs || !kPlainCells[corner_signs]) {
            trace(static_cast<int>(cell), corner_signs, hangs ? finer : 0);
        } else {
            cells.first[cell] = static_cast<std::uint16_t>(plain_count);
            plain_corners_[plain_count++] = static_cast<std::uint8_t>(n);
        }
    }
    cells.recorded = 0;
    add_vertex_guesses(values_, isovalue_, std::span(plain_corners_).first(plain_count), cell_mm_, projection_);
}

void BrickSampler::trace(int cell, unsigned corner_signs, std::uint32_t finer) {
    TracedCell& traced = traced_.emplace_back();
    traced.cell = cell;
    traced.shape = split_shape(cell, finer);
    const glm::ivec3 low = 2 * place_of(cell);
    for (unsigned corner = 0; corner < 8; ++corner)
        traced.shape.inside |= (corner_signs >> corner & 1U)
                               << (2 * (corner & 1U) + 6 * (corner >> 1 & 1U) + 18 * (corner >> 2));
    if (finer != 0) {
        for (int n = 0; n < 27; ++n) {
            const glm::ivec3 at(n % 3, n / 3 % 3, n / 9);
            if (((at.x | at.y | at.z) & 1) == 0) continue;
            // Points that are no hanging corners hold stale values and are not looked at.
            const float value =
                fine_values_[static_cast<std::size_t>(fine_index(low.x + at.x, low.y + at.y, low.z + at.z))];
            traced.shape.inside |= static_cast<std::uint32_t>(value >= isovalue_ ? 1 : 0) << n;
        }
    }
    traced.loops = trace_loops(traced.shape, traced.centres);
    traced.first_centre = points_.size();
    for (int n = 0; n < traced.centres.count; ++n) {
        const int centre = traced.centres.centre[static_cast<std::size_t>(n)];
        points_.push_back({static_cast<std::uint8_t>(2 * low.x + centre % 5),
                           static_cast<std::uint8_t>(2 * low.y + centre / 5 % 5),
                           static_cast<std::uint8_t>(2 * low.z + centre / 25)});
    }
}

void BrickSampler::decide_face_centres(TileCells& tile) {
    if (points_.empty()) return;
    sample_points(tile);
    for (TracedCell& traced : traced_) {
        if (traced.centres.count == 0) continue;
        for (int n = 0; n < traced.centres.count; ++n)
            if (point_values_[traced.first_centre + static_cast<std::size_t>(n)] >= isovalue_)
                traced.centres.inside |= std::uint32_t{1} << n;
        traced.loops = trace_loops(traced.shape, traced.centres);
    }
}

void BrickSampler::add_vertex(glm::vec3 guess, glm::ivec3 cell, int vertices) {
    const glm::vec3 centre = (glm::vec3(cell) + 0.5F) * cell_mm_;
    // Where a cell has several vertices, each keeps to the neighbourhood of its own crossings: in one common box two of
    // them could end up at the same corner.
    if (vertices == 1)
        projection_.add(guess, centre, kVertexReach * cell_mm_);
    else
        projection_.add(guess, guess, kSharedReach * cell_mm_);
}

// At a point in half cells: a corner of a cell or a hanging one.
float BrickSampler::log_at(glm::ivec3 fine) const {
    const bool is_corner = ((fine.x | fine.y | fine.z) & 1) == 0;
    return rough_log2(is_corner ? values_[static_cast<std::size_t>(fine.x / 2 + 5 * (fine.y / 2) + 25 * (fine.z / 2))]
                                : fine_values_[static_cast<std::size_t>(fine_index(fine.x, fine.y, fine.z))]);
}

// Where the surface crosses a minimal edge, in cells within the brick.
glm::vec3 BrickSampler::crossing(glm::ivec3 cell, int edge_midpoint) const {
    // The ends of a minimal edge: one step along its axis for a half edge (odd coordinate), two for a whole one.
    const glm::ivec3 middle(edge_midpoint % 5, edge_midpoint / 5 % 5, edge_midpoint / 25);
    int axis = -1;
    int step = 1;
    for (int i = 0; i < 3; ++i)
        if ((middle[i] & 1) != 0) axis = i;
    if (axis < 0) {
        step = 2;
        for (int i = 0; i < 3; ++i)
            if (middle[i] == 2) axis = i;
    }
    glm::ivec3 a = middle;
    glm::ivec3 b = middle;
    a[axis] -= step;
    b[axis] += step;
    const float log_a = log_at(2 * cell + a / 2);
    const float log_b = log_at(2 * cell + b / 2);
    const float along =
        std::clamp((rough_log2(isovalue_) - log_a) / (log_b - log_a), kCrossingMargin, 1.0F - kCrossingMargin);
    return glm::vec3(cell) + 0.25F * (glm::vec3(a) + along * glm::vec3(b - a));
}

void BrickSampler::add_recorded_vertices(const TracedCell& traced, TileCells& tile, CellRecord& record) {
    const CellLoops& loops = traced.loops;
    const glm::ivec3 cell = place_of(traced.cell);
    record.loop_of = loops.loop_of;
    std::array<glm::vec3, kMostLoops> sum{};
    std::array<int, kMostLoops> count{};
    for (int m = 0; m < kQuarterPoints; ++m) {
        const std::uint8_t loop = loops.loop_of[static_cast<std::size_t>(m)];
        if (loop == kNoLoop) continue;
        sum[loop] += crossing(cell, m);
        ++count[loop];
    }
    for (std::size_t n = 0; n < static_cast<std::size_t>(loops.loop_count); ++n)
        add_vertex(sum[n] / static_cast<float>(count[n]) * cell_mm_, cell, loops.loop_count);

    // Arcs that need a vertex belong to the finer of the two cells, or the one on the negative side.
    record.arcs_begin = static_cast<std::uint32_t>(tile.arc_vertices.size());
    for (const FaceArc& arc : loops.shared_arcs) {
        const int axis = arc.face / 2;
        const int side = arc.face & 1;
        glm::ivec3 d(0);
        if (side == 0 && cell[axis] == 0) d[axis] = -1;
        if (side == 1 && cell[axis] == kBrickCells - 1) d[axis] = 1;
        const bool beyond_is_coarser = neighbours_->kind(direction_index(d.x, d.y, d.z)) == Neighbour::kCoarser;
        if (side == 0 && !beyond_is_coarser) continue;
        const auto vertex = static_cast<std::uint16_t>(projection_.size());
        add_vertex(0.5F * (crossing(cell, arc.first) + crossing(cell, arc.second)) * cell_mm_, cell, 2);
        tile.arc_vertices.push_back({arc.face, arc.first, vertex});
        tile.arc_vertices.push_back({arc.face, arc.second, vertex});
    }
    record.arcs_count = static_cast<std::uint32_t>(tile.arc_vertices.size()) - record.arcs_begin;
}

} // namespace ramus::mesh::bricks
