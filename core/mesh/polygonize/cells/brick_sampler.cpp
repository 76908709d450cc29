#include "core/mesh/polygonize/cells/brick_sampler.h"

#include "core/mesh/polygonize/cells/hanging_corners.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <glm/common.hpp>

namespace ramus::mesh::bricks {

namespace {

constexpr float kSharedReach = 0.3F; // about its first guess, where a cell has several vertices

// The grid point at the low corner of each cell.
constexpr std::array<std::uint8_t, kCellsPerBrick> kLowCorners = [] {
    std::array<std::uint8_t, kCellsPerBrick> corners{};
    for (unsigned cell = 0; cell < kCellsPerBrick; ++cell)
        corners[cell] = static_cast<std::uint8_t>((cell & 3) + 5 * (cell >> 2 & 3) + 25 * (cell >> 4));
    return corners;
}();

constexpr glm::ivec3 low_corner_of(int cell) { return {cell & 3, cell >> 2 & 3, cell >> 4}; }

} // namespace

void BrickSampler::begin(const Octree& octree, std::uint32_t first_brick, std::uint32_t brick_count,
                         SurfaceVertices& vertices) {
    octree_ = &octree;
    vertices_ = &vertices;
    first_vertex_ = vertices.count;
    grid_.begin(first_brick, brick_count);
}

void BrickSampler::fill(std::uint32_t index, const Neighbourhood& neighbours, BrickCells& cells,
                        SubtreeCells& subtree) {
    brick_ = &octree_->bricks[index];
    neighbours_ = &neighbours;
    cell_mm_ = static_cast<float>(octree_->lattice.cell_mm(brick_->level));
    lattice_ready_ = false;
    field_->enter(octree_->segments_of(*brick_), grid_axes(octree_->lattice, *brick_));
    grid_.sample(index, *neighbours_, *field_, subtree.counts);
    half_crossed_ = 0;
    hanging_inside_.clear();
    owned_.clear();
    has_walled_cells_ = false;
    if (neighbours_->finer != 0) sample_hanging(subtree);
    separation_ = field_->separation();
    if (separation_ != nullptr) find_owners(subtree);

    constexpr GridBits kAll = (GridBits{1} << field::kGridPoints) - 1;
    const GridBits inside = grid_.inside();
    const bool walled = separation_ != nullptr && owners_.any_walls();
    cells.crossed = (inside != 0 && inside != kAll) || half_crossed_ != 0 || walled;
    if (!cells.crossed) return;
    cells.walls = walled ? static_cast<std::uint32_t>(subtree.walls.size()) : kNoWalls;
    if (walled) subtree.walls.push_back({owners_.walls(), {}});
    if (neighbours_->finer == 0) grid_.assemble_values();
    cells.inside = {static_cast<std::uint64_t>(inside), static_cast<std::uint64_t>(inside >> 64)};
    cells.first.fill(kNoVertex);
    cells.first_vertex = static_cast<std::uint32_t>(vertices_->count - first_vertex_);
    cells.first_record = static_cast<std::uint32_t>(subtree.records.size());
    guesses_.clear();
    sort_cells(cells);
    decide_face_centres(subtree);
    for (const TracedCell& traced : traced_) {
        if (traced.circuits.circuit_count == 0) continue;
        has_walled_cells_ |= traced.walled;
        cells.recorded |= std::uint64_t{1} << traced.cell;
        cells.first[static_cast<std::size_t>(traced.cell)] = static_cast<std::uint16_t>(guesses_.size());
        add_recorded_vertices(traced, subtree, subtree.records.emplace_back());
    }
    subtree.counts.evaluations += append_projected(*field_, guesses_, *vertices_, owned_);
    subtree.counts.samples += guesses_.size();
}

// Coordinates of the brick's points at quarter-cell spacing, which few bricks need.
void BrickSampler::prepare_lattice() {
    if (lattice_ready_) return;
    lattice_axes_ = lattice_axes(octree_->lattice, *brick_);
    lattice_ready_ = true;
}

void BrickSampler::sample_points(SubtreeCells& subtree) {
    if (points_.empty()) return;
    prepare_lattice();
    point_values_.resize(points_.size());
    subtree.counts.evaluations += field_->sample_lattice(lattice_axes_, points_, point_values_);
    subtree.counts.samples += points_.size();
}

void BrickSampler::sample_hanging(SubtreeCells& subtree) {
    grid_.assemble_values();
    list_hanging_corners(neighbours_->finer, points_);
    sample_points(subtree);
    for (std::size_t n = 0; n < points_.size(); ++n) {
        const int x = points_[n].i / 2; // quarter cells to half cells
        const int y = points_[n].j / 2;
        const int z = points_[n].k / 2;
        fine_values_[static_cast<std::size_t>(fine_index(x, y, z))] = point_values_[n];
        if (point_values_[n] >= isovalue_) hanging_inside_.push_back(points_[n]);
        // The grid point below a hanging corner belongs to all cells that touch the hanging corner. If their signs
        // differ, these cells are crossed even if all of their own corners have one sign.
        const bool corner_inside = (grid_.inside() >> (x / 2 + 5 * (y / 2) + 25 * (z / 2)) & 1) != 0;
        if ((point_values_[n] >= isovalue_) != corner_inside) half_crossed_ |= cells_touching(x, y, z);
    }
}

void BrickSampler::find_owners(SubtreeCells& subtree) {
    prepare_lattice();
    owners_.find(*separation_, lattice_axes_, grid_.inside(), hanging_inside_, subtree.counts);
    apart_points_.clear();
}

// Guesses the vertices of plain cells, and traces the circuits of other cells as far as possible without face centres.
void BrickSampler::sort_cells(BrickCells& cells) {
    const GridBits inside = grid_.inside();
    const std::uint32_t finer = neighbours_->finer;
    GridBits some = 0;
    GridBits all = ~GridBits{0};
    for (const int shift : {0, 1, 5, 6, 25, 26, 30, 31}) some |= inside >> shift, all &= inside >> shift;
    const std::uint64_t hanging = finer != 0 ? cells_beside_finer(finer) : 0;
    const std::uint64_t walled = separation_ != nullptr ? owners_.cells() : 0;
    std::uint64_t crossed = half_crossed_ | walled;
    for (unsigned row = 0; row < 16; ++row)
        crossed |= static_cast<std::uint64_t>((some & ~all) >> kLowCorners[4 * row] & 15U) << (4 * row);
    // The eight bytes that begin with a cell's low corner contain all of its corners.
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
        const bool general = hangs || !kPlainCells[corner_signs] || (walled >> cell & 1) != 0;
        if (general) {
            trace(static_cast<int>(cell), corner_signs, hangs ? finer : 0);
        } else {
            cells.first[cell] = static_cast<std::uint16_t>(plain_count);
            plain_corners_[plain_count++] = static_cast<std::uint8_t>(n);
        }
    }
    cells.recorded = 0;
    field_->find_depths(grid_.values(), depths_);
    add_vertex_guesses(depths_, std::span(plain_corners_).first(plain_count), cell_mm_, guesses_);
    if (separation_ == nullptr) return;
    for (std::uint32_t n = 0; n < plain_count; ++n) {
        const int low = plain_corners_[n];
        constexpr std::array<int, 8> kCornerOffset{0, 1, 5, 6, 25, 26, 30, 31};
        for (const int offset : kCornerOffset) {
            const int at = low + offset;
            if ((inside >> at & 1) == 0) continue;
            const glm::ivec3 p = 2 * grid_point(at);
            const field::Owner owner = owners_.at(p.x, p.y, p.z);
            if (owner == field::kNoOwner) break; // nothing is kept apart there, as in most cells
            owned_.push_back({n, owner});
            keep_within(owned_.back(), grid_point(low));
            break;
        }
    }
}

