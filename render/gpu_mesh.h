// GpuMesh: a copy of a PagedMesh on the graphics card that follows it from one state to the next. Only pages that
// differ are sent: a small change at once and in place; a large one beside what is there, some at every call, which
// goes on being drawn until all has come. States, colours and views send nothing.
#pragma once

#include "render/gl_objects.h"
#include "render/layer.h"
#include "render/paged_mesh.h"

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <memory>
#include <vector>

namespace ramus::render {

class GpuMesh {
public:
    // Takes up `mesh` (null: lets go of everything), sending about `budget` bytes at most, and subtracts what it sent.
    // A mesh of another origin leaves nothing of the old one to be drawn.
    void follow(const std::shared_ptr<const PagedMesh>& mesh, std::size_t& budget);
    // What is drawn: the mesh last given to follow(), or the one before until that has come; null: nothing.
    [[nodiscard]] const std::shared_ptr<const PagedMesh>& shown() const { return shown_; }

    // Draws the branches whose entry in `layers` is `layer` (missing entries are opaque) of the pages that `to_clip`
    // (from positions relative to origin) leaves in the picture, as far as their triangles go that are one branch's.
    // Returns the number of triangles drawn.
    std::uint64_t draw(const std::vector<Layer>& layers, Layer layer, const glm::dmat4& to_clip) const;
    // The triangles where branches meet, for programs that tell whose each place is (shaders/border.glsl): those of
    // pages where a branch of this layer meets another.
    std::uint64_t draw_borders(const std::vector<Layer>& layers, Layer layer, const glm::dmat4& to_clip) const;
    // Of the pages that would be looked at, with branches of any layer.
    [[nodiscard]] std::uint64_t triangles_in_picture(const glm::dmat4& to_clip) const;

private:
    // Buffers and what is in them, page by page.
    struct Copy {
        VertexArray vertex_array;
        Buffer vertices, triangles;
        PagedMesh::VertexPages vertex_pages;
        PagedMesh::TrianglePages triangle_pages;

        explicit Copy(const PagedMesh& mesh); // room for it, and for growth
        [[nodiscard]] bool has_room(const PagedMesh& mesh) const;
        [[nodiscard]] std::size_t missing(const PagedMesh& mesh) const; // bytes
        bool send(const PagedMesh& mesh, std::size_t& budget);          // true: all is there
    };

    class Ranges;
    std::uint64_t draw(const Ranges& ranges) const;

    std::unique_ptr<Copy> drawn_, coming_;
    std::shared_ptr<const PagedMesh> shown_;
};

} // namespace ramus::render
