// LoopWalk: from one loop of a cell to all that are connected with it, across bricks of any size. Of bricks beyond the
// subtree the loops are found once more, so that nothing depends on what is filled already.
#pragma once

#include "core/mesh/polygonize/cells/brick_cells.h"
#include "core/mesh/polygonize/cells/brick_sampler.h"

#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <span>
#include <unordered_map>
#include <unordered_set>
#include <vector>

namespace ramus::mesh::bricks {

// A loop, and the brick and the cell that it is in.
struct LoopPlace {
    std::uint32_t brick = 0;
    int cell = 0;
    std::uint8_t loop = 0;
    friend bool operator==(const LoopPlace&, const LoopPlace&) = default;
};

// Where loops meet: a minimal edge.
struct LoopEdge {
    glm::ivec3 middle{0}; // lattice units
    int axis = 0;
    int level = 0;      // of cells whose edges are as long
    bool upper = false; // where a wall goes through it: the crossing of its upper end
    friend bool operator==(const LoopEdge&, const LoopEdge&) = default;
};

// Of the four cubes of one lattice unit that touch an edge's middle, one: by its lower corner.
inline glm::ivec3 unit_beside(const LoopEdge& edge, int n) {
    glm::ivec3 unit = edge.middle;
    unit[(edge.axis + 1) % 3] -= n & 1;
    unit[(edge.axis + 2) % 3] -= n >> 1;
    return unit;
}

// A subtree as it was filled.
struct FilledSubtree {
    const Octree& octree;
    std::uint32_t index = 0;
    const ChunkedArray<Neighbourhood>& neighbours;
    const ChunkedArray<BrickCells>& cells;
    const SubtreeCells& made;
    // Bricks in which vessels are kept apart, descending.
    std::span<const std::uint32_t> parted;
};

// Holds scratch memory only: one per thread.
class LoopWalk {
public:
    // The field must outlive it.
    explicit LoopWalk(const field::Field& field) : field_(field) {}
    // `in` outlives the stay.
    void begin(const FilledSubtree& in);

    // Parts of the surface that are closed by themselves and fit into a cube of so many of their smallest cells: any
    // parts, of which each brick is the neighbour of each other one; those within the subtree; and slits, which are
    // along walls alone.
    enum class Kind : std::uint8_t { kAny, kWithin, kSlit };
    static constexpr int kMostCells = 4, kMostSlitCells = 8;
    struct Part {
        std::vector<LoopPlace> loops;
        std::vector<LoopEdge> edges;
        bool parted = true;       // vessels are kept apart in every brick of it
        bool within = true;       // it is within the subtree
        float most_radius = 0.0F; // of its vertices, mm
        int most_level = 0;
    };
    // The part that a loop belongs to; nothing where it is larger, or of another kind. Valid until the next call.
    [[nodiscard]] const Part* part_of(const LoopPlace& loop, Kind kind);
    // Whether part_of() looked at bricks beyond the subtree since it began; whether it may have at some that are not
    // even beside it.
    [[nodiscard]] bool looked_beyond() const { return !beyond_.empty(); }
    [[nodiscard]] bool looked_far() const { return looked_far_; }

private:
    // What a brick of this subtree or another one holds.
    struct Filled {
        const BrickCells* cells = nullptr;
        const SubtreeCells* made = nullptr;
        std::span<const float> radii; // of the brick's vertices
        bool parted = false;
    };
    struct Beyond {
        BrickCells cells;
        SubtreeCells made;
        SurfaceVertices vertices;
        bool parted = false;
    };
    [[nodiscard]] Filled filled(std::uint32_t brick);
    [[nodiscard]] static bool is_along_walls(const Filled& there, const LoopPlace& loop);
    [[nodiscard]] std::vector<LoopEdge> edges_of(const LoopPlace& loop); // that it goes through
    [[nodiscard]] std::optional<LoopPlace> loop_at(std::uint32_t brick, const glm::ivec3& unit, const LoopEdge& edge);
    [[nodiscard]] bool add(const LoopPlace& loop, Kind kind); // false: the part is none of those

    const field::Field& field_;
    std::unique_ptr<BrickSampler> sampler_; // where it is needed
    const FilledSubtree* in_ = nullptr;
    std::unordered_map<std::uint32_t, std::unique_ptr<Beyond>> beyond_;
    bool looked_far_ = false;
    std::array<std::unordered_set<std::uint64_t>, 3> others_; // by kind, loops of parts that are none
    Part part_;
    std::vector<LoopEdge> beyond_edges_; // that lead beyond the subtree
    glm::ivec3 low_{0}, high_{0};
    int least_level_ = 0;
};

} // namespace ramus::mesh::bricks
