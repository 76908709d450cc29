#include "core/mesh/polygonize/cells/contact_cells.h"

#include "core/mesh/polygonize/cells/brick_cells.h"
#include "core/mesh/polygonize/octree/lattice.h"

namespace ramus::mesh::bricks {

void ContactCells::begin(field::BrickField& field, const Octree& octree, std::uint32_t brick,
                         const Neighbourhood& neighbours) {
    field_ = &field, octree_ = &octree, brick_ = &octree.bricks[brick], neighbours_ = &neighbours;
    cell_mm_ = static_cast<float>(octree.lattice.cell_mm(brick_->level));
    coarser_in_ = -1;
    coarser_cells_.clear();
    if (field.parts_vessels()) beside_.fill(-1);
}

bool ContactCells::is_beside_contact(const glm::ivec3& cell) {
    std::int8_t& known = beside_[static_cast<std::size_t>(cell.x + 1 + kSide * (cell.y + 1 + kSide * (cell.z + 1)))];
    if (known < 0) known = field_->is_beside_contact((glm::vec3(cell) + 0.5F) * cell_mm_) ? 1 : 0;
    return known != 0;
}

// Where cells of different size meet both have fans, or neither: the coarser one decides, as its own brick sees it,
// whichever of them asks. A cell all of whose neighbours are beside the contact has fans too; those around it that are
// not keep their vertices within themselves.
bool ContactCells::is_fanned(const glm::ivec3& cell, bool split) {
    if (split && is_fanned_at_change(*field_, cell, cell_mm_)) return true;
    if (coarser_faces(cell) != 0) return fanned_coarser_faces(cell) != 0;
    if (!is_beside_contact(cell)) return false;
    for (int n = 0; n < 27; ++n)
        if (!is_beside_contact(cell + glm::ivec3(n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1))) return false;
    return true;
}

std::uint8_t ContactCells::coarser_faces(const glm::ivec3& cell) const {
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

std::uint8_t ContactCells::fanned_coarser_faces(const glm::ivec3& cell) {
    const unsigned faces = coarser_faces(cell);
    unsigned fanned = 0;
    for (int face = 0; face < 6; ++face) {
        if ((faces >> face & 1) == 0) continue;
        glm::ivec3 step(0);
        step[face / 2] = (face & 1) != 0 ? 1 : -1;
        if (is_coarser_fanned(direction_index(step.x, step.y, step.z), cell + step)) fanned |= 1U << face;
    }
    return static_cast<std::uint8_t>(fanned);
}

// Of the coarser cell that covers a cell beyond the brick.
bool ContactCells::is_coarser_fanned(int direction, const glm::ivec3& cell) {
    const Brick& other = octree_->bricks[neighbours_->brick[static_cast<std::size_t>(direction)]];
    const glm::ivec3 corner = brick_->corner + cell * cell_units(brick_->level);
    const glm::ivec3 covering = (corner - other.corner) / cell_units(other.level);
    for (const CoarserCell& known : coarser_cells_)
        if (known.direction == direction && known.cell == covering) return known.fanned;
    if (coarser_ == nullptr) coarser_ = all_.in_brick();
    if (coarser_in_ != direction)
        coarser_->enter(octree_->segments_of(other), grid_axes(octree_->lattice, other)), coarser_in_ = direction;
    const auto cell_mm = static_cast<float>(octree_->lattice.cell_mm(other.level));
    const bool fanned = coarser_->parts_vessels() && is_fanned_at_change(*coarser_, covering, cell_mm);
    coarser_cells_.push_back({direction, covering, fanned});
    return fanned;
}

// A cell that finer ones touch: whether something is kept apart beside it, or beside a finer one at its faces.
bool ContactCells::is_fanned_at_change(field::BrickField& field, const glm::ivec3& cell, float cell_mm) {
    const glm::vec3 middle = glm::vec3(cell) + 0.5F;
    if (field.is_beside_contact(middle * cell_mm)) return true;
    for (int face = 0; face < 6; ++face)
        for (int quarter = 0; quarter < 4; ++quarter) {
            glm::vec3 off;
            off[face / 2] = (face & 1) != 0 ? 0.75F : -0.75F;
            off[(face / 2 + 1) % 3] = (quarter & 1) != 0 ? 0.25F : -0.25F;
            off[(face / 2 + 2) % 3] = (quarter & 2) != 0 ? 0.25F : -0.25F;
            if (field.is_beside_contact((middle + off) * cell_mm)) return true;
        }
    return false;
}

} // namespace ramus::mesh::bricks
