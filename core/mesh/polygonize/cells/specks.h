// Specks: single grid points inside the surface that are connected to no other one of their vessel. Beside a wall the
// region of a vessel may end in a ridge thinner than a cell; where its edge runs past a grid point this would become a
// piece of surface of its own.
//
// Such a point is taken for outside; where only other vessels are beside it, for a part of one of these.
#pragma once

#include "core/field/field.h"
#include "core/mesh/polygonize/cells/brick_cells.h"
#include "core/mesh/polygonize/cells/brick_owners.h"

#include <array>
#include <memory>
#include <vector>

namespace ramus::mesh::bricks {

// Finds the specks of bricks where vessels are kept apart. Holds scratch memory only: one per thread.
class Specks {
public:
    // The field must outlive it.
    explicit Specks(const field::Field& field) : field_(field), isovalue_(field.isovalue()) {}

    // What is to become of the specks of a brick: all bricks that a point belongs to find the same. `walls`: by axis
    // the first points of edges that a wall goes through, where any are.
    [[nodiscard]] const std::vector<Speck>& find(const Octree& octree, const ChunkedArray<Neighbourhood>& neighbours,
                                                 std::uint32_t index, GridBits inside,
                                                 const std::array<GridBits, 3>& walls, SampleCounts& counts);

private:
    struct Holder { // a brick that a point belongs to
        std::uint32_t brick = 0;
        glm::ivec3 point{0}; // the grid point, as the brick has it
    };
    [[nodiscard]] bool list_bricks(const Octree& octree, const Neighbourhood& neighbours, std::uint32_t index,
                                   glm::ivec3 point);
    // What is next to a point.
    struct Beside {
        bool connected = false;               // another one of its vessel
        bool parted = false;                  // vessels are kept apart in some brick that it belongs to
        bool outside = false;                 // a point outside of all
        field::Owner owner = field::kNoOwner; // of those inside, the first
    };
    void look_beside(const Octree& octree, const Holder& in, Beside& beside, SampleCounts& counts);

    const field::Field& field_;
    float isovalue_;
    std::unique_ptr<field::BrickField> in_brick_; // where it is asked
    std::vector<Speck> specks_;
    std::vector<Holder> bricks_;              // scratch: those that a point belongs to
    std::vector<field::LatticePoint> points_; // scratch: the point and those next to it
    std::vector<float> values_;
    std::vector<field::Owner> owners_;
};

} // namespace ramus::mesh::bricks
