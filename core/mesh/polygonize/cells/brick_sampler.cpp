#include "core/mesh/polygonize/cells/brick_sampler.h"

#include "core/mesh/polygonize/cells/hanging_corners.h"
#include "core/mesh/polygonize/cells/vertex_guesses.h"

#include <algorithm>
#include <bit>
#include <cmath>
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

// From cell numbers to grid points.
GridBits spread(std::uint64_t cells) {
    GridBits bits = 0;
    for (int z = 0; z < kBrickCells && cells != 0; ++z)
        for (int y = 0; y < kBrickCells; ++y) bits |= GridBits{cells >> (4 * y + 16 * z) & 15U} << (5 * y + 25 * z);
    return bits;
}

constexpr glm::ivec3 place_of(int cell) { return {cell & 3, cell >> 2 & 3, cell >> 4}; }

} // namespace

void BrickSampler::fill(const field::ConvolutionField& field, const Octree& octree, const Brick& brick,
                        const Neighbourhood& neighbours, BrickCells& cells, BrickChunk& chunk) {
    isovalue_ = static_cast<float>(field.kernel().isovalue);
    cell_mm_ = static_cast<float>(octree.lattice.cell_mm(brick.level));
    for (int n = 0; n < field::kLatticeSide; ++n) {
        const glm::dvec3 p = octree.lattice.position(brick.corner + glm::ivec3(n << brick.level));
        const auto i = static_cast<std::size_t>(n);
        axes_.x[i] = p.x, axes_.y[i] = p.y, axes_.z[i] = p.z;
    }
    field::GridAxes grid;
    for (std::size_t n = 0; n < field::kGridSide; ++n)
        grid.x[n] = axes_.x[4 * n], grid.y[n] = axes_.y[4 * n], grid.z[n] = axes_.z[4 * n];
    const auto list = octree.segments_of(brick);
    cells.inside = field::sample_grid(field, list, grid, values_);
    chunk.evaluations += static_cast<std::uint64_t>(list.size()) * field::kGridPoints;
    chunk.samples += field::kGridPoints;
    half_crossed_ = 0;
    if (neighbours.finer != 0) sample_hanging(field, list, neighbours.finer, chunk);

    cells.crossed = is_crossed(cells, half_crossed_);
    if (!cells.crossed) return;
    cells.first.fill(kNoVertex);
    cells.first_vertex = static_cast<std::uint32_t>(chunk.positions.size());
    cells.first_record = static_cast<std::uint32_t>(chunk.records.size());
    projection_.clear();
    projection_.origin = octree.lattice.position(brick.corner);
    sort_cells(neighbours, cells);
    decide_face_centres(field, list, chunk);
    for (const TracedCell& traced : traced_) {
        if (traced.loops.loop_count == 0) continue;
        cells.recorded |= std::uint64_t{1} << traced.cell;
        cells.first[static_cast<std::size_t>(traced.cell)] = static_cast<std::uint16_t>(projection_.size());
        add_recorded_vertices(traced, neighbours, chunk, chunk.records.emplace_back());
    }
    append_projected(field, list, projection_, chunk);
}

void BrickSampler::sample_points(const field::ConvolutionField& field, std::span<const std::uint32_t> list,
                                 BrickChunk& chunk) {
    point_values_.resize(points_.size());
    field::sample_lattice(field, list, axes_, points_, point_values_);
    chunk.evaluations += static_cast<std::uint64_t>(list.size()) * points_.size();
    chunk.samples += points_.size();
}

void BrickSampler::sample_hanging(const field::ConvolutionField& field, std::span<const std::uint32_t> list,
                                  std::uint32_t finer, BrickChunk& chunk) {
    list_hanging_corners(finer, points_);
    sample_points(field, list, chunk);
    for (std::size_t n = 0; n < points_.size(); ++n) {
        const int x = points_[n].i / 2; // quarter cells to half cells
        const int y = points_[n].j / 2;
        const int z = points_[n].k / 2;
        fine_values_[static_cast<std::size_t>(fine_index(x, y, z))] = point_values_[n];
        // The corner below a hanging corner belongs to all cells that touch it: where the two differ, a cell whose
        // corners agree is crossed nevertheless.
        const bool corner_inside = values_[static_cast<std::size_t>(x / 2 + 5 * (y / 2) + 25 * (z / 2))] >= isovalue_;
        if ((point_values_[n] >= isovalue_) != corner_inside) half_crossed_ |= cells_touching(x, y, z);
    }
}

