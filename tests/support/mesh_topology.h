// What a triangle mesh is, topologically, counted from its index triples alone.
#pragma once

#include "core/mesh/triangle_mesh.h"

#include <algorithm>
#include <cstdint>
#include <glm/geometric.hpp>
#include <vector>

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

inline Topology topology(const mesh::TriangleMesh& mesh) {
    Topology t;
    struct Half {
        std::uint32_t to, triangle;
    };
    const std::size_t count = mesh.positions.size();
    // Directed edges by their start.
    std::vector<std::size_t> first(count + 1, 0);
    for (const auto& triangle : mesh.triangles)
        for (int i = 0; i < 3; ++i) ++first[triangle[i] + 1];
    for (std::size_t v = 0; v < count; ++v) first[v + 1] += first[v];
    std::vector<Half> half(first.back());
    std::vector<std::size_t> next(first.begin(), first.end() - 1);
    const glm::dvec3 origin = count == 0 ? glm::dvec3(0.0) : glm::dvec3(mesh.positions[0]);
    for (std::uint32_t n = 0; n < mesh.triangles.size(); ++n) {
        const auto& triangle = mesh.triangles[n];
        if (triangle.x == triangle.y || triangle.y == triangle.z || triangle.z == triangle.x) ++t.degenerate;
        for (int i = 0; i < 3; ++i) half[next[triangle[i]]++] = {triangle[(i + 1) % 3], n};
        const glm::dvec3 a = glm::dvec3(mesh.positions[triangle.x]) - origin;
        const glm::dvec3 b = glm::dvec3(mesh.positions[triangle.y]) - origin;
        const glm::dvec3 c = glm::dvec3(mesh.positions[triangle.z]) - origin;
        t.zero_area += glm::length(glm::cross(b - a, c - a)) == 0.0 ? 1 : 0;
        t.volume += glm::dot(a, glm::cross(b, c)) / 6.0;
    }
    for (std::size_t v = 0; v < count; ++v)
        std::sort(half.begin() + static_cast<std::ptrdiff_t>(first[v]),
                  half.begin() + static_cast<std::ptrdiff_t>(first[v + 1]),
                  [](const Half& a, const Half& b) { return a.to < b.to; });
    const auto has = [&](std::uint32_t from, std::uint32_t to) {
        const auto begin = half.begin() + static_cast<std::ptrdiff_t>(first[from]);
        const auto end = half.begin() + static_cast<std::ptrdiff_t>(first[from + 1]);
        const auto at =
            std::lower_bound(begin, end, to, [](const Half& h, std::uint32_t value) { return h.to < value; });
        return at != end && at->to == to;
    };
    std::size_t directed = 0;
    for (std::uint32_t v = 0; v < count; ++v) {
        const std::size_t degree = first[v + 1] - first[v];
        if (degree == 0) ++t.unused_vertices;
        for (std::size_t n = first[v]; n < first[v + 1]; ++n) {
            ++directed;
            if (n > first[v] && half[n].to == half[n - 1].to) ++t.repeated_edges;
            if (!has(half[n].to, v)) ++t.open_edges;
        }
        // Turn about the vertex: each triangle leads from one of its edges here to the next.
        if (degree == 0) continue;
        std::size_t steps = 0;
        const std::uint32_t start = half[first[v]].to;
        std::uint32_t at = start;
        do {
            const auto begin = half.begin() + static_cast<std::ptrdiff_t>(first[v]);
            const auto end = half.begin() + static_cast<std::ptrdiff_t>(first[v + 1]);
            const auto found =
                std::lower_bound(begin, end, at, [](const Half& h, std::uint32_t value) { return h.to < value; });
            if (found == end || found->to != at) break;
            const auto& triangle = mesh.triangles[found->triangle];
            const int corner = triangle.x == v ? 0 : triangle.y == v ? 1 : 2;
            at = triangle[(corner + 2) % 3];
            ++steps;
        } while (at != start && steps <= degree);
        if (steps != degree) ++t.split_vertices;
    }
    t.edges = directed / 2;
    t.euler = static_cast<long>(count - t.unused_vertices) - static_cast<long>(t.edges) +
              static_cast<long>(mesh.triangles.size());
    return t;
}

} // namespace ramus::test
