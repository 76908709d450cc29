#include "render/gpu/gpu_shapes.h"

#include "render/gl/bindings.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <exception>
#include <glm/gtc/constants.hpp>
#include <limits>
#include <oneapi/tbb/task_arena.h>
#include <span>
#include <utility>

namespace ramus::render {

namespace {

// Fine enough that the outline of a sphere of 500 pixels is within half a pixel of a circle.
mesh::TriangleMesh unit_sphere() {
    constexpr std::uint32_t kAround = 96, kRings = 47; // between the poles
    mesh::TriangleMesh sphere;
    sphere.positions.emplace_back(0.0F, 0.0F, -1.0F);
    for (std::uint32_t ring = 1; ring <= kRings; ++ring) {
        const float latitude = glm::pi<float>() * (float(ring) / float(kRings + 1) - 0.5F);
        for (std::uint32_t k = 0; k < kAround; ++k) {
            const float longitude = glm::two_pi<float>() * float(k) / float(kAround);
            sphere.positions.emplace_back(std::cos(latitude) * std::cos(longitude),
                                          std::cos(latitude) * std::sin(longitude), std::sin(latitude));
        }
    }
    sphere.positions.emplace_back(0.0F, 0.0F, 1.0F);
    const auto top = static_cast<std::uint32_t>(sphere.positions.size() - 1), last = top - kAround;
    for (std::uint32_t k = 0; k < kAround; ++k) {
        const std::uint32_t next = (k + 1) % kAround;
        sphere.triangles.emplace_back(0, 1 + next, 1 + k);
        for (std::uint32_t p = 1 + k, q = 1 + next; p < last; p += kAround, q += kAround) {
            sphere.triangles.emplace_back(p, q, q + kAround);
            sphere.triangles.emplace_back(p, q + kAround, p + kAround);
        }
        sphere.triangles.emplace_back(last + k, last + next, top);
    }
    sphere.normals = sphere.positions;
    return sphere;
}

Shape::As as(const ContextMesh& mesh) { return mesh.wireframe ? Shape::As::kLines : Shape::As::kSurface; }

} // namespace

Shape::Made Shape::make(const mesh::TriangleMesh& mesh, As as) {
    Made made{std::make_shared<const ShapeTriangles>(mesh), as, {}};
    if (as != As::kLines) return made;
    made.corners.reserve(3 * made.of->triangles.size());
    for (const glm::uvec3& t : made.of->triangles)
        for (const std::uint32_t corner : {t.x, t.y, t.z}) made.corners.push_back(made.of->vertices[corner]);
    return made;
}

Shape::Shape(Made made)
    : made_of_(std::move(made.of)), as_(made.as), triangle_count_(made_of_->triangles.size()),
      corners_(std::move(made.corners)), vertex_array_(make_vertex_array()) {
    using Vertex = ShapeTriangles::Vertex;
    if (triangle_count_ == 0) return;
    if (lines()) {
        vertices_ = LargeBuffer(corners_.size() * sizeof(Vertex));
    } else {
        triangles_ = LargeBuffer(triangle_count_ * sizeof(glm::uvec3));
        glVertexArrayElementBuffer(vertex_array_, triangles_);
        vertices_ = LargeBuffer(made_of_->vertices.size() * sizeof(Vertex));
    }
    glVertexArrayVertexBuffer(vertex_array_, 0, vertices_, 0, sizeof(Vertex));
    glVertexArrayAttribFormat(vertex_array_, kAttributePosition, 3, GL_FLOAT, GL_FALSE, offsetof(Vertex, position));
    glVertexArrayAttribFormat(vertex_array_, kAttributeNormal, 3, GL_FLOAT, GL_FALSE, offsetof(Vertex, normal));
    use_attributes(vertex_array_, {kAttributePosition, kAttributeNormal});
}

bool Shape::send(std::size_t& budget) {
    if (triangle_count_ == 0) return true;
    const auto send_more = [&](GLuint buffer, const auto& values, std::size_t& sent) {
        const std::span bytes = std::as_bytes(std::span(values)).subspan(sent);
        const std::size_t now = std::min(budget, bytes.size());
        if (now == 0) return bytes.empty();
        glNamedBufferSubData(buffer, static_cast<GLintptr>(sent), static_cast<GLsizeiptr>(now), bytes.data());
        sent += now;
        budget -= now;
        return now == bytes.size();
    };
    if (!lines())
        return send_more(triangles_, made_of_->triangles, sent_triangles_) &&
               send_more(vertices_, made_of_->vertices, sent_vertices_);
    if (corners_.empty()) return true;
    const bool whole = send_more(vertices_, corners_, sent_vertices_);
    if (whole) corners_ = {};
    return whole;
}

std::uint64_t Shape::draw_part(std::size_t part) const {
    const std::size_t first = part * kMostInPart, count = std::min(kMostInPart, triangle_count_ - first);
    const auto corners = static_cast<GLsizei>(3 * count);
    glBindVertexArray(vertex_array_);
    if (lines())
        glDrawArrays(GL_TRIANGLES, static_cast<GLint>(3 * first), corners);
    else
        glDrawElements(GL_TRIANGLES, corners, GL_UNSIGNED_INT, offset_pointer(first * sizeof(glm::uvec3)));
    return count;
}

// A task that nobody runs any more, because the program ends, would keep the mesh.
GpuShapes::~GpuShapes() {
    *wanted_ = false;
    for (const Sent& sent : sent_)
        if (sent.making.valid()) sent.making.wait();
}

void GpuShapes::begin(Sent& sent) const {
    const auto promise = std::make_shared<std::promise<Shape::Made>>();
    sent.making = promise->get_future();
    oneapi::tbb::this_task_arena::enqueue([promise, wanted = wanted_, mesh = sent.mesh, as = sent.as] {
        try {
            promise->set_value(*wanted ? Shape::make(*mesh, as) : Shape::Made{});
        } catch (...) {
            promise->set_exception(std::current_exception());
        }
    });
}

void GpuShapes::go_on(Sent& sent, bool wait, std::size_t& budget) const {
    if (!sent.shape) {
        if (wait && !sent.making.valid())
            sent.shape.emplace(Shape::make(*sent.mesh, sent.as));
        else if (!sent.making.valid())
            begin(sent);
        if (sent.making.valid() && (wait || sent.making.wait_for(std::chrono::seconds(0)) == std::future_status::ready))
            sent.shape.emplace(sent.making.get());
        if (!sent.shape) return;
    }
    std::size_t all = std::numeric_limits<std::size_t>::max();
    sent.whole = sent.shape->send(wait ? all : budget);
}

bool GpuShapes::follow(const std::vector<ContextMesh>& context, const Lesions& lesions, bool wait,
                       std::size_t& budget) {
    std::vector<std::pair<std::shared_ptr<const mesh::TriangleMesh>, Shape::As>> wanted;
    for (const ContextMesh& one : context) {
        if (!one.shown()) continue;
        wanted.emplace_back(one.mesh, as(one));
        if (one.preview) wanted.emplace_back(one.preview, as(one));
    }
    for (const auto& mesh : lesions.meshes) wanted.emplace_back(mesh, Shape::As::kSurface);
    std::erase_if(sent_, [&](const Sent& sent) {
        return std::ranges::find(wanted, std::pair(sent.mesh, sent.as)) == wanted.end();
    });
    for (const auto& one : wanted) {
        const auto known =
            std::ranges::find_if(sent_, [&](const Sent& sent) { return std::pair(sent.mesh, sent.as) == one; });
        Sent& sent = known != sent_.end() ? *known : sent_.emplace_back(Sent{one.first, one.second, {}, {}, false});
        const bool of_lesion = std::ranges::find(lesions.meshes, one.first) != lesions.meshes.end();
        if (!sent.whole) go_on(sent, wait || of_lesion, budget);
    }
    if (!lesions.spheres.empty() && !ball_) {
        ball_.emplace(Shape::make(unit_sphere(), Shape::As::kSurface));
        std::size_t all = std::numeric_limits<std::size_t>::max();
        (void)ball_->send(all);
    }
    return std::ranges::all_of(sent_, &Sent::whole);
}

const Shape* GpuShapes::find(const std::shared_ptr<const mesh::TriangleMesh>& mesh, Shape::As as) const {
    const auto found =
        std::ranges::find_if(sent_, [&](const Sent& sent) { return sent.whole && sent.mesh == mesh && sent.as == as; });
    return found != sent_.end() ? &*found->shape : nullptr;
}

const Shape* GpuShapes::of(const ContextMesh& context, bool preview_will_do) const {
    if (!context.shown()) return nullptr;
    return find(preview_will_do && context.preview ? context.preview : context.mesh, as(context));
}

const Shape* GpuShapes::of(const std::shared_ptr<const mesh::TriangleMesh>& lesion) const {
    return find(lesion, Shape::As::kSurface);
}

Box GpuShapes::bounds(const std::vector<ContextMesh>& context) const {
    Box box;
    for (const ContextMesh& one : context) {
        const Shape* shape = of(one, false);
        if (shape == nullptr || shape->bounds().empty()) continue;
        box.include(shape->bounds().lower);
        box.include(shape->bounds().upper);
    }
    return box;
}

} // namespace ramus::render
