#include "core/mesh/polygonize/cells/contact_cells.h"

#include "core/mesh/polygonize/octree/lattice.h"

namespace ramus::mesh::bricks {

void ContactCells::begin(field::BrickField& field, const Neighbourhood& neighbours, float cell_mm) {
    field_ = &field, neighbours_ = &neighbours, cell_mm_ = cell_mm;
    if (field.parts_vessels()) beside_.fill(-1);
}

bool ContactCells::is_beside_contact(const glm::ivec3& cell) {
    std::int8_t& known = beside_[static_cast<std::size_t>(cell.x + 1 + kSide * (cell.y + 1 + kSide * (cell.z + 1)))];
    if (known < 0) known = field_->is_beside_contact((glm::vec3(cell) + 0.5F) * cell_mm_) ? 1 : 0;
    return known != 0;
}

// Where cells of different size meet both have fans, or neither: the coarser one decides, whichever of them asks. A
// cell all of whose neighbours are beside the contact has fans too; those around it that are not keep their vertices
// within themselves.
bool ContactCells::is_fanned(const glm::ivec3& cell, bool split) {
    if (split && is_fanned_at_change(cell, 1)) return true;
    if (fanned_coarser_faces(cell) != 0) return true;
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
        glm::ivec3 beyond = cell;
        beyond[face / 2] += (face & 1) != 0 ? 1 : -1;
        if (is_fanned_at_change(beyond & ~1, 2)) fanned |= 1U << face; // coarser cells begin at even ones
    }
    return static_cast<std::uint8_t>(fanned);
}

// A cell that finer ones touch: whether something is kept apart beside it, or beside a finer one at its faces.
bool ContactCells::is_fanned_at_change(const glm::ivec3& low, int size) {
    const auto edge = static_cast<float>(size);
    const glm::vec3 middle = glm::vec3(low) + 0.5F * edge;
    const auto is_beside = [&](const glm::vec3& off) {
        return field_->is_beside_contact((middle + edge * off) * cell_mm_);
    };
    if (is_beside(glm::vec3(0.0F))) return true;
    for (int face = 0; face < 6; ++face)
        for (int quarter = 0; quarter < 4; ++quarter) {
            glm::vec3 off;
            off[face / 2] = (face & 1) != 0 ? 0.75F : -0.75F;
            off[(face / 2 + 1) % 3] = (quarter & 1) != 0 ? 0.25F : -0.25F;
            off[(face / 2 + 2) % 3] = (quarter & 2) != 0 ? 0.25F : -0.25F;
            if (is_beside(off)) return true;
        }
    return false;
}

} // namespace ramus::mesh::bricks
