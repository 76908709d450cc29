// GpuShapes: the meshes next to the tree (context and lesions) on the graphics card, and a unit sphere for spherical
// lesions. A mesh is sent once and stays as long as frames name it. Surfaces share vertices; lines need separate
// vertices per triangle. Context is prepared on another thread, sent over several calls, and drawn in parts.
#pragma once

#include "render/gl/gl_objects.h"
#include "render/gpu/shape_triangles.h"
#include "render/scene/bounds.h"
#include "render/scene/scene.h"

#include <atomic>
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
    // The data to send for a mesh. make() is thread-safe.
    struct Made {
        std::shared_ptr<const ShapeTriangles> of;
        As as = As::kSurface;
        std::vector<ShapeTriangles::Vertex> corners; // lines only: three per triangle
    };
    [[nodiscard]] static Made make(const mesh::TriangleMesh& mesh, As as);
    explicit Shape(Made made); // sends nothing yet
    // Sends at most about `budget` bytes and subtracts what it sent. Returns true once everything was sent.
    bool send(std::size_t& budget);

    [[nodiscard]] const std::shared_ptr<const ShapeTriangles>& made_of() const { return made_of_; }
    [[nodiscard]] const Box& bounds() const { return made_of_->bounds; }
    [[nodiscard]] bool lines() const { return as_ == As::kLines; }
    [[nodiscard]] bool closed() const { return made_of_->closed; }
    // Draws a part that takes a software rasteriser a few milliseconds. Attribute 0: positions, 1: normals. Returns the
    // number of triangles.
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
    GpuShapes() = default;
    ~GpuShapes();
    GpuShapes(const GpuShapes&) = delete;
    GpuShapes& operator=(const GpuShapes&) = delete;
    GpuShapes& operator=(GpuShapes&& other) noexcept {
        wanted_.swap(other.wanted_), sent_.swap(other.sent_), ball_.swap(other.ball_);
        return *this;
    }

    // Sends new shapes and releases those that are no longer listed; hidden shapes are not sent. With `wait` everything
    // is sent on return. Otherwise new context is prepared on its own thread and sent within `budget`, from which the
    // sent bytes are subtracted. Returns true once everything was sent.
    bool follow(const std::vector<ContextMesh>& context, const Lesions& lesions, bool wait, std::size_t& budget);

    // The shape of a mesh that is shown, was given to follow() and is completely sent; otherwise null. For context,
    // returns the preview if there is one and `preview_will_do`.
    [[nodiscard]] const Shape* of(const ContextMesh& context, bool preview_will_do) const;
    [[nodiscard]] const Shape* of(const std::shared_ptr<const mesh::TriangleMesh>& lesion) const;
    [[nodiscard]] const Shape* ball() const { return ball_ ? &*ball_ : nullptr; } // unit sphere at the origin
    [[nodiscard]] Box bounds(const std::vector<ContextMesh>& context) const;      // of all shown meshes; mm

private:
    struct Sent {
        std::shared_ptr<const mesh::TriangleMesh> mesh;
        Shape::As as;
        std::future<Shape::Made> making; // valid during preparation
        std::optional<Shape> shape;
        bool whole = false;
    };
    void begin(Sent& sent) const;
    void go_on(Sent& sent, bool wait, std::size_t& budget) const;
    [[nodiscard]] const Shape* find(const std::shared_ptr<const mesh::TriangleMesh>& mesh, Shape::As as) const;
    // False: preparations that have not begun are left out.
    std::shared_ptr<std::atomic<bool>> wanted_ = std::make_shared<std::atomic<bool>>(true);
    std::list<Sent> sent_; // a list: shapes drawn in parts keep their address
    std::optional<Shape> ball_;
};

} // namespace ramus::render
