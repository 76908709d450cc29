// BrickSampler: the work on one brick. It samples the field at the brick's grid points, and where finer bricks touch it
// at their corners too; then it finds the cells' loops and places a vertex for each. Holds scratch memory only: one per
// thread, reused from tile to tile.
//
// Of the 5 x 5 x 5 grid points of a brick those below its upper sides are its own, the others its upper neighbours'. A
// tile's bricks are worked on from the last to the first, so that most of the neighbours' points are there already; of
// a neighbour that is free of surface it is known on which side of it all points lie.
#pragma once

#include "core/field/sampling.h"
#include "core/mesh/polygonize/cells/brick_cells.h"
#include "core/mesh/polygonize/cells/vertex_guesses.h"

#include <span>

namespace ramus::mesh::bricks {

class BrickSampler {
public:
    void begin(const field::ConvolutionField& field, const Octree& octree, const Tile& tile,
               const ChunkedArray<Neighbourhood>& neighbours, SurfaceVertices& vertices);
    // Bricks from the last of the tile to the first. Appends their vertices to what begin() was given; leaves the
    // indices in `cells` relative to the tile.
    void fill(std::uint32_t index, BrickCells& cells, TileCells& tile);

private:
    // The brick's points at half-cell spacing, 9 a side; only those that are hanging corners are sampled.
    static constexpr int kFineSide = 2 * kBrickCells + 1;
    static constexpr int fine_index(int x, int y, int z) { return x + kFineSide * (y + kFineSide * z); }

    // A brick's own samples, and one bit each: inside the surface? In order x + 4 y + 16 z.
    struct OwnSamples {
        std::array<float, kCellsPerBrick> value;
        std::uint64_t inside;
    };

    // A cell that corner signs alone do not describe.
    struct TracedCell {
        int cell;
        CellShape shape;
        CellLoops loops;
        FaceCentres centres;
        std::size_t first_centre; // in points_
    };

    // A part of the grid beyond the brick's own points: what is known of it before sampling.
    struct UpperPart {
        const OwnSamples* neighbour = nullptr; // whose own points these are, if they are there already
        bool known = false;                    // all on one side of the surface
        bool full = false;                     // that side is the inside
    };
    [[nodiscard]] UpperPart upper_part(int x, int y, int z) const;

    void place_brick();
    void sample(unsigned groups, TileCells& tile);
    void sample_own(TileCells& tile);
    void add_upper_sides(TileCells& tile);
    void add_upper_edges(TileCells& tile);
    [[nodiscard]] GridBits assemble_bits() const;
    void assemble_values();
    void prepare_lattice();
    void sample_hanging(TileCells& tile);
    void sample_points(TileCells& tile);
    void sort_cells(BrickCells& cells);
    void trace(int cell, unsigned corner_signs, std::uint32_t finer);
    void decide_face_centres(TileCells& tile);

    void add_recorded_vertices(const TracedCell& traced, TileCells& tile, CellRecord& record);
    [[nodiscard]] glm::vec3 crossing(glm::ivec3 cell, int edge_midpoint) const;
    [[nodiscard]] float log_at(glm::ivec3 fine) const;
    void add_vertex(glm::vec3 guess, glm::ivec3 cell, int vertices);

    // Of the tile.
    const field::ConvolutionField* field_ = nullptr;
    const Octree* octree_ = nullptr;
    const ChunkedArray<Neighbourhood>* all_neighbours_ = nullptr;
    std::uint32_t first_brick_ = 0, brick_count_ = 0; // of the tile
    float isovalue_ = 0.0F;
    SurfaceVertices* vertices_ = nullptr; // to which the tile's are appended
    std::size_t first_vertex_ = 0;        // of the tile
    LargeArray<OwnSamples> own_;          // by brick of the tile; the last brick_count - n are filled

    // Of the brick.
    const Brick* brick_ = nullptr;
    const Neighbourhood* neighbours_ = nullptr;
    std::uint32_t index_ = 0;
    float cell_mm_ = 0.0F;
    field::LocalSegments local_;
    field::GridGroups samples_{}; // by group, wherever they come from
    bool lattice_ready_ = false;
    field::LatticeAxes lattice_axes_{};
    GridBits inside_ = 0;
    std::uint64_t half_crossed_ = 0;                      // cells at a hanging corner that differs from the cell's own
    alignas(64) std::array<float, kGridStride> values_{}; // at the grid points
    std::array<float, kFineSide * kFineSide * kFineSide> fine_values_{}; // at hanging corners
    std::array<std::uint8_t, 2 * kCellsPerBrick> plain_corners_{};       // of plain cells: low corners, grid points
    std::vector<TracedCell> traced_;
    std::vector<field::LatticePoint> points_;
    std::vector<float> point_values_;
    field::Projection projection_;
};

} // namespace ramus::mesh::bricks
