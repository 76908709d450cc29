#include "core/mesh/polygonize/cells/specks.h"

namespace ramus::mesh::bricks {

namespace {

// Points with another one beside them that is inside too and has no wall before it.
GridBits connected_points(GridBits inside, const std::array<GridBits, 3>& walls) {
    GridBits connected = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const GridBits pairs = inside & inside >> kGridStep[axis] & kEdgeStarts[axis] & ~walls[axis];
        connected |= pairs | pairs << kGridStep[axis];
    }
    return connected;
}

} // namespace

const std::vector<Speck>& Specks::find(const Octree& octree, const ChunkedArray<Neighbourhood>& neighbours,
                                       std::uint32_t index, GridBits inside, const std::array<GridBits, 3>& walls,
                                       SampleCounts& counts) {
    specks_.clear();
    for (GridBits left = inside & ~connected_points(inside, walls); left != 0; left &= left - 1) {
        const int n = lowest_bit(left);
        if (!list_bricks(octree, neighbours[index], index, grid_point(n))) continue;
        Beside beside;
        for (const Holder& in : bricks_) look_beside(octree, in, beside, counts);
        if (beside.parted && !beside.connected) specks_.push_back({n, beside.outside ? field::kNoOwner : beside.owner});
    }
    return specks_;
}

// Lists the bricks that a point belongs to. False where some are of another size, or of another subtree: those
// are not always made anew together.
bool Specks::list_bricks(const Octree& octree, const Neighbourhood& neighbours, std::uint32_t index, glm::ivec3 point) {
    bricks_.clear();
    const auto beyond = [&](int axis) { return point[axis] == 0 ? -1 : point[axis] == kBrickCells ? 1 : 0; };
    bricks_.push_back({index, point});
    for (int sides = 1; sides < 8; ++sides) {
        glm::ivec3 d(0);
        bool is_one = true;
        for (int axis = 0; axis < 3; ++axis) {
            if ((sides >> axis & 1) == 0) continue;
            d[axis] = beyond(axis);
            is_one = is_one && d[axis] != 0;
        }
        if (!is_one) continue;
        const int direction = direction_index(d.x, d.y, d.z);
        if (neighbours.kind(direction) != Neighbour::kSame) return false;
        const std::uint32_t brick = neighbours.brick[static_cast<std::size_t>(direction)];
        if (octree.bricks[brick].subtree != octree.bricks[index].subtree) return false;
        bricks_.push_back({brick, point - kBrickCells * d});
    }
    return true;
}

void Specks::look_beside(const Octree& octree, const Holder& in, Beside& beside, SampleCounts& counts) {
    const Brick& brick = octree.bricks[in.brick];
    if (in_brick_ == nullptr) in_brick_ = field_.in_brick();
    in_brick_->enter(octree.segments_of(brick), grid_axes(octree.lattice, brick));
    const bool parts_here = in_brick_->parts_vessels();
    beside.parted = beside.parted || parts_here;
    points_.clear();
    points_.push_back(lattice_point(in.point));
    for (int axis = 0; axis < 3; ++axis)
        for (const int step : {-1, 1}) {
            glm::ivec3 p = in.point;
            p[axis] += step;
            if (p[axis] >= 0 && p[axis] <= kBrickCells) points_.push_back(lattice_point(p));
        }
    const field::LatticeAxes lattice = lattice_axes(octree.lattice, brick);
    values_.resize(points_.size());
    counts.evaluations += in_brick_->sample_lattice(lattice, points_, values_);
    counts.samples += points_.size();
    owners_.assign(points_.size(), field::kNoOwner);
    if (parts_here) counts.evaluations += in_brick_->find_owners(lattice, points_, owners_);
    for (std::size_t n = 1; n < points_.size(); ++n) {
        if (values_[n] < isovalue_)
            beside.outside = true;
        else if (!parts_here || !in_brick_->apart(owners_[0], owners_[n]))
            beside.connected = true;
        else if (beside.owner == field::kNoOwner || owners_[n] < beside.owner)
            beside.owner = owners_[n];
    }
}

} // namespace ramus::mesh::bricks
