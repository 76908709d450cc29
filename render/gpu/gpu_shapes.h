// GpuShapes: meshes beside the tree on the graphics card, those of context and of lesions alike, and the ball that
// lesions of a centre and a radius are. A mesh is sent once and stays as long as the frame names it, as triangles that
// share vertices or, for lines, as triangles of their own.
#pragma once

#include "render/gl/gl_objects.h"
#include "render/gpu/shape_triangles.h"
#include "render/scene/bounds.h"
#include "render/scene/scene.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace ramus::render {

class Shape {
public:
    enum class As : std::uint8_t { kSurface, kLines };
    Shape(const mesh::TriangleMesh& mesh, As as);

    [[nodiscard]] const std::shared_ptr<const ShapeTriangles>& made_of() const { return made_of_; }
    [[nodiscard]] const Box& bounds() const { return made_of_->bounds; }
    [[nodiscard]] bool lines() const { return as_ == As::kLines; }
    [[nodiscard]] bool closed() const { return made_of_->closed; }
    // Positions are attribute 0, normals 1; returns the number of triangles.
    [[nodiscard]] std::uint64_t draw() const;

private:
    std::shared_ptr<const ShapeTriangles> made_of_;
    As as_;
    GLsizei corners_ = 0;
    VertexArray vertex_array_;
    Buffer vertices_, triangles_;
};

class GpuShapes {
public:
    // Sends what is new and lets go of what is no longer there. What is not shown is not sent.
    void follow(const std::vector<ContextMesh>& context, const Lesions& lesions);

    // Of what is shown and was given to follow(), else null. Of context the preview, if there is one and that will do.
    [[nodiscard]] const Shape* of(const ContextMesh& context, bool preview_will_do) const;
    [[nodiscard]] const Shape* of(const std::shared_ptr<const mesh::TriangleMesh>& lesion) const;
    [[nodiscard]] const Shape* ball() const { return ball_ ? &*ball_ : nullptr; } // of radius 1 about the origin
    [[nodiscard]] Box bounds(const std::vector<ContextMesh>& context) const;      // of all that are shown; mm

private:
    struct Sent {
        std::shared_ptr<const mesh::TriangleMesh> mesh;
        Shape::As as;
        Shape shape;
    };
    [[nodiscard]] const Shape* find(const std::shared_ptr<const mesh::TriangleMesh>& mesh, Shape::As as) const;
    std::vector<Sent> sent_;
    std::optional<Shape> ball_;
};

} // namespace ramus::render
