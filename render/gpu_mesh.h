// GpuMesh: a TriangleMesh on the GPU, its triangles sorted by branch, so that hiding a branch or looking past one is a
// matter of which ranges are drawn. Positions are stored relative to `origin` in single precision.
#pragma once

#include "core/mesh/triangle_mesh.h"
#include "render/bounds.h"
#include "render/camera.h"
#include "render/gl_objects.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace ramus::render {

// Which of the two layers a branch is drawn into, if any.
enum class Layer : std::uint8_t { kOpaque, kGlass, kNone };

class GpuMesh {
public:
    explicit GpuMesh(const mesh::TriangleMesh& mesh);

    [[nodiscard]] const Box& bounds() const { return bounds_; }
    [[nodiscard]] glm::dvec3 origin() const { return origin_; }
    [[nodiscard]] int branch_count() const { return static_cast<int>(ranges_.size()); } // largest branch id + 1

    // Draws the branches whose entry in `layers` is `layer` (missing entries are opaque) and that `to_clip` (from
    // positions relative to origin) leaves in the picture. Returns the number of triangles drawn.
    std::uint64_t draw(const std::vector<Layer>& layers, Layer layer, const glm::dmat4& to_clip) const;

private:
    struct Range {
        std::uint32_t first = 0, count = 0; // triangles
        glm::vec3 lower{0.0F}, upper{0.0F}; // relative to origin
    };
    Box bounds_;
    glm::dvec3 origin_{0.0};
    std::vector<Range> ranges_;
    VertexArray vertex_array_;
    Buffer vertices_, indices_;
};

} // namespace ramus::render
