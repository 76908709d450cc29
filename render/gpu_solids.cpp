#include "render/gpu_solids.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

namespace ramus::render {

namespace {

struct SolidVertex {
    glm::vec3 position, normal;
};

// Fine enough that the outline of a sphere of 500 pixels is within half a pixel of a circle.
mesh::TriangleMesh unit_sphere() {
    constexpr std::uint32_t kAround = 96, kRings = 48;
    mesh::TriangleMesh sphere;
    for (std::uint32_t ring = 0; ring <= kRings; ++ring) {
        const float latitude = glm::pi<float>() * (float(ring) / float(kRings) - 0.5F);
        for (std::uint32_t k = 0; k < kAround; ++k) {
            const float longitude = glm::two_pi<float>() * float(k) / float(kAround);
            sphere.positions.emplace_back(std::cos(latitude) * std::cos(longitude),
                                          std::cos(latitude) * std::sin(longitude), std::sin(latitude));
        }
    }
    for (std::uint32_t ring = 0; ring < kRings; ++ring)
        for (std::uint32_t k = 0; k < kAround; ++k) {
            const std::uint32_t p = ring * kAround + k, q = ring * kAround + (k + 1) % kAround;
            sphere.triangles.emplace_back(p, q, q + kAround);
            sphere.triangles.emplace_back(p, q + kAround, p + kAround);
        }
    return sphere;
}

} // namespace

// Normals from the triangles, weighted by their areas; a mesh that is inside out is turned.
GpuSolids::Solid GpuSolids::make(const mesh::TriangleMesh& mesh) {
    Solid solid;
    for (const glm::vec3& position : mesh.positions) solid.bounds.include(position);
    const glm::vec3 centre(solid.bounds.empty() ? glm::dvec3(0.0) : solid.bounds.centre());
    std::vector<SolidVertex> vertices;
    vertices.reserve(mesh.positions.size());
    for (const glm::vec3& position : mesh.positions) vertices.push_back({position - centre, glm::vec3(0.0F)});
    double volume = 0.0;
    for (const glm::uvec3& t : mesh.triangles) {
        const glm::vec3 a = vertices[t.x].position, b = vertices[t.y].position, c = vertices[t.z].position;
        const glm::vec3 area = glm::cross(b - a, c - a);
        volume += double(glm::dot(a, area));
        for (const std::uint32_t corner : {t.x, t.y, t.z}) vertices[corner].normal += area;
    }
    for (SolidVertex& vertex : vertices) {
        const float length = glm::length(vertex.normal);
        vertex.normal = length > 0.0F ? vertex.normal / (volume < 0.0 ? -length : length) : glm::vec3(0, 0, 1);
    }
    std::vector<glm::uvec3> triangles(mesh.triangles.begin(), mesh.triangles.end());
    if (volume < 0.0)
        for (glm::uvec3& t : triangles) std::swap(t.y, t.z);

    solid.vertex_array = make_vertex_array();
    solid.indices = static_cast<GLsizei>(3 * triangles.size());
    if (triangles.empty()) return solid;
    solid.vertices = make_buffer(vertices.size() * sizeof vertices[0], vertices.data());
    solid.triangles = make_buffer(triangles.size() * sizeof triangles[0], triangles.data());
    glVertexArrayVertexBuffer(solid.vertex_array, 0, solid.vertices, 0, sizeof(SolidVertex));
    glVertexArrayElementBuffer(solid.vertex_array, solid.triangles);
    glVertexArrayAttribFormat(solid.vertex_array, 0, 3, GL_FLOAT, GL_FALSE, offsetof(SolidVertex, position));
    glVertexArrayAttribFormat(solid.vertex_array, 1, 3, GL_FLOAT, GL_FALSE, offsetof(SolidVertex, normal));
    for (GLuint i = 0; i < 2; ++i) {
        glVertexArrayAttribBinding(solid.vertex_array, i, 0);
        glEnableVertexArrayAttrib(solid.vertex_array, i);
    }
    return solid;
}

void GpuSolids::follow(const std::vector<std::shared_ptr<const mesh::TriangleMesh>>& meshes) {
    std::erase_if(solids_, [&](const Solid& solid) { return std::ranges::find(meshes, solid.of) == meshes.end(); });
    for (const auto& mesh : meshes) {
        if (std::ranges::find(solids_, mesh, &Solid::of) != solids_.end()) continue;
        solids_.push_back(make(*mesh));
        solids_.back().of = mesh;
    }
}

Box GpuSolids::bounds(const mesh::TriangleMesh& mesh) const {
    const auto found = std::ranges::find_if(solids_, [&](const Solid& solid) { return solid.of.get() == &mesh; });
    return found == solids_.end() ? Box{} : found->bounds;
}

void GpuSolids::draw_sphere(int id) {
    if (sphere_.indices == 0) sphere_ = make(unit_sphere());
    draw(sphere_, id);
}

void GpuSolids::draw(const mesh::TriangleMesh& mesh, int id) const {
    const auto found = std::ranges::find_if(solids_, [&](const Solid& solid) { return solid.of.get() == &mesh; });
    if (found != solids_.end()) draw(*found, id);
}

void GpuSolids::draw(const Solid& solid, int id) {
    if (solid.indices == 0) return;
    glBindVertexArray(solid.vertex_array);
    glVertexAttribI1i(2, id); // the branch of every vertex
    glDrawElements(GL_TRIANGLES, solid.indices, GL_UNSIGNED_INT, nullptr);
}

} // namespace ramus::render
