// PagedMesh: a surface as the graphics card takes it, cut into pages. An immutable value: a changed surface is another
// PagedMesh that shares every page which did not change. So earlier ones (the picture on the screen, undo) stay whole,
// any thread may read any of them, and a copy on the graphics card follows by comparing pointers.
//
// It may be made from a mesh with gaps: triangles without area are left out, and vertices that no triangle uses
// influence nothing. Positions are single precision relative to `origin`.
//
// Of a large mesh all pages lie side by side in memory that a copy for a software rasteriser may share (PageMemory).
//
// It may have a value for each vertex, of any quantity that a scale of colours shows (ColourScale::Value::kSurface):
// pages of their own, so that a surface with values shares all else with the one without.
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
    field::Dominance dominance;         // of the branch over others
    std::array<std::int16_t, 4> normal; // signed normalised; the last is nothing
};
static_assert(sizeof(GpuVertex) == 28);

// Pages are small enough to follow a change closely and to tell what the view leaves out, and large enough that a
// surface has some hundred of them.
struct VertexPage {
    static constexpr std::size_t kSize = 2048;
    std::array<GpuVertex, kSize> vertices;
};

// Triangles sorted by branch, so that hiding a branch or looking past one is a matter of which are drawn: those whose
// corners have one branch, and then those on borders between branches, which run through them.
struct TrianglePage {
    static constexpr std::size_t kSize = 2048;
    struct Run {
        std::int32_t branch;
        std::uint32_t first, count;
    };
    std::vector<Run> runs;
    std::uint32_t first_border = 0, count = 0;        // triangles
    std::vector<std::array<std::int32_t, 2>> borders; // branches that meet, each pair once, the lower first
    glm::vec3 lower{0.0F}, upper{0.0F};               // relative to origin
    float longest_edge = 0.0F;                        // mm
    std::span<const glm::uvec3> triangles;            // kSize of them, without area from `count` on
    std::shared_ptr<const void> memory;               // in which they are
};
inline constexpr std::size_t kTrianglePageBytes = TrianglePage::kSize * sizeof(glm::uvec3);

// Where the pages of a mesh lie, by their number, that was made in one go, and room behind them. Pages that came later
// lie elsewhere.
struct PageMemory {
    std::shared_ptr<const SharedPages> vertices, triangles;

    // For so many pages; null: the system has none.
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

// Of vertices, as a page has them; kNotKnown where there is none. What lies between a value that is known and one that
// is not is not known either.
struct ValuePage {
    std::array<float, VertexPage::kSize> values;
};

class PagedMesh {
public:
    using ValuePages = std::vector<std::shared_ptr<const ValuePage>>;
    using VertexPages = std::vector<std::shared_ptr<const VertexPage>>;
    using TrianglePages = std::vector<std::shared_ptr<const TrianglePage>>;

    PagedMesh() = default;
    // Relative to the middle of its bounds, or to a given point: surfaces of one tree shall have the same.
    explicit PagedMesh(const mesh::TriangleMesh& mesh);
    PagedMesh(const mesh::TriangleMesh& mesh, const glm::dvec3& origin);
    // What `mesh` has become: this is what it was before `edit`. Values do not go on: they would be of another surface.
    [[nodiscard]] PagedMesh edited(const mesh::TriangleMesh& mesh, const mesh::SurfaceEdit& edit) const;

    [[nodiscard]] const Box& bounds() const { return bounds_; }
    [[nodiscard]] const glm::dvec3& origin() const { return origin_; }
    [[nodiscard]] int branch_count() const { return branch_count_; } // largest branch id + 1
    [[nodiscard]] std::uint64_t triangle_count() const { return triangle_count_; }
    [[nodiscard]] const VertexPages& vertex_pages() const { return vertex_pages_; }
    [[nodiscard]] const TrianglePages& triangle_pages() const { return triangle_pages_; }
    // Null: every page lies for itself. Which lie there is told by their addresses.
    [[nodiscard]] const std::shared_ptr<const PageMemory>& memory() const { return memory_; }
    static constexpr std::size_t kSharedFrom = std::size_t{32} << 20; // bytes of pages: less is copied soon
    // Of the pages that `other` does not have in the same place.
    [[nodiscard]] std::size_t bytes_beside(const PagedMesh& other) const;

    // What it is a mesh of, for pictures of what is near the eye; null: that is not known. Not of what is made of it by
    // edited().
    [[nodiscard]] const std::shared_ptr<const field::SurfaceProjector>& projector() const { return projector_; }
    void set_projector(std::shared_ptr<const field::SurfaceProjector> projector) { projector_ = std::move(projector); }

    // The same surface with these values, by vertex; vertices beyond their end have kNotKnown.
    [[nodiscard]] PagedMesh with_values(std::span<const float> values) const;
    [[nodiscard]] const ValuePages& value_pages() const { return value_pages_; } // as vertex_pages(), or none
    [[nodiscard]] bool has_values() const { return !value_pages_.empty(); }

    // Numbers of the vertices that triangles use, ascending; and where one is, mm.
    [[nodiscard]] std::vector<std::uint32_t> used_vertices() const;
    [[nodiscard]] glm::vec3 position(std::uint32_t vertex) const {
        return glm::vec3(origin_ + glm::dvec3(this->vertex(vertex).position));
    }
    [[nodiscard]] const GpuVertex& vertex(std::uint32_t number) const {
        return vertex_pages_[number / VertexPage::kSize]->vertices[number % VertexPage::kSize];
    }
    [[nodiscard]] float value(std::uint32_t vertex) const { // of those that have any
        return value_pages_[vertex / VertexPage::kSize]->values[vertex % VertexPage::kSize];
    }

    // Positions in mm of the vertices that triangles use, of the branches that `wanted` accepts. Takes a few
    // milliseconds for a million triangles.
    [[nodiscard]] std::vector<glm::vec3> positions(const std::function<bool(int)>& wanted = {}) const;

    // Of the positions of branches that `wanted` accepts those that lie farthest along any of these directions, of any
    // length: what a box, or a camera (fitting_directions()), is fitted to. Looks at few triangles. Empty: no branch is
    // wanted.
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

// A surface that a window shows. A large one has some ten thousand pieces of memory, and a window's thread may be the
// last to have it: another thread gives them back.
[[nodiscard]] std::shared_ptr<const PagedMesh> shared(PagedMesh mesh);

} // namespace ramus::render
