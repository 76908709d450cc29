#include "render/gpu_mesh.h"

#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>

namespace ramus::render {

namespace {

struct Vertex {
    glm::vec3 position;
    std::array<std::int16_t, 4> normal; // signed normalised
    std::int32_t branch;
};
static_assert(sizeof(Vertex) == 24);

std::int16_t normalised(float v) {
    return static_cast<std::int16_t>(std::lround(std::clamp(v, -1.0F, 1.0F) * 32767.0F));
}

// Area-weighted vertex normals for a mesh that came without.
std::vector<glm::vec3> normals_of(const mesh::TriangleMesh& mesh) {
    if (mesh.normals.size() == mesh.positions.size()) return mesh.normals;
    std::vector<glm::vec3> normals(mesh.positions.size(), glm::vec3(0.0F));
    for (const glm::uvec3& t : mesh.triangles) {
        const glm::vec3 n =
            glm::cross(mesh.positions[t.y] - mesh.positions[t.x], mesh.positions[t.z] - mesh.positions[t.x]);
        for (int i = 0; i < 3; ++i) normals[t[i]] += n;
    }
    for (glm::vec3& n : normals) n = glm::length(n) > 0.0F ? glm::normalize(n) : glm::vec3(0, 0, 1);
    return normals;
}

// The corner that gives the triangle its branch (OpenGL's provoking vertex) comes last: one of the majority's.
glm::uvec3 majority_last(const glm::uvec3& t, const std::vector<Vertex>& vertices) {
    const auto branch = [&](int i) { return vertices[t[i]].branch; };
    if (branch(2) == branch(0) || branch(2) == branch(1)) return t;
    return branch(0) == branch(1) ? glm::uvec3(t.z, t.x, t.y) : t;
}

// Outside means: all corners of the box beyond one plane of the clip volume.
bool in_picture(const glm::vec3& lower, const glm::vec3& upper, const glm::dmat4& to_clip) {
    std::array<int, 4> beyond{};
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec4 p = to_clip * glm::dvec4(corner & 1 ? upper.x : lower.x, corner & 2 ? upper.y : lower.y,
                                                  corner & 4 ? upper.z : lower.z, 1.0);
        beyond[0] += p.x < -p.w ? 1 : 0;
        beyond[1] += p.x > p.w ? 1 : 0;
        beyond[2] += p.y < -p.w ? 1 : 0;
        beyond[3] += p.y > p.w ? 1 : 0;
    }
    return std::ranges::none_of(beyond, [](int count) { return count == 8; });
}

} // namespace

GpuMesh::GpuMesh(const mesh::TriangleMesh& mesh) : bounds_(bounds_of(mesh)), origin_(bounds_.centre()) {
    const std::vector<glm::vec3> normals = normals_of(mesh);
    const bool has_branches = mesh.branches.size() == mesh.positions.size();
    std::vector<Vertex> vertices(mesh.positions.size());
    std::int32_t largest = 0;
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        vertices[i].position = glm::vec3(glm::dvec3(mesh.positions[i]) - origin_);
        vertices[i].normal = {normalised(normals[i].x), normalised(normals[i].y), normalised(normals[i].z), 0};
        vertices[i].branch = has_branches ? std::max(mesh.branches[i], 0) : 0;
        largest = std::max(largest, vertices[i].branch);
    }

    // Counting sort of the triangles by branch keeps their order within each, and with it the vertices' locality.
    ranges_.resize(mesh.positions.empty() ? 0 : static_cast<std::size_t>(largest) + 1);
    std::vector<glm::uvec3> turned(mesh.triangles.size()), sorted(mesh.triangles.size());
    for (std::size_t i = 0; i < turned.size(); ++i) {
        turned[i] = majority_last(mesh.triangles[i], vertices);
        Range& range = ranges_[static_cast<std::size_t>(vertices[turned[i].z].branch)];
        for (int corner = 0; corner < 3; ++corner) {
            const glm::vec3 p = vertices[turned[i][corner]].position;
            const bool first = range.count == 0 && corner == 0;
            range.lower = first ? p : glm::min(range.lower, p);
            range.upper = first ? p : glm::max(range.upper, p);
        }
        ++range.count;
    }
    std::uint32_t next = 0;
    for (Range& range : ranges_) {
        range.first = next;
        next += range.count;
        range.count = 0;
    }
    for (const glm::uvec3& t : turned) {
        Range& range = ranges_[static_cast<std::size_t>(vertices[t.z].branch)];
        sorted[range.first + range.count++] = t;
    }

    vertex_array_ = make_vertex_array();
    if (sorted.empty()) return;
    vertices_ = make_buffer();
    indices_ = make_buffer();
    glNamedBufferStorage(vertices_, static_cast<GLsizeiptr>(vertices.size() * sizeof(Vertex)), vertices.data(), 0);
    glNamedBufferStorage(indices_, static_cast<GLsizeiptr>(sorted.size() * sizeof(glm::uvec3)), sorted.data(), 0);
    glVertexArrayVertexBuffer(vertex_array_, 0, vertices_, 0, sizeof(Vertex));
    glVertexArrayElementBuffer(vertex_array_, indices_);
    glVertexArrayAttribFormat(vertex_array_, 0, 3, GL_FLOAT, GL_FALSE, offsetof(Vertex, position));
    glVertexArrayAttribFormat(vertex_array_, 1, 3, GL_SHORT, GL_TRUE, offsetof(Vertex, normal));
    glVertexArrayAttribIFormat(vertex_array_, 2, 1, GL_INT, offsetof(Vertex, branch));
    for (GLuint i = 0; i < 3; ++i) {
        glVertexArrayAttribBinding(vertex_array_, i, 0);
        glEnableVertexArrayAttrib(vertex_array_, i);
    }
}

std::uint64_t GpuMesh::draw(const std::vector<Layer>& layers, Layer layer, const glm::dmat4& to_clip) const {
    std::vector<GLsizei> counts;
    std::vector<const void*> offsets;
    std::uint64_t triangles = 0;
    std::uint32_t end = 0; // of the last range, to join neighbours
    for (std::size_t i = 0; i < ranges_.size(); ++i) {
        const Range& range = ranges_[i];
        if (range.count == 0 || (i < layers.size() ? layers[i] : Layer::kOpaque) != layer) continue;
        if (!in_picture(range.lower, range.upper, to_clip)) continue;
        triangles += range.count;
        if (!counts.empty() && end == range.first) {
            counts.back() += static_cast<GLsizei>(3 * range.count);
        } else {
            counts.push_back(static_cast<GLsizei>(3 * range.count));
            offsets.push_back(
                reinterpret_cast<const void*>(static_cast<std::uintptr_t>(range.first) * sizeof(glm::uvec3)));
        }
        end = range.first + range.count;
    }
    if (counts.empty()) return 0;
    glBindVertexArray(vertex_array_);
    glMultiDrawElements(GL_TRIANGLES, counts.data(), GL_UNSIGNED_INT, offsets.data(),
                        static_cast<GLsizei>(counts.size()));
    return triangles;
}

} // namespace ramus::render
