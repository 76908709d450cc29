// SurfaceSink: takes a surface as it is made, when the whole is more than memory holds. What it is given, one after the
// other, is the mesh that polygonizing it as a whole gives, to the last bit.
#pragma once

#include "core/mesh/triangle_mesh.h"

#include <span>

namespace ramus::mesh {

// Called from one thread at a time. `false`: it cannot take any more, and the surface need not be made further.
class SurfaceSink {
public:
    SurfaceSink() = default;
    SurfaceSink(const SurfaceSink&) = delete;
    SurfaceSink& operator=(const SurfaceSink&) = delete;
    virtual ~SurfaceSink() = default;

    [[nodiscard]] virtual bool add_vertices(const VertexSpan& more) = 0;
    // `vertices`: all that were added so far, of which only those that these triangles name can be read.
    [[nodiscard]] virtual bool add_triangles(std::span<const glm::uvec3> more, const VertexSpan& vertices) = 0;
};

} // namespace ramus::mesh
