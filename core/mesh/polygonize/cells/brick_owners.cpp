#include "core/mesh/polygonize/cells/brick_owners.h"

#include "core/mesh/polygonize/cells/hanging_corners.h"

namespace ramus::mesh::bricks {

void BrickOwners::find(field::BrickField& field, const field::LatticeAxes& lattice, GridBits inside,
                       std::span<const field::LatticePoint> hanging, SampleCounts& counts) {
    owner_.fill(field::kNoOwner);
    points_.clear();
    for (GridBits left = inside; left != 0; left &= left - 1)
        points_.push_back(lattice_point(grid_point(lowest_bit(left))));
    points_.insert(points_.end(), hanging.begin(), hanging.end());
    owners_.resize(points_.size());
    counts.evaluations += field.find_owners(lattice, points_, owners_);
    for (std::size_t n = 0; n < points_.size(); ++n)
        owner_[static_cast<std::size_t>(fine_index(points_[n].i / 2, points_[n].j / 2, points_[n].k / 2))] = owners_[n];
    find_walls(field, inside, hanging);
}

void BrickOwners::find_walls(const field::BrickField& field, GridBits inside,
                             std::span<const field::LatticePoint> hanging) {
    cells_ = hanging_ = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        walls_[axis] = 0;
        for (GridBits left = inside & inside >> kGridStep[axis] & kEdgeStarts[axis]; left != 0; left &= left - 1) {
            const int n = lowest_bit(left);
            const glm::ivec3 p = 2 * grid_point(n);
            const field::Owner first = at(p.x, p.y, p.z);
            glm::ivec3 q = p;
            q[static_cast<int>(axis)] += 2;
            if (!field.apart(first, at(q.x, q.y, q.z))) continue;
            walls_[axis] |= GridBits{1} << n;
            q[static_cast<int>(axis)] -= 1;
            cells_ |= cells_touching(q.x, q.y, q.z);
        }
    }
    for (const field::LatticePoint& point : hanging) {
        const glm::ivec3 p(point.i / 2, point.j / 2, point.k / 2);
        // The corner below belongs to all cells that touch the point.
        const field::Owner own = at(p.x, p.y, p.z);
        if (field.apart(own, at(p.x & ~1, p.y & ~1, p.z & ~1))) hanging_ |= cells_touching(p.x, p.y, p.z);
    }
    cells_ |= hanging_;
}

ApartPoints BrickOwners::apart_points(const field::BrickField& field, glm::ivec3 cell) const {
    std::array<field::Owner, 27> owner;
    for (int n = 0; n < 27; ++n)
        owner[static_cast<std::size_t>(n)] = at(2 * cell.x + n % 3, 2 * cell.y + n / 3 % 3, 2 * cell.z + n / 9);
    ApartPoints apart{};
    for (std::size_t a = 0; a < 27; ++a)
        for (std::size_t b = a + 1; b < 27; ++b)
            if (owner[a] != owner[b] && field.apart(owner[a], owner[b]))
                apart[a] |= std::uint32_t{1} << b, apart[b] |= std::uint32_t{1} << a;
    return apart;
}

std::uint32_t BrickOwners::apart_from(const field::BrickField& field, glm::ivec3 cell, field::Owner owner) const {
    if (owner == field::kNoOwner) return kAllPoints;
    std::uint32_t others = 0;
    for (int n = 0; n < 27; ++n)
        if (field.apart(owner, at(2 * cell.x + n % 3, 2 * cell.y + n / 3 % 3, 2 * cell.z + n / 9)))
            others |= std::uint32_t{1} << n;
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
