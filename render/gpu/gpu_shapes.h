// GpuShapes: meshes beside the tree on the graphics card, those of context and of lesions alike, and the ball that
// lesions of a centre and a radius are. A mesh is sent once and stays as long as the frame names it, as triangles that
// share vertices or, for lines, as triangles of their own. What is sent of context is made beside the window's thread,
// comes some at every call, and is drawn in parts.
#pragma once

#include "render/gl/gl_objects.h"
#include "render/gpu/shape_triangles.h"
#include "render/scene/bounds.h"
#include "render/scene/scene.h"

#include <cstddef>
#include <cstdint>
#include <future>
#include <list>
#include <memory>
#include <optional>
#include <vector>

namespace ramus::render {

class Shape {
public:
    enum class As : std::uint8_t { kSurface, kLines };
    // What is sent of a mesh; any thread may make it.
    struct Made {
        std::shared_ptr<const ShapeTriangles> of;
        As as = As::kSurface;
        std::vector<ShapeTriangles::Vertex> corners; // of lines: those of each triangle
    };
    [[nodiscard]] static Made make(const mesh::TriangleMesh& mesh, As as);
    explicit Shape(Made made); // nothing of it is sent yet
    // Sends about `budget` bytes at most, and subtracts what it sent; true: all is there.
    bool send(std::size_t& budget);

    [[nodiscard]] const std::shared_ptr<const ShapeTriangles>& made_of() const { return made_of_; }
    [[nodiscard]] const Box& bounds() const { return made_of_->bounds; }
    [[nodiscard]] bool lines() const { return as_ == As::kLines; }
    [[nodiscard]] bool closed() const { return made_of_->closed; }
    // In parts that a software rasteriser takes a few milliseconds for. Positions are attribute 0, normals 1; returns
    // the number of triangles.
    [[nodiscard]] std::size_t parts() const { return (triangle_count_ + kMostInPart - 1) / kMostInPart; }
    [[nodiscard]] std::uint64_t draw_part(std::size_t part) const;
    static constexpr std::size_t kMostInPart = std::size_t{1} << 15; // triangles

private:
    std::shared_ptr<const ShapeTriangles> made_of_;
    As as_;
    std::size_t triangle_count_ = 0;
    std::vector<ShapeTriangles::Vertex> corners_; // until they are sent
    VertexArray vertex_array_;
    LargeBuffer vertices_, triangles_;
    std::size_t sent_vertices_ = 0, sent_triangles_ = 0; // bytes
};

class GpuShapes {
public:
    // Sends what is new and lets go of what is no longer there. What is not shown is not sent. With `wait` all is there
    // then; else new context is made on a thread of its own, and sent as far as `budget` allows, which what was sent is
    // subtracted from. True: all is there.
    bool follow(const std::vector<ContextMesh>& context, const Lesions& lesions, bool wait, std::size_t& budget);

    // Of what is shown, was given to follow() and is all there, else null. Of context the preview, if there is one and
    // that will do.
    [[nodiscard]] const Shape* of(const ContextMesh& context, bool preview_will_do) const;
    [[nodiscard]] const Shape* of(const std::shared_ptr<const mesh::TriangleMesh>& lesion) const;
    [[nodiscard]] const Shape* ball() const { return ball_ ? &*ball_ : nullptr; } // of radius 1 about the origin
    [[nodiscard]] Box bounds(const std::vector<ContextMesh>& context) const;      // of all that are shown; mm

private:
    struct Sent {
        std::shared_ptr<const mesh::TriangleMesh> mesh;
        Shape::As as;
        std::future<Shape::Made> making; // until it is made
        std::optional<Shape> shape;
        bool whole = false;
    };
    static void begin(Sent& sent);
    static void go_on(Sent& sent, bool wait, std::size_t& budget);
    [[nodiscard]] const Shape* find(const std::shared_ptr<const mesh::TriangleMesh>& mesh, Shape::As as) const;
    std::list<Sent> sent_; // what is drawn in parts stays where it is
    std::optional<Shape> ball_;
};

} // namespace ramus::render
