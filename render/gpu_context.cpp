#include "render/gpu_context.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <utility>

namespace ramus::render {

namespace {

struct Vertex {
    glm::vec3 position, normal;
};

std::uint64_t mixed(std::uint64_t x) { // splitmix64 (Steele, Lea, Flood, 2014)
    x += 0x9e3779b97f4a7c15ULL;
    x = (x ^ (x >> 30U)) * 0xbf58476d1ce4e5b9ULL;
    x = (x ^ (x >> 27U)) * 0x94d049bb133111ebULL;
    return x ^ (x >> 31U);
}

// Whether every edge is gone along as often one way as the other: the sums of random numbers for both are the same (of
// meshes that are not closed, once in 2^64).
bool is_closed(const mesh::TriangleMesh& mesh) {
    std::uint64_t there = 0, back = 0;
    const auto edge = [](std::uint64_t a, std::uint64_t b) { return mixed(a << 32U | b); };
    for (const glm::uvec3& t : mesh.triangles)
        for (const auto& [a, b] : {std::pair(t.x, t.y), {t.y, t.z}, {t.z, t.x}}) {
            there += edge(a, b);
            back += edge(b, a);
        }
    return there == back;
}

// The mesh's own normals, or those of the triangles, weighted by their areas. A closed mesh that is inside out is
// turned.
GpuContext::Shape make(const mesh::TriangleMesh& mesh, bool lines) {
    GpuContext::Shape shape;
    shape.bounds = bounds_of(mesh);
    shape.closed = is_closed(mesh);
    shape.lines = lines;
    const glm::vec3 centre(shape.bounds.empty() ? glm::dvec3(0.0) : shape.bounds.centre());
    std::vector<Vertex> vertices;
    vertices.reserve(mesh.positions.size());
    for (const glm::vec3& position : mesh.positions) vertices.push_back({position - centre, glm::vec3(0.0F)});
    double volume = 0.0;
    for (const glm::uvec3& t : mesh.triangles) {
        const glm::vec3 a = vertices[t.x].position, b = vertices[t.y].position, c = vertices[t.z].position;
        const glm::vec3 area = glm::cross(b - a, c - a);
        volume += double(glm::dot(a, area));
        for (const std::uint32_t corner : {t.x, t.y, t.z}) vertices[corner].normal += area;
    }
    const bool turn = shape.closed && volume < 0.0, given = mesh.normals.size() == mesh.positions.size();
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        if (given) vertices[i].normal = mesh.normals[i];
        const float length = glm::length(vertices[i].normal);
        vertices[i].normal =
            length > 0.0F ? vertices[i].normal / (turn && !given ? -length : length) : glm::vec3(0, 0, 1);
    }
    std::vector<glm::uvec3> triangles(mesh.triangles.begin(), mesh.triangles.end());
    if (turn)
        for (glm::uvec3& t : triangles) std::swap(t.y, t.z);

    shape.vertex_array = make_vertex_array();
    shape.corners = static_cast<GLsizei>(3 * triangles.size());
    if (triangles.empty()) return shape;
    if (lines) {
        std::vector<Vertex> corners;
        corners.reserve(3 * triangles.size());
        for (const glm::uvec3& t : triangles)
            for (const std::uint32_t corner : {t.x, t.y, t.z}) corners.push_back(vertices[corner]);
        vertices = std::move(corners);
    } else {
        shape.triangles = make_buffer(triangles.size() * sizeof triangles[0], triangles.data());
        glVertexArrayElementBuffer(shape.vertex_array, shape.triangles);
    }
    shape.vertices = make_buffer(vertices.size() * sizeof vertices[0], vertices.data());
    glVertexArrayVertexBuffer(shape.vertex_array, 0, shape.vertices, 0, sizeof(Vertex));
    glVertexArrayAttribFormat(shape.vertex_array, 0, 3, GL_FLOAT, GL_FALSE, offsetof(Vertex, position));
    glVertexArrayAttribFormat(shape.vertex_array, 1, 3, GL_FLOAT, GL_FALSE, offsetof(Vertex, normal));
    for (GLuint i = 0; i < 2; ++i) {
        glVertexArrayAttribBinding(shape.vertex_array, i, 0);
        glEnableVertexArrayAttrib(shape.vertex_array, i);
    }
    return shape;
}

} // namespace

void GpuContext::Shape::draw() const {
    if (corners == 0) return;
    glBindVertexArray(vertex_array);
    if (lines)
        glDrawArrays(GL_TRIANGLES, 0, corners);
    else
        glDrawElements(GL_TRIANGLES, corners, GL_UNSIGNED_INT, nullptr);
}

void GpuContext::follow(const std::vector<ContextMesh>& context) {
    std::vector<std::pair<std::shared_ptr<const mesh::TriangleMesh>, bool>> wanted;
    for (const ContextMesh& one : context) {
        if (!one.shown()) continue;
        wanted.emplace_back(one.mesh, one.wireframe);
        if (one.preview) wanted.emplace_back(one.preview, one.wireframe);
    }
    std::erase_if(shapes_, [&](const Shape& shape) {
        return std::ranges::find(wanted, std::pair(shape.of, shape.lines)) == wanted.end();
    });
    for (const auto& [mesh, lines] : wanted) {
        const auto same = [&](const Shape& shape) { return shape.of == mesh && shape.lines == lines; };
        if (std::ranges::any_of(shapes_, same)) continue;
        shapes_.push_back(make(*mesh, lines));
        shapes_.back().of = mesh;
    }
}

const GpuContext::Shape* GpuContext::shape(const ContextMesh& mesh, bool preview_will_do) const {
    const auto& wanted = preview_will_do && mesh.preview ? mesh.preview : mesh.mesh;
    const auto found = std::ranges::find_if(
        shapes_, [&](const Shape& shape) { return shape.of == wanted && shape.lines == mesh.wireframe; });
    return mesh.shown() && found != shapes_.end() ? &*found : nullptr;
}

Box GpuContext::bounds(const std::vector<ContextMesh>& context) const {
    Box box;
    for (const ContextMesh& one : context) {
        const Shape* of = shape(one, false);
        if (of == nullptr || of->bounds.empty()) continue;
        if (box.empty()) box = of->bounds;
        box.include(of->bounds.lower);
        box.include(of->bounds.upper);
    }
    return box;
}

} // namespace ramus::render