void BrickSampler::trace(int cell, unsigned corner_signs, std::uint32_t finer) {
    TracedCell& traced = traced_.emplace_back();
    traced.cell = cell;
    traced.shape = split_shape(cell, finer);
    const glm::ivec3 low = 2 * low_corner_of(cell);
    for (unsigned corner = 0; corner < 8; ++corner)
        traced.shape.inside |= (corner_signs >> corner & 1U)
                               << (2 * (corner & 1U) + 6 * (corner >> 1 & 1U) + 18 * (corner >> 2));
    if (finer != 0) {
        for (int n = 0; n < 27; ++n) {
            const glm::ivec3 at(n % 3, n / 3 % 3, n / 9);
            if (((at.x | at.y | at.z) & 1) == 0) continue;
            // Points that are no hanging corners have stale values, which are not used.
            const float value =
                fine_values_[static_cast<std::size_t>(fine_index(low.x + at.x, low.y + at.y, low.z + at.z))];
            traced.shape.inside |= static_cast<std::uint32_t>(value >= isovalue_ ? 1 : 0) << n;
        }
    }
    traced.apart = -1;
    ApartPoints apart;
    traced.walled = separation_ != nullptr && owners_.find_apart(low_corner_of(cell), apart);
    if (traced.walled) {
        traced.apart = static_cast<int>(apart_points_.size());
        apart_points_.push_back(apart);
    }
    traced.circuits = trace_circuits(traced.shape, traced.centres, apart_points(traced));
    traced.first_centre = points_.size();
    for (int n = 0; n < traced.centres.count; ++n) {
        const int centre = traced.centres.centre[static_cast<std::size_t>(n)];
        const glm::ivec3 quarter(centre % 5, centre / 5 % 5, centre / 25);
        points_.push_back({static_cast<std::uint8_t>(2 * low.x + quarter.x),
                           static_cast<std::uint8_t>(2 * low.y + quarter.y),
                           static_cast<std::uint8_t>(2 * low.z + quarter.z)});
    }
}

