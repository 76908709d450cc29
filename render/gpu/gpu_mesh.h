// GpuMesh: a copy of a PagedMesh on the graphics card that follows it from one state to the next. Only pages that
// differ are sent: a small change at once and in place; a large one beside what is there, some at every call, which
// goes on being drawn until all has come. States, colours and views send nothing. Where the processor draws, the pages
// of a large mesh are shared with it (PageMemory): nothing is sent of them, and they are there once.
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
    // What a copy of `mesh` takes, and what there is, in bytes.
    [[nodiscard]] static std::size_t bytes_of(const PagedMesh& mesh);
    [[nodiscard]] std::size_t bytes() const;
    // Takes up `mesh` (null: lets go of everything), sending about `budget` bytes at most, and subtracts what it sent.
    // A mesh of another origin leaves nothing of the old one to be drawn.
    void follow(const std::shared_ptr<const PagedMesh>& mesh, std::size_t& budget);
    // What is drawn: the mesh last given to follow(), or the one before until that has come; null: nothing.
    [[nodiscard]] const std::shared_ptr<const PagedMesh>& shown() const { return shown_; }
    // Draws `surface`, of what is shown now, in place of those of its pages, until something else is shown.
    void come_near(NearSurface surface);

    // Triangles that are drawn together: stretches of the index buffer, in parts that a software rasteriser takes a
    // few milliseconds for.
    class Ranges {
    public:
        [[nodiscard]] std::uint64_t triangles() const { return triangles_; }
        [[nodiscard]] std::size_t parts() const { return parts_.size(); }

    private:
        friend GpuMesh;
        struct Part {
            std::size_t begin; // in what follows
            bool near;         // of the near surface
        };
        void add(std::size_t first, std::size_t count, bool near);
        std::vector<GLsizei> counts_; // of indices
        std::vector<const void*> offsets_;
        std::vector<Part> parts_;
        std::size_t end_ = 0;     // of the last stretch
        std::size_t in_part_ = 0; // triangles of the last part
        std::uint64_t triangles_ = 0;
    };

    // The branches whose entry in `layers` is `layer` (missing entries are opaque) of the pages that `to_clip` (from
    // positions relative to origin) leaves in the picture, as far as their triangles go that are one branch's.
    [[nodiscard]] Ranges choose(const std::vector<Layer>& layers, Layer layer, const glm::dmat4& to_clip) const;
    // The triangles where branches meet, for programs that tell whose each point is (shaders/border.glsl): those of
    // pages where a branch of this layer meets another.
    [[nodiscard]] Ranges choose_borders(const std::vector<Layer>& layers, Layer layer, const glm::dmat4& to_clip) const;
    void draw_part(const Ranges& ranges, std::size_t part) const;
    [[nodiscard]] std::uint64_t draw(const Ranges& ranges) const; // all of them; returns how many triangles
    // Of the pages that would be looked at, with branches of any layer.
    [[nodiscard]] std::uint64_t triangles_in_picture(const glm::dmat4& to_clip) const;

private:
    // call(page, its first triangle, whether it is the near surface's) for those in the picture.
    template <class Call> void for_pages(const glm::dmat4& to_clip, const Call& call) const;

    // Buffers and what is in them, page by page.
    struct Copy {
        VertexArray vertex_array;
        LargeBuffer vertices, triangles, values; // the last when it has any
        PagedMesh::VertexPages vertex_pages;
        PagedMesh::TrianglePages triangle_pages;
        PagedMesh::ValuePages value_pages;

        explicit Copy(const PagedMesh& mesh); // for it, and a reserve for growth; shares its memory where it can
        void set_out();
        [[nodiscard]] bool fits(const PagedMesh& mesh) const;
        [[nodiscard]] std::size_t bytes() const;
        [[nodiscard]] std::size_t missing(const PagedMesh& mesh) const; // bytes
        void make_room_for_values();
        bool send(const PagedMesh& mesh, std::size_t& budget); // true: all is there
    };

    void show(const std::shared_ptr<const PagedMesh>& mesh);

    std::unique_ptr<Copy> drawn_, coming_, near_copy_;
    std::shared_ptr<const PagedMesh> shown_;
    NearSurface near_; // of that
};

} // namespace ramus::render
