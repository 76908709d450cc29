// BrickSampler: processes one brick after another. It samples the field at the grid points (BrickGrid) and at hanging
// corners where finer bricks touch the brick, traces the circuits of the cells, and places a vertex for each circuit.
// It contains only scratch memory; each thread reuses one object.
#pragma once

#include "core/field/field.h"
#include "core/mesh/polygonize/cells/brick_grid.h"
#include "core/mesh/polygonize/cells/brick_owners.h"
#include "core/mesh/polygonize/cells/vertex_guesses.h"

#include <memory>

namespace ramus::mesh::bricks {

class BrickSampler {
public:
    // The field must outlive it.
    explicit BrickSampler(const field::Field& field) : field_(field.in_brick()), isovalue_(field.isovalue()) {}

    // Begins a run of consecutive bricks of a subtree.
    void begin(const Octree& octree, std::uint32_t first_brick, std::uint32_t brick_count, SurfaceVertices& vertices);
    // Processes one brick; call it for the bricks from the last to the first. Appends vertices to the `vertices` of
    // begin(). The indices in `cells` are relative to their number at begin().
    void fill(std::uint32_t index, const Neighbourhood& neighbours, BrickCells& cells, SubtreeCells& subtree);
    // Whether vessels are kept apart in the brick processed last.
    [[nodiscard]] bool parts_vessels() const { return separation_ != nullptr; }
    // Whether walls pass through its cells.
    [[nodiscard]] bool has_walled_cells() const { return has_walled_cells_; }

private:
    // The brick's points at half-cell spacing. Only hanging corners among them are sampled.
    static constexpr int kFineSide = BrickOwners::kFineSide;
    static constexpr int fine_index(int x, int y, int z) { return BrickOwners::fine_index(x, y, z); }

    // A cell that corner signs alone do not describe.
    struct TracedCell {
        int cell;
        CellShape shape;
        CellCircuits circuits;
        FaceCentres centres;
        std::size_t first_centre; // in points_
        int apart;                // index into apart_points_, or -1
        bool walled;              // whether some of its points are apart
    };

    void prepare_lattice();
    void sample_hanging(SubtreeCells& subtree);
    void find_owners(SubtreeCells& subtree);
    void sample_points(SubtreeCells& subtree);
    void sort_cells(BrickCells& cells);
    void trace(int cell, unsigned corner_signs, std::uint32_t finer);
    void decide_face_centres(SubtreeCells& subtree);
    void find_centres_vessels(TracedCell& traced, SubtreeCells& subtree);

    void add_recorded_vertices(const TracedCell& traced, SubtreeCells& subtree, CellRecord& record);
    [[nodiscard]] float crossing_share(glm::ivec3 cell, int edge_midpoint);
    [[nodiscard]] glm::vec3 crossing(glm::ivec3 cell, int edge_midpoint);
    [[nodiscard]] float value_at(glm::ivec3 fine) const;
    void add_vertex(glm::vec3 guess, glm::ivec3 cell, bool alone, const field::OwnedGuess& whose);
    [[nodiscard]] std::uint8_t coarser_faces(const glm::ivec3& cell) const;
    [[nodiscard]] bool owns(const FaceArc& arc, glm::ivec3 cell) const;
    void keep_within(field::OwnedGuess& vertex, glm::ivec3 cell) const;
    [[nodiscard]] const ApartPoints* apart_points(const TracedCell& traced) const {
        return traced.apart < 0 ? nullptr : &apart_points_[static_cast<std::size_t>(traced.apart)];
    }

    std::unique_ptr<field::BrickField> field_;
    float isovalue_;
    BrickGrid grid_;

    // State of the subtree.
    const Octree* octree_ = nullptr;
    SurfaceVertices* vertices_ = nullptr; // receives the subtree's vertices
    std::size_t first_vertex_ = 0;        // of the subtree

    // State of the brick.
    const Brick* brick_ = nullptr;
    const Neighbourhood* neighbours_ = nullptr;
    float cell_mm_ = 0.0F;
    bool lattice_ready_ = false;
    field::LatticeAxes lattice_axes_{};
    std::uint64_t half_crossed_ = 0; // cells at a hanging corner that differs from the cell's own
    field::GridValues depths_{};     // at the grid points
    std::array<float, kFineSide * kFineSide * kFineSide> fine_values_{}; // at hanging corners
    std::array<std::uint8_t, 2 * kCellsPerBrick> plain_corners_{};       // low corners of plain cells, as grid points
    std::vector<TracedCell> traced_;
    std::vector<field::LatticePoint> points_;
    std::vector<float> point_values_;
    field::Projection guesses_;

    // Used only if vessels are kept apart.
    field::Separation* separation_ = nullptr;
    BrickOwners owners_;
    std::vector<field::LatticePoint> hanging_inside_;
    std::vector<ApartPoints> apart_points_; // of traced cells
    std::vector<field::OwnedGuess> owned_;  // by guess
    bool has_walled_cells_ = false;
};

} // namespace ramus::mesh::bricks
