// BrickSampler: the work on one brick. It samples the field at the brick's grid points, and where finer bricks touch it
// at their corners too; then it finds the cells' loops and places a vertex for each. Holds scratch memory only: one per
// thread, reused from brick to brick.
#pragma once

#include "core/field/sampling.h"
#include "core/mesh/polygonize/cells/brick_cells.h"

namespace ramus::mesh::bricks {

class BrickSampler {
public:
    // Leaves the indices in `cells` relative to the chunk.
    void fill(const field::ConvolutionField& field, const Octree& octree, const Brick& brick,
              const Neighbourhood& neighbours, BrickCells& cells, BrickChunk& chunk);

private:
    // The brick's points at half-cell spacing, 9 a side; only those that are hanging corners are sampled.
    static constexpr int kFineSide = 2 * kBrickCells + 1;
    static constexpr int fine_index(int x, int y, int z) { return x + kFineSide * (y + kFineSide * z); }

    // A cell that corner signs alone do not describe.
    struct TracedCell {
        int cell;
        CellShape shape;
        CellLoops loops;
        FaceCentres centres;
        std::size_t first_centre; // in points_
    };

    void sample_hanging(const field::ConvolutionField& field, std::span<const std::uint32_t> list, std::uint32_t finer,
                        BrickChunk& chunk);
    void sample_points(const field::ConvolutionField& field, std::span<const std::uint32_t> list, BrickChunk& chunk);
    [[nodiscard]] static bool is_crossed(const BrickCells& cells, std::uint64_t half_crossed);
    void sort_cells(const Neighbourhood& neighbours, BrickCells& cells);
    void trace(int cell, unsigned corner_signs, std::uint32_t finer);
    void decide_face_centres(const field::ConvolutionField& field, std::span<const std::uint32_t> list,
                             BrickChunk& chunk);

    void add_recorded_vertices(const TracedCell& traced, const Neighbourhood& neighbours, BrickChunk& chunk,
                               CellRecord& record);
    [[nodiscard]] glm::vec3 crossing(glm::ivec3 cell, int edge_midpoint) const;
    [[nodiscard]] float log_at(glm::ivec3 fine) const;
    void add_vertex(glm::vec3 guess, glm::ivec3 cell, int vertices);

    float isovalue_ = 0.0F;
    float cell_mm_ = 0.0F;
    std::uint64_t half_crossed_ = 0; // cells at a hanging corner that differs from the cell's own
    field::LatticeAxes axes_{};
    alignas(64) std::array<float, field::kGridStride> values_{};
    std::array<float, kFineSide * kFineSide * kFineSide> fine_values_{}; // of hanging corners
    std::array<std::uint8_t, 2 * kCellsPerBrick> plain_corners_{};       // of plain cells: low corners, grid points
    std::vector<TracedCell> traced_;
    std::vector<field::LatticePoint> points_;
    std::vector<float> point_values_;
    field::Projection projection_;
};

} // namespace ramus::mesh::bricks
