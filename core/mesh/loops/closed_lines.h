// Finds closed lines along the edges of a surface that do not divide it. A closed surface of genus g has 2 g
// independent ones: two for each cycle of the tree (one around a vessel, one along the cycle), and two for each false
// connection (one around the connection, one around the hole next to it).
//
// Method: a spanning tree of the edges, and a spanning tree of the triangles that does not cross it, leave 2 g edges
// (Eppstein, Dynamic generators of topologically embedded graphs, SODA 2003). If the first is a shortest-path tree and
// the second prefers edges that close long lines, the remaining edges lie at the connections (Erickson and Whittlesey,
// Greedy optimal homotopy and homology generators, SODA 2005). Each remaining edge belongs to a closed row of
// triangles, along the tree of triangles. A closed line divides the surface if and only if it crosses every row an even
// number of times.
//
// Each row has a label of 128 bits, and each line the exclusive or of the labels of the rows that it crosses. Up to 128
// rows have one bit each. Labels of more rows are hashes, so a line that does not divide the surface has the label 0
// with a probability of 2^-128. So neither the time nor the memory of a search grows with the number of loops.
#pragma once

#include "core/base/job.h"
#include "core/mesh/loops/surface_graph.h"

#include <array>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

namespace ramus::mesh {

// The exclusive or of the labels of the rows of triangles that a closed line crosses: its homology class modulo 2.
using HomologyClass = std::array<std::uint64_t, 2>;

struct ClosedLine {
    std::vector<std::uint32_t> vertices; // in order, each once
    double length = 0.0;                 // mm
    HomologyClass homology{};
};

// A set of linearly independent classes (over GF(2)). Closed lines of these classes without common vertices do not
// divide the surface, even together.
class IndependentClasses {
public:
    // `homology`, reduced by the classes of the set: 0 if it is a sum of them.
    [[nodiscard]] HomologyClass rest(HomologyClass homology) const;
    [[nodiscard]] bool allow(const HomologyClass& homology) const { return rest(homology) != HomologyClass{}; }
    void add(const HomologyClass& homology) { rests_.push_back(rest(homology)); } // allow(homology) must hold

private:
    std::vector<HomologyClass> rests_; // each has a highest bit of its own
};

[[nodiscard]] std::vector<glm::dvec3> positions_of(const TriangleMesh& mesh, const ClosedLine& line); // mm

class ClosedLines {
public:
    // The graph must outlive the object. `barred`: by vertex; not 0: no line may pass through the vertex. Vertices
    // beyond the end of the span are not barred.
    ClosedLines(const SurfaceGraph& graph, std::span<const std::uint8_t> barred, Job& job);

    // The remaining edges: two for each loop that connectivity_of() counts; none if the job was cancelled.
    [[nodiscard]] std::span<const std::uint32_t> edges() const { return edges_; }
    // The shortest lines through a vertex that do not divide the surface and are no longer than `longest` mm: one of
    // each class, the shortest first. Adds the number of visited vertices to `visited`.
    [[nodiscard]] std::vector<ClosedLine> shortest(std::uint32_t vertex, double longest, std::size_t& visited) const;

private:
    struct Tree;
    [[nodiscard]] Tree shortest_paths(Job& job) const;
    void find_crossings(std::span<const std::uint32_t> tree);
    [[nodiscard]] HomologyClass label(std::size_t row) const;
    struct Known;
    using KnownVertices = std::unordered_map<std::uint32_t, Known>;
    [[nodiscard]] bool is_barred(std::uint32_t vertex) const { return vertex < barred_.size() && barred_[vertex] != 0; }
    [[nodiscard]] ClosedLine closed(const KnownVertices& known, std::uint32_t start, std::uint32_t edge) const;

    const SurfaceGraph& graph_;
    std::span<const std::uint8_t> barred_;
    std::vector<std::uint32_t> edges_;
    std::vector<HomologyClass> crossings_; // by edge
};

} // namespace ramus::mesh
