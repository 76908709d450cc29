// BrickSampler: the work on one brick. It samples the field at the brick's grid points, and where finer bricks touch it
// at their corners too; then it traces the cells' loops and places a vertex for each. Holds scratch memory only: one
// per thread, reused from brick to brick.
#pragma once

#include "core/mesh/polygonize/brick_cells.h"

namespace ramus::mesh::bricks {

class BrickSampler {
public:
    void fill(const field::ConvolutionField& field, const BrickSet& set, const Brick& brick,
              const Neighbourhood& neighbours, BrickCells& cells, BrickChunk& chunk);

private:
    // The brick's points at half-cell spacing, 9 a side; only those that are corners or hanging corners are sampled.
    static constexpr int kFineSide = 2 * kBrickCells + 1;
    static constexpr int fine_index(int x, int y, int z) { return x + kFineSide * (y + kFineSide * z); }

    void sample(const field::ConvolutionField& field, const BrickSet& set, const Brick& brick,
                const Neighbourhood& neighbours, BrickCells& cells, BrickChunk& chunk);
    void sample_hanging(const field::ConvolutionField& field, std::span<const std::uint32_t> list,
                        const Neighbourhood& neighbours, BrickChunk& chunk);
    [[nodiscard]] bool is_crossed(const BrickCells& cells) const;
    void trace_cells(const field::ConvolutionField& field, std::span<const std::uint32_t> list,
                     const Neighbourhood& neighbours, BrickCells& cells, BrickChunk& chunk);
    [[nodiscard]] CellShape shape_of(int x, int y, int z, const Neighbourhood& neighbours) const;
    [[nodiscard]] bool is_inside(int fine) const { return fine_values_[static_cast<std::size_t>(fine)] >= isovalue_; }

    void add_table_vertices(int x, int y, int z, const CornerCase& corner_case);
    void add_recorded_vertices(int x, int y, int z, const CellLoops& loops, const Neighbourhood& neighbours,
                               BrickCells& cells, BrickChunk& chunk, CellRecord& record);
    [[nodiscard]] glm::vec3 crossing(int fine_a, int fine_b, glm::vec3 a, glm::vec3 b) const;
    void add_vertex(glm::vec3 guess, int x, int y, int z, int loops);

    float isovalue_ = 0.0F;
    float cell_mm_ = 0.0F;
    bool hanging_ = false;           // some finer brick touches this one
    std::uint64_t half_crossed_ = 0; // cells at a hanging corner that differs from the cell's own
    field::LatticeAxes axes_{};
    alignas(64) std::array<float, field::kGridStride> values_{};
    alignas(64) std::array<float, field::kGridStride> logs_{};
    std::array<float, kFineSide * kFineSide * kFineSide> fine_values_{}; // of hanging corners
    std::vector<field::LatticePoint> points_;
    std::vector<float> point_values_;
    field::Projection projection_;
};

} // namespace ramus::mesh::bricks
