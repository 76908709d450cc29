// GpuMesh: a TriangleMesh on the GPU, its triangles sorted by branch, so that hiding a branch or looking past one is a
// matter of which ranges are drawn. Positions are stored relative to `origin` in single precision.
//
// A large mesh has a coarse version as well, about a tenth of the triangles, for while the view moves: its vertices are
// gathered in cells of half to one local radius, so that trunks and twigs lose alike. It shares the vertices and may
// have small cracks; pictures that are kept never show it.
#pragma once

#include "core/mesh/triangle_mesh.h"
#include "render/bounds.h"
#include "render/camera.h"
#include "render/gl_objects.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace ramus::render {

// Which of the two layers a branch is drawn into, if any.
enum class Layer : std::uint8_t { kOpaque, kGlass, kNone };

struct GpuVertex {
    glm::vec3 position;
    std::array<std::int16_t, 4> normal; // signed normalised
    std::int32_t branch;
};
static_assert(sizeof(GpuVertex) == 24);

class GpuMesh {
public:
    explicit GpuMesh(const mesh::TriangleMesh& mesh);

    [[nodiscard]] const Box& bounds() const { return bounds_; }
    [[nodiscard]] glm::dvec3 origin() const { return origin_; }
    [[nodiscard]] int branch_count() const { return static_cast<int>(ranges_.size()); } // largest branch id + 1

    // Draws the branches whose entry in `layers` is `layer` (missing entries are opaque) and that `to_clip` (from
    // positions relative to origin) leaves in the picture. Returns the number of triangles drawn.
    std::uint64_t draw(const std::vector<Layer>& layers, Layer layer, const glm::dmat4& to_clip, bool coarse) const;

private:
    struct Range {
        std::uint32_t first = 0, count = 0; // triangles
        glm::vec3 lower{0.0F}, upper{0.0F}; // relative to origin
    };
    static std::vector<Range> append_by_branch(std::span<const glm::uvec3> triangles,
                                               const std::vector<GpuVertex>& vertices, std::size_t branch_count,
                                               std::vector<glm::uvec3>& sorted);

    Box bounds_;
    glm::dvec3 origin_{0.0};
    // Ranges into one index buffer: the fine triangles by branch, then the coarse ones.
    std::vector<Range> ranges_, coarse_ranges_;
    VertexArray vertex_array_;
    Buffer vertices_, indices_;
};

} // namespace ramus::render
