// EdgeBalance: whether a surface that comes in parts is closed, found in little memory.
//
// In a closed surface every edge that one triangle runs along in one direction, another one runs along in the other.
// Each direction adds a number that is scattered from the edge's two vertices, or takes it away: the sum is 0. An open
// surface has a sum of 0 by chance alone, once in 2^64. Guaranteed: a closed surface passes. Not found: an edge with
// two triangles in each direction. Sums are kept for every thousand vertices, 20 bytes for each, so that an error can
// say where. Takes 7 ns for a triangle.
#pragma once

#include "core/base/error.h"
#include "core/mesh/triangle_mesh.h"

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace ramus::mesh {

class EdgeBalance {
public:
    // `vertices`: all that were added so far, of which those that the triangles name can be read.
    void add(std::span<const glm::uvec3> triangles, const VertexSpan& vertices);
    // The error says how many places are open, and where the first is.
    [[nodiscard]] Result<void> check() const;

private:
    struct Place {
        std::uint64_t sum = 0;
        glm::vec3 at{0.0F}; // of one of its vertices
    };
    std::vector<Place> places_; // by an edge's lower vertex
};

// Of a whole surface.
[[nodiscard]] Result<void> check_balance(const TriangleMesh& mesh);

} // namespace ramus::mesh
