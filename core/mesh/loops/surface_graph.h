// SurfaceGraph: the edges of a closed surface, with the two triangles of each edge and the edges at each vertex.
#pragma once

#include "core/base/grouped.h"
#include "core/mesh/triangle_mesh.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace ramus::mesh {

struct SurfaceEdge {
    std::array<std::uint32_t, 2> ends{}; // ascending
    std::array<std::uint32_t, 2> triangles{};
};

class SurfaceGraph {
public:
    // The surface must outlive the graph.
    explicit SurfaceGraph(const TriangleMesh& mesh);

    [[nodiscard]] const TriangleMesh& mesh() const { return *mesh_; }
    // Whether every edge has two triangles. If not, the graph is empty.
    [[nodiscard]] bool is_closed() const { return closed_; }
    [[nodiscard]] std::span<const SurfaceEdge> edges() const { return edges_; }
    [[nodiscard]] std::span<const std::uint32_t> edges_at(std::uint32_t vertex) const { return at_.of(vertex); }
    [[nodiscard]] double length(std::uint32_t edge) const; // mm
    [[nodiscard]] std::uint32_t other_end(std::uint32_t edge, std::uint32_t vertex) const {
        const auto& [a, b] = edges_[edge].ends;
        return a == vertex ? b : a;
    }

private:
    const TriangleMesh* mesh_;
    bool closed_ = true;
    std::vector<SurfaceEdge> edges_;
    Grouped<std::uint32_t> at_; // edges at each vertex
};

} // namespace ramus::mesh