bool BrickSampler::is_crossed(const BrickCells& cells, std::uint64_t half_crossed) {
    const bool none = cells.inside[0] == 0 && cells.inside[1] == 0;
    const bool all =
        cells.inside[0] == ~std::uint64_t{0} && cells.inside[1] == (std::uint64_t{1} << (field::kGridPoints - 64)) - 1;
    return (!none && !all) || half_crossed != 0;
}

// Guesses the vertices of plain cells and traces the others, as far as that goes without their faces' centres.
void BrickSampler::sort_cells(const Neighbourhood& neighbours, BrickCells& cells) {
    const GridBits inside = cells.grid_bits();
    GridBits some = 0;
    GridBits all = ~GridBits{0};
    for (const int shift : {0, 1, 5, 6, 25, 26, 30, 31}) some |= inside >> shift, all &= inside >> shift;
    const GridBits hanging = neighbours.finer != 0 ? spread(cells_beside_finer(neighbours.finer)) : 0;
    const GridBits crossed = kCellCorners & ((some & ~all) | (half_crossed_ != 0 ? spread(half_crossed_) : 0));
    traced_.clear();
    points_.clear();
    std::size_t plain_count = 0;
    for (GridBits left = crossed; left != 0; left &= left - 1) {
        const int n = lowest_bit(left);
        const auto at = static_cast<unsigned>(inside >> n);
        const unsigned corner_signs = (at & 3U) | (at >> 3 & 0xCU) | (at >> 21 & 0x30U) | (at >> 24 & 0xC0U);
        const int z = n / 25;
        const int y = n / 5 - 5 * z;
        const int cell = cell_index(n - 5 * y - 25 * z, y, z);
        if ((hanging >> n & 1) != 0 || !kPlainCells[corner_signs]) {
            trace(cell, corner_signs, (hanging >> n & 1) != 0 ? neighbours.finer : 0);
        } else {
            cells.first[static_cast<std::size_t>(cell)] = static_cast<std::uint16_t>(plain_count);
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

void BrickSampler::decide_face_centres(const field::ConvolutionField& field, std::span<const std::uint32_t> list,
                                       BrickChunk& chunk) {
    if (points_.empty()) return;
    sample_points(field, list, chunk);
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

void BrickSampler::add_recorded_vertices(const TracedCell& traced, const Neighbourhood& neighbours, BrickChunk& chunk,
                                         CellRecord& record) {
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
    record.arcs_begin = static_cast<std::uint32_t>(chunk.arc_vertices.size());
    for (const FaceArc& arc : loops.shared_arcs) {
        const int axis = arc.face / 2;
        const int side = arc.face & 1;
        glm::ivec3 d(0);
        if (side == 0 && cell[axis] == 0) d[axis] = -1;
        if (side == 1 && cell[axis] == kBrickCells - 1) d[axis] = 1;
        const bool beyond_is_coarser = neighbours.kind(direction_index(d.x, d.y, d.z)) == Neighbour::kCoarser;
        if (side == 0 && !beyond_is_coarser) continue;
        const auto vertex = static_cast<std::uint16_t>(projection_.size());
        add_vertex(0.5F * (crossing(cell, arc.first) + crossing(cell, arc.second)) * cell_mm_, cell, 2);
        chunk.arc_vertices.push_back({arc.face, arc.first, vertex});
        chunk.arc_vertices.push_back({arc.face, arc.second, vertex});
    }
    record.arcs_count = static_cast<std::uint32_t>(chunk.arc_vertices.size()) - record.arcs_begin;
}

} // namespace ramus::mesh::bricks
