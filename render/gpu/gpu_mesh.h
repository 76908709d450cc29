// GpuMesh: a copy of a PagedMesh on the graphics card, updated incrementally. Only pages that differ are sent. Small
// changes are sent at once and in place. Large changes go to a second copy over several calls, while the old copy is
// still drawn. States, colours and views send nothing. A software rasteriser shares the pages of a large mesh
// (PageMemory), so that nothing is sent and memory holds them once.
#pragma once

#include "render/gl/gl_objects.h"
#include "render/scene/layer.h"
#include "render/scene/near_surface.h"
#include "render/scene/paged_mesh.h"

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <memory>
#include <vector>

namespace ramus::render {

class GpuMesh {
public:
    // Size of a copy of `mesh`, and of this copy, in bytes.
    [[nodiscard]] static std::size_t bytes_of(const PagedMesh& mesh);
    [[nodiscard]] std::size_t bytes() const;
    // Follows `mesh` (null: releases everything). Sends at most about `budget` bytes and subtracts what it sent. A mesh
    // with another origin discards the old copy at once.
    void follow(const std::shared_ptr<const PagedMesh>& mesh, std::size_t& budget);
    // The mesh that is drawn: the last one given to follow(), or its predecessor until it has arrived; null: none.
    [[nodiscard]] const std::shared_ptr<const PagedMesh>& shown() const { return shown_; }
    // From now on draws `surface` in place of the pages of shown() that it replaces, until another mesh is shown.
    void use_near_surface(NearSurface surface);

    // Triangles that are drawn together: ranges of the index buffer, in parts that take a software rasteriser a few
    // milliseconds.
    class Ranges {
    public:
        [[nodiscard]] std::uint64_t triangles() const { return triangles_; }
        [[nodiscard]] std::size_t parts() const { return parts_.size(); }

    private:
        friend GpuMesh;
        struct Part {
            std::size_t begin; // index into counts_, offsets_
            bool near;         // belongs to the near surface
        };
        void add(std::size_t first, std::size_t count, bool near);
        std::vector<GLsizei> counts_; // in indices
        std::vector<const void*> offsets_;
        std::vector<Part> parts_;
        std::size_t end_ = 0;     // of the last range
        std::size_t in_part_ = 0; // triangles of the last part
        std::uint64_t triangles_ = 0;
    };

    // Chooses the triangles that belong to one branch with this layer (branches without an entry are opaque), on the
    // pages that may be visible. `to_clip`: from positions relative to the origin.
    [[nodiscard]] Ranges choose(const std::vector<Layer>& layers, Layer layer, const glm::dmat4& to_clip) const;
    // Chooses the triangles where branches meet, for programs that determine the branch per point
    // (shaders/border.glsl), on pages where a branch of this layer meets another.
    [[nodiscard]] Ranges choose_borders(const std::vector<Layer>& layers, Layer layer, const glm::dmat4& to_clip) const;
    void draw_part(const Ranges& ranges, std::size_t part) const;
    [[nodiscard]] std::uint64_t draw(const Ranges& ranges) const; // all parts; returns the number of triangles
    // Number of triangles on the pages that may be visible, of all layers.
    [[nodiscard]] std::uint64_t triangles_in_picture(const glm::dmat4& to_clip) const;

private:
    // Calls call(page, its first triangle, whether it is of the near surface) for the pages that may be visible.
    template <class Call> void for_pages(const glm::dmat4& to_clip, const Call& call) const;

    // Buffers, and the pages that they hold.
    struct Copy {
        VertexArray vertex_array;
        LargeBuffer vertices, triangles, values; // `values`: if it has any
        PagedMesh::VertexPages vertex_pages;
        PagedMesh::TrianglePages triangle_pages;
        PagedMesh::ValuePages value_pages;

        explicit Copy(const PagedMesh& mesh); // with a reserve for growth; shares its memory if possible
        void set_out();
        [[nodiscard]] bool fits(const PagedMesh& mesh) const;
        [[nodiscard]] std::size_t bytes() const;
        [[nodiscard]] std::size_t missing(const PagedMesh& mesh) const; // bytes
        void make_room_for_values();
        bool send(const PagedMesh& mesh, std::size_t& budget); // true: complete
    };

    void show(const std::shared_ptr<const PagedMesh>& mesh);

    std::unique_ptr<Copy> drawn_, coming_, near_copy_;
    std::shared_ptr<const PagedMesh> shown_;
    NearSurface near_; // of shown_
};

} // namespace ramus::render
