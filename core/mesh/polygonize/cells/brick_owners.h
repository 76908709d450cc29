// BrickOwners: the owners of the points inside the surface, in a brick in which vessels are kept apart, and the edges
// of its grid that walls pass through (core/field/separation/README.md).
#pragma once

#include "core/field/separation.h"
#include "core/mesh/polygonize/cells/brick_cells.h"
#include "core/mesh/polygonize/cells/cell_circuits.h"

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace ramus::mesh::bricks {

class BrickOwners {
public:
    static constexpr std::uint32_t kAllPoints = (1U << 27) - 1; // of CellShape::inside
    // The brick's points at half-cell spacing, 9 a side.
    static constexpr int kFineSide = 2 * kBrickCells + 1;
    static constexpr int fine_index(int x, int y, int z) { return x + kFineSide * (y + kFineSide * z); }

    // Finds the owners of the brick that `separation` is of. `hanging`: further points inside the surface.
    void find(field::Separation& separation, const field::LatticeAxes& lattice, GridBits inside,
              std::span<const field::LatticePoint> hanging, SampleCounts& counts);

    [[nodiscard]] const std::array<GridBits, 3>& walls() const { return walls_; } // by axis: first points of edges
    [[nodiscard]] bool any_walls() const { return walls_[0] != 0 || walls_[1] != 0 || walls_[2] != 0 || hanging_ != 0; }
    // One bit per cell: whether a wall passes through one of its edges, or through half of one.
    [[nodiscard]] std::uint64_t cells() const { return cells_; }

    [[nodiscard]] field::Owner at(int x, int y, int z) const { // in half cells
        return owner_[static_cast<std::size_t>(fine_index(x, y, z))];
    }
    // Finds the points of a cell that belong to vessels that are apart. Returns whether there are any; if not, `apart`
    // is not written.
    [[nodiscard]] bool find_apart(glm::ivec3 cell, ApartPoints& apart) const;
    // The points of a cell that are apart from the vessel of `owner`, as bits of CellShape::inside; all points for
    // kNoOwner.
    [[nodiscard]] std::uint32_t apart_from(const field::Separation& separation, glm::ivec3 cell,
                                           field::Owner owner) const;
    // The owner of the circuit through a crossing of a cell.
    [[nodiscard]] field::Owner of_crossing(glm::ivec3 cell, int crossing) const;

private:
    // A local number of a piece that owns some of the points; 0: a piece that is not kept apart from anything.
    using Piece = std::uint16_t;
    struct CellPieces {
        std::array<Piece, 27> piece{};
        std::array<std::uint32_t, 27> points{}; // by piece: its points, as bits of CellShape::inside
        std::size_t count = 0;
    };
    void find_pieces(const field::Separation& separation);
    void find_walls(GridBits inside, std::span<const field::LatticePoint> hanging);
    [[nodiscard]] CellPieces pieces_in(glm::ivec3 cell) const;
    [[nodiscard]] Piece piece_at(int x, int y, int z) const {
        return piece_[static_cast<std::size_t>(fine_index(x, y, z))];
    }
    [[nodiscard]] bool apart(Piece a, Piece b) const { return apart_[a * pieces_.size() + b] != 0; }

    std::array<field::Owner, kFineSide * kFineSide * kFineSide> owner_{};
    std::array<Piece, kFineSide * kFineSide * kFineSide> piece_{};
    std::vector<int> pieces_;         // by local number: the piece of the field
    std::vector<std::uint8_t> apart_; // matrix over local numbers
    bool any_apart_ = false;
    std::array<GridBits, 3> walls_{};
    std::uint64_t cells_ = 0, hanging_ = 0;
    std::vector<field::LatticePoint> points_;
    std::vector<field::Owner> owners_;
};

} // namespace ramus::mesh::bricks
