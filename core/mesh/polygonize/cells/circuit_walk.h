// CircuitWalk: finds all circuits that are connected with one circuit of a cell, across bricks of any size. It computes
// the circuits of bricks beyond the subtree itself, so that the result does not depend on which subtrees are already
// filled.
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

// A circuit, and the brick and the cell that it is in.
struct CircuitPlace {
    std::uint32_t brick = 0;
    int cell = 0;
    std::uint8_t number = 0; // in the cell
    friend bool operator==(const CircuitPlace&, const CircuitPlace&) = default;
};

// A crossed minimal edge, where the circuits of the cells around it meet.
struct CircuitEdge {
    glm::ivec3 middle{0}; // lattice units
    int axis = 0;
    int level = 0;      // of cells with edges of this length
    bool upper = false; // if the edge has a wall: the crossing of its upper end
    friend bool operator==(const CircuitEdge&, const CircuitEdge&) = default;
};

// The n-th of the four cubes of one lattice unit that touch the middle of an edge, by its lower corner.
inline glm::ivec3 unit_beside(const CircuitEdge& edge, int n) {
    glm::ivec3 unit = edge.middle;
    unit[(edge.axis + 1) % 3] -= n & 1;
    unit[(edge.axis + 2) % 3] -= n >> 1;
    return unit;
}

// A subtree that has been filled.
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
class CircuitWalk {
public:
    // The field must outlive it.
    explicit CircuitWalk(const field::Field& field) : field_(field) {}
    // Begins a subtree. `in` must stay valid until the next call.
    void begin(const FilledSubtree& in);

    // Kinds of small closed parts of the surface. A part must fit into a cube of kMostCells of its smallest cells (a
    // slit: kMostSlitCells). kAny: a part whose bricks are all neighbours of each other. kWithin: a part within the
    // subtree. kSlit: a part whose crossings are all at walls.
    enum class Kind : std::uint8_t { kAny, kWithin, kSlit };
    static constexpr int kMostCells = 4, kMostSlitCells = 8;
    struct Part {
        std::vector<CircuitPlace> circuits;
        std::vector<CircuitEdge> edges;
        bool parted = true;       // whether vessels are kept apart in all of its bricks
        bool within = true;       // whether it is within the subtree
        float most_radius = 0.0F; // the largest radius of its vertices, mm
        int most_level = 0;
    };
    // The part that contains a circuit; null if it is larger or of another kind. Valid until the next call.
    [[nodiscard]] const Part* part_of(const CircuitPlace& circuit, Kind kind);
    // Whether part_of() has visited bricks beyond the subtree since begin(); and whether it may have visited bricks
    // that do not touch the subtree.
    [[nodiscard]] bool looked_beyond() const { return !beyond_.empty(); }
    [[nodiscard]] bool looked_far() const { return looked_far_; }

private:
    // The data of a brick of this subtree or another one.
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
    [[nodiscard]] static bool is_along_walls(const Filled& there, const CircuitPlace& circuit);
    [[nodiscard]] std::vector<CircuitEdge> edges_of(const CircuitPlace& circuit);
    [[nodiscard]] std::optional<CircuitPlace> circuit_at(std::uint32_t brick, const glm::ivec3& unit,
                                                         const CircuitEdge& edge);
    [[nodiscard]] bool add(const CircuitPlace& circuit, Kind kind); // false: the part is not of this kind

    const field::Field& field_;
    std::unique_ptr<BrickSampler> sampler_; // allocated on first use
    const FilledSubtree* in_ = nullptr;
    std::unordered_map<std::uint32_t, std::unique_ptr<Beyond>> beyond_;
    bool looked_far_ = false;
    std::array<std::unordered_set<std::uint64_t>, 3> others_; // by kind: circuits of parts that are not of this kind
    Part part_;
    std::vector<CircuitEdge> beyond_edges_; // edges that lead beyond the subtree
    glm::ivec3 low_{0}, high_{0};
    int least_level_ = 0;
};

} // namespace ramus::mesh::bricks