void BrickSampler::decide_face_centres(SubtreeCells& subtree) {
    if (points_.empty()) return;
    sample_points(subtree);
    for (TracedCell& traced : traced_) {
        if (traced.centres.count == 0) continue;
        for (int n = 0; n < traced.centres.count; ++n)
            if (point_values_[traced.first_centre + static_cast<std::size_t>(n)] >= isovalue_)
                traced.centres.inside |= std::uint32_t{1} << n;
        find_centres_vessels(traced, subtree);
        traced.circuits = trace_circuits(traced.shape, traced.centres, apart_points(traced));
    }
}

// Finds the owners of face centres that are inside, and the points that are apart from them.
void BrickSampler::find_centres_vessels(TracedCell& traced, SubtreeCells& subtree) {
    FaceCentres& centres = traced.centres;
    for (std::uint32_t left = centres.inside & centres.walled; left != 0; left &= left - 1) {
        const auto n = static_cast<std::size_t>(std::countr_zero(left));
        field::Owner owner = field::kNoOwner;
        subtree.counts.evaluations += separation_->find_owners(
            lattice_axes_, std::span(points_).subspan(traced.first_centre + n, 1), std::span(&owner, 1));
        centres.apart[n] = owners_.apart_from(*separation_, low_corner_of(traced.cell), owner);
    }
}

// Near contacts vertices stay within their cells, so that they do not enter cells with walls.
void BrickSampler::keep_within(field::OwnedGuess& vertex, glm::ivec3 cell) const {
    constexpr float kOff = 0.01F; // of a cell, its boundary
    vertex.lower = (glm::vec3(cell) + kOff) * cell_mm_;
    vertex.upper = (glm::vec3(cell) + 1.0F - kOff) * cell_mm_;
}

void BrickSampler::add_vertex(glm::vec3 guess, glm::ivec3 cell, bool alone, const field::OwnedGuess& whose) {
    const glm::vec3 centre = (glm::vec3(cell) + 0.5F) * cell_mm_;
    const bool free = whose.place == field::OwnedGuess::Place::kFree;
    if (separation_ != nullptr && !(free && whose.owner == field::kNoOwner)) {
        owned_.push_back(whose);
        owned_.back().guess = static_cast<std::uint32_t>(guesses_.size());
        if (free) keep_within(owned_.back(), cell);
    }
    // Each of several vertices of a cell stays near its own crossings: in a common box two vertices could be clamped to
    // the same corner.
    if (alone)
        guesses_.add(guess, centre, kVertexReach * cell_mm_);
    else
        guesses_.add(guess, guess, kSharedReach * cell_mm_);
}

// The value at a corner or hanging corner, given in half cells.
float BrickSampler::value_at(glm::ivec3 fine) const {
    const bool is_corner = ((fine.x | fine.y | fine.z) & 1) == 0;
    return is_corner ? grid_.values()[static_cast<std::size_t>(fine.x / 2 + 5 * (fine.y / 2) + 25 * (fine.z / 2))]
                     : fine_values_[static_cast<std::size_t>(fine_index(fine.x, fine.y, fine.z))];
}

