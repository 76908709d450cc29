#include "core/mesh/polygonize/cells/brick_owners.h"

#include "core/mesh/polygonize/cells/hanging_corners.h"

#include <algorithm>
#include <bit>

namespace ramus::mesh::bricks {

namespace {

std::size_t index_of(const field::LatticePoint& point) {
    return static_cast<std::size_t>(BrickOwners::fine_index(point.i / 2, point.j / 2, point.k / 2));
}

} // namespace

void BrickOwners::find(field::Separation& separation, const field::LatticeAxes& lattice, GridBits inside,
                       std::span<const field::LatticePoint> hanging, SampleCounts& counts) {
    owner_.fill(field::kNoOwner);
    points_.clear();
    for (GridBits left = inside; left != 0; left &= left - 1)
        points_.push_back(lattice_point(grid_point(lowest_bit(left))));
    points_.insert(points_.end(), hanging.begin(), hanging.end());
    owners_.resize(points_.size());
    counts.evaluations += separation.find_owners(lattice, points_, owners_);
    for (std::size_t n = 0; n < points_.size(); ++n) owner_[index_of(points_[n])] = owners_[n];
    find_pieces(separation);
    cells_ = hanging_ = 0;
    walls_ = {};
    if (any_apart_) find_walls(inside, hanging);
}

// Numbers the pieces and fills in the matrix once, since it is looked up for many points of many cells.
void BrickOwners::find_pieces(const field::Separation& separation) {
    piece_.fill(0);
    pieces_.assign(1, -1);
    field::Owner last = field::kNoOwner; // neighbours often have the same one
    Piece number = 0;
    for (std::size_t n = 0; n < points_.size(); ++n) {
        if (owners_[n] != last) {
            last = owners_[n];
            const auto known = std::ranges::find(pieces_, separation.piece_of(last));
            number = static_cast<Piece>(known - pieces_.begin());
            if (known == pieces_.end()) pieces_.push_back(separation.piece_of(last));
        }
        piece_[index_of(points_[n])] = number;
    }
    const std::size_t count = pieces_.size();
    apart_.assign(count * count, 0);
    any_apart_ = false;
    for (std::size_t a = 1; a < count; ++a)
        for (std::size_t b = 1; b < count; ++b)
            if (a != b && separation.apart_pieces(pieces_[a], pieces_[b])) apart_[a * count + b] = 1, any_apart_ = true;
}

void BrickOwners::find_walls(GridBits inside, std::span<const field::LatticePoint> hanging) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        for (GridBits left = inside & inside >> kGridStep[axis] & kEdgeStarts[axis]; left != 0; left &= left - 1) {
            const int n = lowest_bit(left);
            const glm::ivec3 p = 2 * grid_point(n);
            const Piece first = piece_at(p.x, p.y, p.z);
            glm::ivec3 q = p;
            q[static_cast<int>(axis)] += 2;
            if (!apart(first, piece_at(q.x, q.y, q.z))) continue;
            walls_[axis] |= GridBits{1} << n;
            q[static_cast<int>(axis)] -= 1;
            cells_ |= cells_touching(q.x, q.y, q.z);
        }
    }
    for (const field::LatticePoint& point : hanging) {
        const glm::ivec3 p(point.i / 2, point.j / 2, point.k / 2);
        // The corner below belongs to all cells that touch the point.
        if (apart(piece_at(p.x, p.y, p.z), piece_at(p.x & ~1, p.y & ~1, p.z & ~1)))
            hanging_ |= cells_touching(p.x, p.y, p.z);
    }
    cells_ |= hanging_;
}

BrickOwners::CellPieces BrickOwners::pieces_in(glm::ivec3 cell) const {
    CellPieces found;
    for (int n = 0; n < 27; ++n) {
        const Piece piece = piece_at(2 * cell.x + n % 3, 2 * cell.y + n / 3 % 3, 2 * cell.z + n / 9);
        if (piece == 0) continue;
        std::size_t at = 0;
        while (at < found.count && found.piece[at] != piece) ++at;
        if (at == found.count) found.piece[found.count++] = piece;
        found.points[at] |= std::uint32_t{1} << n;
    }
    return found;
}

bool BrickOwners::find_apart(glm::ivec3 cell, ApartPoints& apart) const {
    if (!any_apart_) return false;
    const CellPieces pieces = pieces_in(cell);
    std::array<std::uint32_t, 27> others{}; // by piece
    std::uint32_t any = 0;
    for (std::size_t a = 0; a < pieces.count; ++a)
        for (std::size_t b = 0; b < a; ++b)
            if (this->apart(pieces.piece[a], pieces.piece[b])) {
                others[a] |= pieces.points[b], others[b] |= pieces.points[a];
                any |= pieces.points[a];
            }
    if (any == 0) return false;
    apart = {};
    for (std::size_t a = 0; a < pieces.count; ++a)
        for (std::uint32_t left = pieces.points[a]; left != 0; left &= left - 1)
            apart[static_cast<std::size_t>(std::countr_zero(left))] = others[a];
    return true;
}

std::uint32_t BrickOwners::apart_from(const field::Separation& separation, glm::ivec3 cell, field::Owner owner) const {
    if (owner == field::kNoOwner) return kAllPoints;
    const int own = separation.piece_of(owner);
    const CellPieces pieces = pieces_in(cell);
    std::uint32_t others = 0;
    for (std::size_t n = 0; n < pieces.count; ++n)
        if (separation.apart_pieces(own, pieces_[pieces.piece[n]])) others |= pieces.points[n];
    return others;
}

field::Owner BrickOwners::of_crossing(glm::ivec3 cell, int crossing) const {
    const auto [low, high] = ends_of_edge(crossing);
    const auto owner = [&](glm::ivec3 quarter) {
        return at(2 * cell.x + quarter.x / 2, 2 * cell.y + quarter.y / 2, 2 * cell.z + quarter.z / 2);
    };
    if (crossing >= kQuarterPoints) return owner(high);
    return owner(low) != field::kNoOwner ? owner(low) : owner(high);
}

} // namespace ramus::mesh::bricks
