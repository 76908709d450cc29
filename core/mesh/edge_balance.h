// EdgeBalance: whether a surface that comes in parts is closed, found in little memory.
//
// In a closed surface every edge that one triangle runs along in one direction, another one runs along in the other.
// Each direction adds a number that is scattered from the edge's two vertices, or takes it away: the sum is 0. An open
// surface has a sum of 0 by chance alone, once in 2^64. Guaranteed: a closed surface passes. Not found: an edge with
// two triangles in each direction. Sums are kept for every thousand vertices, so that an error can say where; they take
// 20 bytes each.
#pragma once

#include "core/base/error.h"
#include "core/mesh/triangle_mesh.h"

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace ramus::mesh {

class EdgeBalance {
public:
    void add_vertices(std::span<const glm::vec3> more);   // mm
    void add_triangles(std::span<const glm::uvec3> more); // of vertices that were added
    // The error says where the surface is open first, and how many other places there are.
    [[nodiscard]] Result<void> check() const;

private:
    std::size_t vertices_ = 0;
    // By an edge's lower vertex.
    std::vector<std::uint64_t> sums_;
    std::vector<glm::vec3> places_; // of the first vertex, mm
};

// Of a whole surface.
[[nodiscard]] Result<void> check_balance(const TriangleMesh& mesh);

} // namespace ramus::mesh
