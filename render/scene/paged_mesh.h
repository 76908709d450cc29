// PagedMesh: a surface in the layout of the graphics card, divided into pages. An immutable value: an edited surface is
// another PagedMesh that shares all unchanged pages. Earlier surfaces (on the screen, in undo) stay complete, any
// thread may read them, and a copy on the graphics card is updated by comparing pointers.
//
// The input mesh may have gaps: triangles without area are omitted, and unused vertices have no effect. Positions are
// single precision, mm relative to `origin`.
//
// The pages of a large mesh are adjacent in memory that a software rasteriser may share (PageMemory).
//
// It may have a value per vertex for a colour scale (ColourScale::Value::kSurface). Values have their own pages, so
// that surfaces with and without values share everything else.
#pragma once

#include "core/base/shared_pages.h"
#include "core/mesh/triangle_mesh.h"
#include "render/scene/bounds.h"
#include "render/scene/uniform_blocks.h"

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace ramus::field {
class SurfaceProjector;
}

namespace ramus::render {

struct GpuVertex {
    glm::vec3 position;
    std::int32_t branch;
    field::Dominance dominance;         // of the branch over other branches
    std::array<std::int16_t, 4> normal; // signed normalised; the last is unused
};
static_assert(sizeof(GpuVertex) == 28);

// Pages are small enough to bound changes and culling closely, and large enough that a surface has only some hundred.
struct VertexPage {
    static constexpr std::size_t kSize = 2048;
    std::array<GpuVertex, kSize> vertices;
};

// Triangles sorted by branch, so that branches can be hidden without a new mesh: first those whose corners belong to
// one branch, then those on borders between branches.
struct TrianglePage {
    static constexpr std::size_t kSize = 2048;
    struct Run {
        std::int32_t branch;
        std::uint32_t first, count;
    };
    std::vector<Run> runs;
    std::uint32_t first_border = 0, count = 0;        // triangles
    std::vector<std::array<std::int32_t, 2>> borders; // pairs of adjacent branches, each once, the lower first
    glm::vec3 lower{0.0F}, upper{0.0F};               // relative to origin
    float longest_edge = 0.0F;                        // mm
    std::span<const glm::uvec3> triangles;            // kSize; degenerate from `count` on
    std::shared_ptr<const void> memory;               // owner of `triangles`
};
inline constexpr std::size_t kTrianglePageBytes = TrianglePage::kSize * sizeof(glm::uvec3);

// Contiguous memory for the pages of a mesh that was built at once, with a reserve. Pages added by edits are elsewhere.
struct PageMemory {
    std::shared_ptr<const SharedPages> vertices, triangles;

    // Null: the system has no such memory.
    [[nodiscard]] static std::shared_ptr<const PageMemory> make(std::size_t vertex_pages, std::size_t triangle_pages);
    [[nodiscard]] VertexPage* vertex_page(std::size_t number) const {
        return reinterpret_cast<VertexPage*>(vertices->data()) + number;
    }
    [[nodiscard]] glm::uvec3* triangle_page(std::size_t number) const {
        return reinterpret_cast<glm::uvec3*>(triangles->data() + number * kTrianglePageBytes);
    }
    [[nodiscard]] std::size_t vertex_pages() const { return vertices->bytes() / sizeof(VertexPage); }
    [[nodiscard]] std::size_t triangle_pages() const { return triangles->bytes() / kTrianglePageBytes; }
};

// Values of the vertices of a page; kNotKnown if missing. Between a known and an unknown value the value is unknown.
struct ValuePage {
    std::array<float, VertexPage::kSize> values;
};

class PagedMesh {
public:
    using ValuePages = std::vector<std::shared_ptr<const ValuePage>>;
    using VertexPages = std::vector<std::shared_ptr<const VertexPage>>;
    using TrianglePages = std::vector<std::shared_ptr<const TrianglePage>>;

