// ContactCells: in which cells of a brick surfaces are fans that stay in their cells (walled_cells.h), though no wall
// runs through them: those around contacts. So no triangles intersect there, neither beside walls nor where cells of
// different size meet.
#pragma once

#include "core/field/field.h"
#include "core/mesh/polygonize/octree/neighbours.h"

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <vector>

namespace ramus::mesh::bricks {

class ContactCells {
public:
    // The field must outlive it.
    explicit ContactCells(const field::Field& all) : all_(all) {}
    // The field is in the brick; it, the octree and the neighbours outlive the stay there.
    void begin(field::BrickField& field, const Octree& octree, std::uint32_t brick, const Neighbourhood& neighbours);

    // Whether something near a cell's middle is kept apart. Cells by their place in the brick, or one beyond it.
    [[nodiscard]] bool is_beside_contact(const glm::ivec3& cell);
    // `split`: finer cells touch it.
    [[nodiscard]] bool is_fanned(const glm::ivec3& cell, bool split);
    // Faces that are parts of coarser cells', a bit each; x-, x+, y-, ...
    [[nodiscard]] std::uint8_t coarser_faces(const glm::ivec3& cell) const;
    // Those of them whose coarser cell has fans.
    [[nodiscard]] std::uint8_t fanned_coarser_faces(const glm::ivec3& cell);

private:
    // A cell of the coarser brick in some direction.
    struct CoarserCell {
        int direction = 0;
        glm::ivec3 cell{0};
        bool fanned = false;
    };
    [[nodiscard]] static bool is_fanned_at_change(field::BrickField& field, const glm::ivec3& cell, float cell_mm);
    [[nodiscard]] bool is_coarser_fanned(int direction, const glm::ivec3& cell);

    static constexpr int kSide = 6; // cells of the brick, and one more all around
    const field::Field& all_;
    std::unique_ptr<field::BrickField> coarser_; // in a coarser brick, where it is asked
    field::BrickField* field_ = nullptr;
    const Octree* octree_ = nullptr;
    const Brick* brick_ = nullptr;
    const Neighbourhood* neighbours_ = nullptr;
    float cell_mm_ = 0.0F;
    std::array<std::int8_t, kSide * kSide * kSide> beside_{}; // -1: not known
    int coarser_in_ = -1;                                     // the direction of the brick that `coarser_` is in
    std::vector<CoarserCell> coarser_cells_;                  // those that are known
};

} // namespace ramus::mesh::bricks
