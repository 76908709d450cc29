// SurfaceSink: takes a surface part by part while it is made, when the whole is more than memory holds. The parts
// together are the mesh that polygonizing it as a whole gives, the same to the last bit and in the same order.
#pragma once

#include "core/mesh/triangle_mesh.h"

#include <cstddef>
#include <cstdint>
#include <span>

namespace ramus::mesh {

// The triangles of one part of the surface.
struct TrianglePart {
    // Corners with this bit are vertices of `added`, by their place there; the others are places among all that
    // add_vertices() brought.
    static constexpr std::uint32_t kAddedBit = 0x80000000U;

    std::size_t part = 0;
    std::span<const glm::uvec3> triangles;
    VertexSpan added;    // vertices of this part alone, which stand behind all others in the mesh
    VertexSpan vertices; // all that were added, of which only those that these triangles name can be read

    [[nodiscard]] glm::vec3 position(std::uint32_t corner) const {
        return (corner & kAddedBit) != 0 ? added.positions[corner & ~kAddedBit] : vertices.positions[corner];
    }
};

// Called from one thread at a time. `false`: it cannot take any more, and the surface need not be made further.
class SurfaceSink {
public:
    SurfaceSink() = default;
    SurfaceSink(const SurfaceSink&) = delete;
    SurfaceSink& operator=(const SurfaceSink&) = delete;
    virtual ~SurfaceSink() = default;

    // The next vertices, in the mesh's order.
    [[nodiscard]] virtual bool add_vertices(const VertexSpan& vertices) = 0;
    // A part's triangles. In the mesh parts stand in the order of their numbers; here they come in any.
    [[nodiscard]] virtual bool add_triangles(const TrianglePart& part) = 0;
};

} // namespace ramus::mesh