    PagedMesh() = default;
    // The origin is the middle of the mesh's bounds, or the given point. All surfaces of one tree must have the same
    // origin.
    explicit PagedMesh(const mesh::TriangleMesh& mesh);
    PagedMesh(const mesh::TriangleMesh& mesh, const glm::dvec3& origin);
    // The surface after `edit`: this is the surface before, `mesh` the result. Values are dropped, since they are
    // outdated.
    [[nodiscard]] PagedMesh edited(const mesh::TriangleMesh& mesh, const mesh::SurfaceEdit& edit) const;

    [[nodiscard]] const Box& bounds() const { return bounds_; }
    [[nodiscard]] const glm::dvec3& origin() const { return origin_; }
    [[nodiscard]] int branch_count() const { return branch_count_; } // largest branch id + 1
    [[nodiscard]] std::uint64_t triangle_count() const { return triangle_count_; }
    [[nodiscard]] const VertexPages& vertex_pages() const { return vertex_pages_; }
    [[nodiscard]] const TrianglePages& triangle_pages() const { return triangle_pages_; }
    // Null: pages are allocated one by one. A page belongs to this memory if its address does.
    [[nodiscard]] const std::shared_ptr<const PageMemory>& memory() const { return memory_; }
    static constexpr std::size_t kSharedFrom = std::size_t{32}
                                               << 20; // bytes of pages; smaller meshes are quickly copied
    // Bytes of the pages that `other` does not have at the same index.
    [[nodiscard]] std::size_t bytes_beside(const PagedMesh& other) const;

    // The exact surface that the mesh approximates, for close views; null: unknown. edited() drops it.
    [[nodiscard]] const std::shared_ptr<const field::SurfaceProjector>& projector() const { return projector_; }
    void set_projector(std::shared_ptr<const field::SurfaceProjector> projector) { projector_ = std::move(projector); }

    // The same surface with these values by vertex; vertices without an entry have kNotKnown.
    [[nodiscard]] PagedMesh with_values(std::span<const float> values) const;
    [[nodiscard]] const ValuePages& value_pages() const { return value_pages_; } // parallel to vertex_pages(), or empty
    [[nodiscard]] bool has_values() const { return !value_pages_.empty(); }

    // Indices of the vertices that triangles use, ascending; and a vertex's position in mm.
    [[nodiscard]] std::vector<std::uint32_t> used_vertices() const;
    [[nodiscard]] glm::vec3 position(std::uint32_t vertex) const {
        return glm::vec3(origin_ + glm::dvec3(this->vertex(vertex).position));
    }
    [[nodiscard]] const GpuVertex& vertex(std::uint32_t number) const {
        return vertex_pages_[number / VertexPage::kSize]->vertices[number % VertexPage::kSize];
    }
    [[nodiscard]] float value(std::uint32_t vertex) const { // requires has_values()
        return value_pages_[vertex / VertexPage::kSize]->values[vertex % VertexPage::kSize];
    }

    // Positions in mm of the used vertices of branches that `wanted` accepts. Takes a few milliseconds for a million
    // triangles.
    [[nodiscard]] std::vector<glm::vec3> positions(const std::function<bool(int)>& wanted = {}) const;

    // Of the positions of branches that `wanted` accepts: the farthest along each direction (of any length), which
    // suffice to fit a box or a camera (fitting_directions()). Examines few triangles. Empty: no branch is wanted.
    [[nodiscard]] std::vector<glm::vec3> farthest(std::span<const glm::dvec3> directions,
                                                  const std::function<bool(int)>& wanted = {}) const;

private:
    void summarise();

    VertexPages vertex_pages_;
    TrianglePages triangle_pages_;
    ValuePages value_pages_;
    std::shared_ptr<const PageMemory> memory_;
    std::shared_ptr<const field::SurfaceProjector> projector_;
    Box bounds_;
    glm::dvec3 origin_{0.0};
    int branch_count_ = 0;
    std::uint64_t triangle_count_ = 0;
};

// Shares a surface with a window. A large surface has about ten thousand allocations; they are released on another
// thread, because the window's thread may hold the last reference.
[[nodiscard]] std::shared_ptr<const PagedMesh> shared(PagedMesh mesh);

} // namespace ramus::render