// The share of its edge at which a crossing lies.
float BrickSampler::crossing_share(glm::ivec3 cell, int crossing) {
    const auto [a, b] = ends_of_edge(crossing);
    const float from = value_at(2 * cell + a / 2);
    const float to = value_at(2 * cell + b / 2);
    // A wall may be anywhere on its edge.
    const bool walled = (from >= isovalue_) == (to >= isovalue_);
    return walled ? 0.5F : std::clamp(field_->crossing(from, to), kCrossingMargin, 1.0F - kCrossingMargin);
}

// The position of a crossing, in cells of the brick.
glm::vec3 BrickSampler::crossing(glm::ivec3 cell, int crossing) {
    const auto [a, b] = ends_of_edge(crossing);
    return glm::vec3(cell) + 0.25F * (glm::vec3(a) + crossing_share(cell, crossing) * glm::vec3(b - a));
}

void BrickSampler::add_recorded_vertices(const TracedCell& traced, SubtreeCells& subtree, CellRecord& record) {
    const CellCircuits& circuits = traced.circuits;
    const glm::ivec3 cell = low_corner_of(traced.cell);
    std::copy_n(circuits.circuit_of.begin(), kQuarterPoints, record.circuit_of.begin());
    if (std::any_of(circuits.circuit_of.begin() + kUpperEnd, circuits.circuit_of.end(),
                    [](std::uint8_t circuit) { return circuit != kNoCircuit; })) {
        record.walls = static_cast<std::uint32_t>(subtree.upper_circuits.size());
        std::copy_n(circuits.circuit_of.begin() + kUpperEnd, kQuarterPoints,
                    subtree.upper_circuits.emplace_back().begin());
    }
    std::array<glm::vec3, kMostCircuits> sum{};
    std::array<int, kMostCircuits> count{};
    std::array<field::OwnedGuess, kMostCircuits> whose{};
    for (int m = 0; m < kCrossings; ++m) {
        const std::uint8_t circuit = circuits.circuit_of[static_cast<std::size_t>(m)];
        if (circuit == kNoCircuit) continue;
        sum[circuit] += crossing(cell, m);
        ++count[circuit];
        if (separation_ != nullptr) whose[circuit].owner = owners_.of_crossing(cell, m);
    }
    for (std::size_t n = 0; n < static_cast<std::size_t>(circuits.circuit_count); ++n)
        add_vertex(sum[n] / static_cast<float>(count[n]) * cell_mm_, cell, circuits.circuit_count == 1, whose[n]);

    record.arcs_begin = static_cast<std::uint32_t>(subtree.arc_vertices.size());
    for (const FaceArc& arc : circuits.own_arcs) {
        if (!owns(arc, cell)) continue;
        subtree.add_arc(arc, guesses_.size());
        add_vertex(0.5F * (crossing(cell, arc.first) + crossing(cell, arc.second)) * cell_mm_, cell, false,
                   whose[circuits.circuit_of[arc.first]]);
    }
    record.arcs_count = static_cast<std::uint32_t>(subtree.arc_vertices.size()) - record.arcs_begin;
}

// One bit per face of a cell (x-, x+, y-, ...): whether it is a part of a face of a coarser cell.
std::uint8_t BrickSampler::coarser_faces(const glm::ivec3& cell) const {
    unsigned faces = 0;
    for (int face = 0; face < 6 && neighbours_->coarser != 0; ++face) {
        const int axis = face / 2;
        if (cell[axis] != (face & 1) * (kBrickCells - 1)) continue;
        glm::ivec3 d(0);
        d[axis] = (face & 1) != 0 ? 1 : -1;
        if (neighbours_->kind(direction_index(d.x, d.y, d.z)) == Neighbour::kCoarser) faces |= 1U << face;
    }
    return static_cast<std::uint8_t>(faces);
}

// Arcs that need a vertex belong to the finer of the two cells, or the one on the negative side.
bool BrickSampler::owns(const FaceArc& arc, glm::ivec3 cell) const {
    return (arc.face & 1) != 0 || (coarser_faces(cell) >> arc.face & 1) != 0;
}

} // namespace ramus::mesh::bricks
