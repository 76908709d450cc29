// What a surface is of, counted: the pieces of a mesh, each with its loops, beside the pieces of a graph. A vessel's
// surface has as many loops (handles) as its graph has independent cycles.
#pragma once

#include "core/base/disjoint_sets.h"
#include "core/mesh/triangle_mesh.h"
#include "core/tree/prepare.h"

#include <algorithm>
#include <cstdint>
#include <glm/geometric.hpp>
#include <map>
#include <vector>

namespace ramus::test {

struct Shape {
    long pieces = 0, loops = 0;
    bool operator==(const Shape&) const = default;
};

struct MeshPiece {
    long loops = 0;      // of a closed one
    double volume = 0.0; // mm^3; negative: a bubble
    std::uint32_t first_vertex = 0;
    std::size_t triangles = 0;
};

// The parts of a closed mesh that hang together, by their first vertex.
[[nodiscard]] inline std::vector<MeshPiece> pieces_of(const mesh::TriangleMesh& mesh) {
    DisjointSets sets(mesh.positions.size());
    for (const glm::uvec3& t : mesh.triangles) sets.join(t.x, t.y), sets.join(t.y, t.z);
    struct Counted {
        long vertices = 0;
        MeshPiece piece;
    };
    std::map<std::uint32_t, Counted> counted;
    for (std::uint32_t v = 0; v < mesh.positions.size(); ++v) ++counted[sets.find(v)].vertices;
    const glm::dvec3 origin = mesh.positions.empty() ? glm::dvec3(0.0) : glm::dvec3(mesh.positions[0]);
    for (const glm::uvec3& t : mesh.triangles) {
        MeshPiece& piece = counted[sets.find(t.x)].piece;
        const auto at = [&](std::uint32_t v) { return glm::dvec3(mesh.positions[v]) - origin; };
        ++piece.triangles;
        piece.volume += glm::dot(at(t.x), glm::cross(at(t.y), at(t.z))) / 6.0;
    }
    std::vector<MeshPiece> pieces;
    for (auto& [first, of] : counted) {
        if (of.piece.triangles == 0) continue; // a vertex that no triangle uses
        of.piece.first_vertex = first;
        const long euler = of.vertices - static_cast<long>(of.piece.triangles) / 2; // edges: three for two triangles
        of.piece.loops = 1 - euler / 2;
        pieces.push_back(of.piece);
    }
    return pieces;
}

[[nodiscard]] inline Shape shape_of(const std::vector<MeshPiece>& pieces) {
    Shape shape;
    for (const MeshPiece& piece : pieces) ++shape.pieces, shape.loops += piece.loops;
    return shape;
}

// The parts of a graph that hang together, and those of its branches (by their number in the file's tree).
struct GraphPieces {
    std::vector<long> loops; // independent cycles of each
    std::map<int, std::size_t> of_branch;
    [[nodiscard]] Shape shape() const {
        Shape shape{static_cast<long>(loops.size()), 0};
        for (const long of_piece : loops) shape.loops += of_piece;
        return shape;
    }
};

// Counted from the segments alone.
[[nodiscard]] inline GraphPieces pieces_of(const tree::PreparedTree& prepared) {
    const tree::VesselTree& tree = prepared.tree;
    DisjointSets sets(tree.points.size());
    for (const tree::Branch& branch : tree.branches)
        for (std::size_t n = 1; n < branch.points.size(); ++n) sets.join(branch.points[n - 1], branch.points[n]);
    std::vector<bool> used(tree.points.size(), false);
    std::map<std::uint32_t, std::size_t> number;
    GraphPieces pieces;
    std::size_t segment = 0;
    for (const tree::Branch& branch : tree.branches) {
        const auto [at, fresh] = number.emplace(sets.find(branch.points[0]), pieces.loops.size());
        if (fresh) pieces.loops.push_back(1); // edges - points + 1
        for (std::size_t n = 0; n < branch.points.size(); ++n) {
            if (!used[branch.points[n]]) --pieces.loops[at->second];
            used[branch.points[n]] = true;
            if (n == 0) continue;
            ++pieces.loops[at->second];
            pieces.of_branch[prepared.segment_source[segment++]] = at->second;
        }
    }
    return pieces;
}

// Pieces of the surface that are not one piece of the graph with just its loops; of the graph, those without a surface.
struct WrongPieces {
    std::vector<MeshPiece> of_mesh;
    std::vector<std::size_t> of_graph;
    [[nodiscard]] bool none() const { return of_mesh.empty() && of_graph.empty(); }
};

[[nodiscard]] inline WrongPieces wrong_pieces(const mesh::TriangleMesh& mesh, const std::vector<MeshPiece>& pieces,
                                              const GraphPieces& graph) {
    WrongPieces wrong;
    std::vector<int> surfaces(graph.loops.size(), 0);
    for (const MeshPiece& piece : pieces) {
        const std::size_t of = graph.of_branch.at(mesh.branches[piece.first_vertex]);
        if (++surfaces[of] > 1 || piece.loops != graph.loops[of] || piece.volume <= 0.0) wrong.of_mesh.push_back(piece);
    }
    for (std::size_t n = 0; n < surfaces.size(); ++n)
        if (surfaces[n] == 0) wrong.of_graph.push_back(n);
    return wrong;
}

} // namespace ramus::test
