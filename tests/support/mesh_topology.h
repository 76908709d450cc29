// What a triangle mesh is, topologically, counted from its index triples alone.
#pragma once

#include "core/base/grouped.h"
#include "core/mesh/triangle_mesh.h"

#include <algorithm>
#include <cstdint>
#include <glm/geometric.hpp>
#include <span>

namespace ramus::test {

struct Topology {
    std::size_t open_edges = 0;     // directed edges without their opposite
    std::size_t repeated_edges = 0; // directed edges used by more than one triangle
    std::size_t degenerate = 0;     // triangles with a repeated vertex
    std::size_t zero_area = 0;      // triangles whose area is exactly nothing, computed in double precision
    std::size_t split_vertices = 0; // vertices whose triangles do not form one ring
    std::size_t unused_vertices = 0;
    std::size_t edges = 0;
    double volume = 0.0; // positive when oriented outward
    long euler = 0;      // V - E + F

    [[nodiscard]] bool closed_manifold() const {
        return open_edges == 0 && repeated_edges == 0 && degenerate == 0 && split_vertices == 0 && unused_vertices == 0;
    }
};

struct HalfEdge {
    std::uint32_t to, triangle;
};

// Directed edges of a mesh by their start, those of a vertex by their end.
class HalfEdges {
public:
    explicit HalfEdges(const mesh::TriangleMesh& mesh)
        : edges_(mesh.positions.size(), [&](const auto& put) {
              for (std::uint32_t n = 0; n < mesh.triangles.size(); ++n)
                  for (int i = 0; i < 3; ++i) put(mesh.triangles[n][i], HalfEdge{mesh.triangles[n][(i + 1) % 3], n});
          }) {
        for (std::size_t v = 0; v < mesh.positions.size(); ++v) std::ranges::sort(edges_.of(v), {}, &HalfEdge::to);
    }
    [[nodiscard]] std::span<const HalfEdge> of(std::uint32_t vertex) const { return edges_.of(vertex); }
    // Null: there is none.
    [[nodiscard]] const HalfEdge* find(std::uint32_t from, std::uint32_t to) const {
        const auto all = of(from);
        const auto at = std::ranges::lower_bound(all, to, {}, &HalfEdge::to);
        return at != all.end() && at->to == to ? &*at : nullptr;
    }

private:
    Grouped<HalfEdge> edges_;
};

// Turns about a vertex: each triangle leads from one of its edges there to the next. Whether that meets all of them.
inline bool is_one_ring(const mesh::TriangleMesh& mesh, const HalfEdges& edges, std::uint32_t vertex) {
    const std::size_t degree = edges.of(vertex).size();
    const std::uint32_t start = edges.of(vertex).front().to;
    std::size_t steps = 0;
    std::uint32_t at = start;
    do {
        const HalfEdge* edge = edges.find(vertex, at);
        if (edge == nullptr) break;
        const glm::uvec3& triangle = mesh.triangles[edge->triangle];
        const int corner = triangle.x == vertex ? 0 : triangle.y == vertex ? 1 : 2;
        at = triangle[(corner + 2) % 3];
        ++steps;
    } while (at != start && steps <= degree);
    return steps == degree;
}

inline Topology topology(const mesh::TriangleMesh& mesh) {
    Topology t;
    const std::size_t count = mesh.positions.size();
    const glm::dvec3 origin = count == 0 ? glm::dvec3(0.0) : glm::dvec3(mesh.positions[0]);
    for (const glm::uvec3& triangle : mesh.triangles) {
        if (triangle.x == triangle.y || triangle.y == triangle.z || triangle.z == triangle.x) ++t.degenerate;
        const glm::dvec3 a = glm::dvec3(mesh.positions[triangle.x]) - origin;
        const glm::dvec3 b = glm::dvec3(mesh.positions[triangle.y]) - origin;
        const glm::dvec3 c = glm::dvec3(mesh.positions[triangle.z]) - origin;
        t.zero_area += glm::length(glm::cross(b - a, c - a)) == 0.0 ? 1 : 0;
        t.volume += glm::dot(a, glm::cross(b, c)) / 6.0;
    }
    const HalfEdges edges(mesh);
    for (std::uint32_t v = 0; v < count; ++v) {
        const auto around = edges.of(v);
        for (std::size_t n = 0; n < around.size(); ++n) {
            if (n > 0 && around[n].to == around[n - 1].to) ++t.repeated_edges;
            if (edges.find(around[n].to, v) == nullptr) ++t.open_edges;
        }
        if (around.empty())
            ++t.unused_vertices;
        else if (!is_one_ring(mesh, edges, v))
            ++t.split_vertices;
    }
    t.edges = 3 * mesh.triangles.size() / 2;
    t.euler = static_cast<long>(count - t.unused_vertices) - static_cast<long>(t.edges) +
              static_cast<long>(mesh.triangles.size());
    return t;
}

} // namespace ramus::test
