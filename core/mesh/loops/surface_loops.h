// Loops of a surface: closed lines along its edges that do not part it. A closed surface has two that are independent
// for each cycle of its graph, one around a vessel and one along the cycle, and two more where it connects what its
// tree does not: one around the connection, one around the hole beside it.
//
// A spanning tree of the edges and, without crossing it, one of the triangles leave two edges for each loop (Eppstein,
// Dynamic generators of topologically embedded graphs, SODA 2003). With the shortest paths as the first and the longest
// ways crossed first by the second these edges lie where the connections are (Erickson and Whittlesey, Greedy optimal
// homotopy and homology generators, SODA 2005). Each belongs to a closed row of triangles; how often a closed line
// crosses each of these rows, an even or odd number of times, tells whether it parts the surface. A row has a label of
// 128 bits, and a line the sum of those that it crosses, bit by bit without carry: of up to 128 rows each has a bit of
// its own, and labels of more are scattered, so that a line which does not part the surface has a sum of 0 by chance
// alone, once in 2^128. So neither time nor memory grows with the number of loops.
#pragma once

#include "core/base/job.h"
#include "core/mesh/loops/surface_graph.h"

#include <array>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

namespace ramus::mesh {

// The sum of the labels of the rows of triangles that a closed line crosses an odd number of times.
using LoopKind = std::array<std::uint64_t, 2>;

struct SurfaceLoop {
    std::vector<std::uint32_t> vertices; // in order, each once
    double length = 0.0;                 // mm
    LoopKind kind{};
};

// Kinds of which none is the sum of others. Closed lines of such kinds that have no vertex in common do not part their
// surface, even together.
class IndependentKinds {
public:
    // Without what is a sum of the kinds here: 0 if it is one of their sums.
    [[nodiscard]] LoopKind rest(LoopKind kind) const;
    [[nodiscard]] bool allow(const LoopKind& kind) const { return rest(kind) != LoopKind{}; }
    void add(const LoopKind& kind) { rests_.push_back(rest(kind)); } // one that they allow

private:
    std::vector<LoopKind> rests_; // each has a highest bit of its own
};

[[nodiscard]] std::vector<glm::dvec3> positions_of(const TriangleMesh& mesh, const SurfaceLoop& loop); // mm

class SurfaceLoops {
public:
    // Of a graph, which must outlive it. `barred`: by vertex, not 0: no loop that is looked for goes there; later ones
    // are not.
    SurfaceLoops(const SurfaceGraph& graph, std::span<const std::uint8_t> barred, Job& job);

    // Two for each of the surface's loops, as connectivity_of() counts them; none if the job was cancelled.
    [[nodiscard]] std::span<const std::uint32_t> edges() const { return edges_; }
    // The shortest loops through a vertex that are no longer than `longest`, mm: one of each kind, which cross
    // the same loops of triangles an odd number of times; the shortest first. Adds to `visited` how many vertices it
    // came to.
    [[nodiscard]] std::vector<SurfaceLoop> shortest(std::uint32_t vertex, double longest, std::size_t& visited) const;

private:
    struct Tree;
    [[nodiscard]] Tree shortest_paths(Job& job) const;
    void find_crossings(std::span<const std::uint32_t> tree);
    [[nodiscard]] LoopKind label(std::size_t row) const;
    struct Known;
    using KnownVertices = std::unordered_map<std::uint32_t, Known>;
    [[nodiscard]] bool is_barred(std::uint32_t vertex) const { return vertex < barred_.size() && barred_[vertex] != 0; }
    [[nodiscard]] SurfaceLoop closed(const KnownVertices& known, std::uint32_t start, std::uint32_t edge) const;

    const SurfaceGraph& graph_;
    std::span<const std::uint8_t> barred_;
    std::vector<std::uint32_t> edges_;
    std::vector<LoopKind> crossings_; // by edge
};

} // namespace ramus::mesh
