// TriangleMesh: an indexed triangle mesh in mm (RAS), with a branch and a local radius for each vertex. Vertex arrays
// are either empty or as long as `positions`. A plain value; large meshes are shared as shared_ptr<const TriangleMesh>.
#pragma once

#include "core/base/large_array.h"
#include "core/field/dominance.h"

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>

namespace ramus::mesh {

struct VertexArrays {
    VertexArrays() = default;
    explicit VertexArrays(const LargeAllocator<std::byte>& memory)
        : positions(memory), normals(memory), radii(memory), branches(memory), dominance(memory) {}

    LargeArray<glm::vec3> positions;        // mm
    LargeArray<glm::vec3> normals;          // unit length, outward
    LargeArray<float> radii;                // local vessel radius in mm
    LargeArray<std::int32_t> branches;      // id of the dominating branch
    LargeArray<field::Dominance> dominance; // by how much that branch dominates, to draw borders between branches

    template <class Call> void for_each_array(const Call& call) {
        call(positions), call(normals), call(radii), call(branches), call(dominance);
    }
    void resize_vertices(std::size_t count) {
        for_each_array([&](auto& array) { array.resize(count); });
    }
    bool operator==(const VertexArrays&) const = default;
};

struct TriangleMesh : VertexArrays {
    TriangleMesh() = default;
    explicit TriangleMesh(const LargeAllocator<std::byte>& memory) : VertexArrays(memory), triangles(memory) {}
    // The allocator of the arrays (memory or disk). Other arrays of the mesh's size should use it, too.
    [[nodiscard]] LargeAllocator<std::byte> memory() const { return triangles.get_allocator(); }

    LargeArray<glm::uvec3> triangles; // counter-clockwise seen from outside
    bool operator==(const TriangleMesh&) const = default;
};

// A view of some or all vertices of a mesh.
struct VertexSpan {
    std::span<const glm::vec3> positions, normals;
    std::span<const float> radii;
    std::span<const std::int32_t> branches;

    [[nodiscard]] std::size_t size() const { return positions.size(); }
};

[[nodiscard]] inline VertexSpan vertices_of(const TriangleMesh& mesh) {
    return {mesh.positions, mesh.normals, mesh.radii, mesh.branches};
}

struct SlotRange {
    std::uint64_t first = 0, count = 0;
};

// The parts of a mesh that were rewritten, so that a copy (such as that on the graphics card) can be updated.
struct SurfaceEdit {
    bool whole = false; // everything was rewritten; the ranges have no meaning
    std::vector<SlotRange> vertices, triangles;
};

} // namespace ramus::mesh
