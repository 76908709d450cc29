// TriangleMesh: an indexed triangle surface in mm (RAS) whose vertices know where they came from. Arrays are either
// empty or as long as `positions`. A plain value; large ones are shared as shared_ptr<const TriangleMesh>.
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
    LargeArray<field::Dominance> dominance; // how clearly it does; between vertices they say where branches end

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
    // Where its arrays are, and arrays as large should be.
    [[nodiscard]] LargeAllocator<std::byte> memory() const { return triangles.get_allocator(); }

    LargeArray<glm::uvec3> triangles; // counter-clockwise seen from outside
    bool operator==(const TriangleMesh&) const = default;
};

// Some or all of a mesh's vertices, in whichever arrays they are.
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

// Which parts of a mesh were rewritten, so that a copy of it (on the graphics card, say) can follow.
struct SurfaceEdit {
    bool whole = false; // everything; the ranges do not matter
    std::vector<SlotRange> vertices, triangles;
};

} // namespace ramus::mesh
