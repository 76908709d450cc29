#include "render/gpu/gpu_shapes.h"

#include "render/gl/bindings.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
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

Shape::Shape(const mesh::TriangleMesh& mesh, As as) : made_of_(std::make_shared<const ShapeTriangles>(mesh)), as_(as) {
    const std::vector<glm::uvec3>& triangles = made_of_->triangles;
    using Vertex = ShapeTriangles::Vertex;
    vertex_array_ = make_vertex_array();
    corners_ = static_cast<GLsizei>(3 * triangles.size());
    if (triangles.empty()) return;
    if (lines()) {
        std::vector<Vertex> corners;
        corners.reserve(3 * triangles.size());
        for (const glm::uvec3& t : triangles)
            for (const std::uint32_t corner : {t.x, t.y, t.z}) corners.push_back(made_of_->vertices[corner]);
        vertices_ = make_buffer(corners.size() * sizeof corners[0], corners.data());
    } else {
        triangles_ = make_buffer(triangles.size() * sizeof triangles[0], triangles.data());
        glVertexArrayElementBuffer(vertex_array_, triangles_);
        vertices_ = make_buffer(made_of_->vertices.size() * sizeof(Vertex), made_of_->vertices.data());
    }
    glVertexArrayVertexBuffer(vertex_array_, 0, vertices_, 0, sizeof(Vertex));
    glVertexArrayAttribFormat(vertex_array_, kAttributePosition, 3, GL_FLOAT, GL_FALSE, offsetof(Vertex, position));
    glVertexArrayAttribFormat(vertex_array_, kAttributeNormal, 3, GL_FLOAT, GL_FALSE, offsetof(Vertex, normal));
    use_attributes(vertex_array_, {kAttributePosition, kAttributeNormal});
}

std::uint64_t Shape::draw() const {
    if (corners_ == 0) return 0;
    glBindVertexArray(vertex_array_);
    if (lines())
        glDrawArrays(GL_TRIANGLES, 0, corners_);
    else
        glDrawElements(GL_TRIANGLES, corners_, GL_UNSIGNED_INT, nullptr);
    return static_cast<std::uint64_t>(corners_) / 3;
}

void GpuShapes::follow(const std::vector<ContextMesh>& context, const Lesions& lesions) {
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
    for (const auto& [mesh, as] : wanted)
        if (find(mesh, as) == nullptr) sent_.push_back({mesh, as, Shape(*mesh, as)});
    if (!lesions.spheres.empty() && !ball_) ball_.emplace(unit_sphere(), Shape::As::kSurface);
}

const Shape* GpuShapes::find(const std::shared_ptr<const mesh::TriangleMesh>& mesh, Shape::As as) const {
    const auto found =
        std::ranges::find_if(sent_, [&](const Sent& sent) { return sent.mesh == mesh && sent.as == as; });
    return found != sent_.end() ? &found->shape : nullptr;
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
