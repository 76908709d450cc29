// WalledCells: where the vertices of cells go that walls between vessels run through, in one brick.
//
// In such a cell each loop's surface is the fan from its vertex to the loop's crossings on the cell's edges, and to
// vertices on its faces between these. All of it stays within the cell, and on a face within that, so surfaces of
// different cells cannot meet but where they should; within a face or cell, the places are chosen so that fans of
// different vessels do not meet either.
#pragma once

#include "core/field/brick_field.h"
#include "core/mesh/polygonize/cells/brick_owners.h"
#include "core/mesh/polygonize/cells/cell_loops.h"
#include "core/mesh/polygonize/cells/wall_pairs.h"

#include <array>
#include <glm/vec3.hpp>
#include <unordered_map>
#include <vector>

namespace ramus::mesh::bricks {

// Where the vertices of a cell with walls may be: a little off its boundary.
[[nodiscard]] inline Span within_cell(const glm::ivec3& cell, float cell_mm) {
    constexpr float kOff = 0.01F;
    return {(glm::vec3(cell) + kOff) * cell_mm, (glm::vec3(cell) + 1.0F - kOff) * cell_mm};
}

class WalledCells {
public:
    struct Cell {                             // where its vertices are, relative to the brick's corner
        std::vector<field::OwnedGuess> loops; // by loop
        std::vector<field::OwnedGuess> arcs;  // of CellLoops::own_arcs
    };
    // The share of the way from the lower end of each of a cell's edges at which the surface may cross it.
    using Guesses = std::array<float, kQuarterPoints>;

    void begin(float cell_mm);
    // Adds what was found of the edges of a brick, which has this number in its subtree.
    void add_ends(std::uint32_t brick, std::vector<KnownEnds>& to) const;
    [[nodiscard]] Cell place(field::BrickField& field, const BrickOwners& owners, glm::ivec3 cell,
                             const CellShape& shape, const CellLoops& loops, const Guesses& guesses);

private:
    struct Work;
    struct Loop;
    struct Found;
    [[nodiscard]] glm::vec3 crossing(Work& work, int crossing);
    void place_arcs(Work& work);
    static std::vector<WallPair> join_loops(Work& work, std::vector<Loop>& loop);
    void place_loops(Work& work);
    void part_loops(Work& work, const std::vector<WallPair>& pairs);

    float cell_mm_ = 0.0F;
    std::vector<KnownEnds> ends_;                               // of the brick's edges, as found
    std::vector<std::uint16_t> number_of_edge_;                 // among these, from 1 on; 0: not found yet
    std::unordered_map<std::uint32_t, field::OwnedPoint> arcs_; // where a vertex was found on them
};

} // namespace ramus::mesh::bricks
