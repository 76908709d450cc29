#include "render/gpu_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>
#include <unordered_map>

namespace ramus::render {

namespace {

constexpr std::size_t kCoarseFrom = 150'000; // triangles: below, even a software rasteriser keeps up

std::int16_t normalised(float v) {
    return static_cast<std::int16_t>(std::lround(std::clamp(v, -1.0F, 1.0F) * 32767.0F));
}

// Area-weighted vertex normals for a mesh that came without.
LargeArray<glm::vec3> normals_of(const mesh::TriangleMesh& mesh) {
    if (mesh.normals.size() == mesh.positions.size()) return mesh.normals;
    LargeArray<glm::vec3> normals(mesh.positions.size(), glm::vec3(0.0F));
    for (const glm::uvec3& t : mesh.triangles) {
        const glm::vec3 n =
            glm::cross(mesh.positions[t.y] - mesh.positions[t.x], mesh.positions[t.z] - mesh.positions[t.x]);
        for (int i = 0; i < 3; ++i) normals[t[i]] += n;
    }
    for (glm::vec3& n : normals) n = glm::length(n) > 0.0F ? glm::normalize(n) : glm::vec3(0, 0, 1);
    return normals;
}

// The corner that gives the triangle its branch (OpenGL's provoking vertex) comes last: one of the majority's.
glm::uvec3 majority_last(const glm::uvec3& t, const std::vector<GpuVertex>& vertices) {
    const auto branch = [&](int i) { return vertices[t[i]].branch; };
    if (branch(2) == branch(0) || branch(2) == branch(1)) return t;
    return branch(0) == branch(1) ? glm::uvec3(t.z, t.x, t.y) : t;
}

struct Key {
    std::int32_t x, y, z, level, branch;
    bool operator==(const Key&) const = default;
};

struct HashKey {
    std::size_t operator()(const Key& k) const {
        std::uint64_t h = 0x9E3779B97F4A7C15ULL;
        for (const std::int32_t v : {k.x, k.y, k.z, k.level, k.branch})
            h = (h ^ static_cast<std::uint32_t>(v)) * 0xD6E8FEB86659FD93ULL, h ^= h >> 32;
        return h;
    }
};

// Every vertex becomes the first one of its cell; what is no triangle any more goes.
std::vector<glm::uvec3> coarse_triangles(const mesh::TriangleMesh& mesh, const std::vector<GpuVertex>& vertices) {
    std::unordered_map<Key, std::uint32_t, HashKey> cells;
    cells.reserve(vertices.size() / 4);
    std::vector<std::uint32_t> stand_in(vertices.size());
    for (std::uint32_t i = 0; i < stand_in.size(); ++i) {
        const int level = std::ilogb(std::max(mesh.radii[i], 1e-6F));
        const glm::vec3 cell = glm::floor(vertices[i].position * std::ldexp(1.0F, -level));
        stand_in[i] =
            cells.try_emplace({int(cell.x), int(cell.y), int(cell.z), level, vertices[i].branch}, i).first->second;
    }
    std::vector<glm::uvec3> triangles;
    for (const glm::uvec3& t : mesh.triangles) {
        const glm::uvec3 c(stand_in[t.x], stand_in[t.y], stand_in[t.z]);
        if (c.x != c.y && c.y != c.z && c.z != c.x) triangles.push_back(c);
    }
    return triangles;
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

// Appends the triangles by branch to `sorted`: a counting sort keeps their order within each branch, and with it the
// vertices' locality.
std::vector<GpuMesh::Range> GpuMesh::append_by_branch(std::span<const glm::uvec3> triangles,
                                                      const std::vector<GpuVertex>& vertices, std::size_t branch_count,
                                                      std::vector<glm::uvec3>& sorted) {
    std::vector<Range> ranges(branch_count);
    std::vector<glm::uvec3> turned(triangles.size());
    for (std::size_t i = 0; i < turned.size(); ++i) {
        turned[i] = majority_last(triangles[i], vertices);
        Range& range = ranges[static_cast<std::size_t>(vertices[turned[i].z].branch)];
        for (int corner = 0; corner < 3; ++corner) {
            const glm::vec3 p = vertices[turned[i][corner]].position;
            const bool first = range.count == 0 && corner == 0;
            range.lower = first ? p : glm::min(range.lower, p);
            range.upper = first ? p : glm::max(range.upper, p);
        }
        ++range.count;
    }
    auto next = static_cast<std::uint32_t>(sorted.size());
    for (Range& range : ranges) {
        range.first = next;
        next += range.count;
        range.count = 0;
    }
    sorted.resize(next);
    for (const glm::uvec3& t : turned) {
        Range& range = ranges[static_cast<std::size_t>(vertices[t.z].branch)];
        sorted[range.first + range.count++] = t;
    }
    return ranges;
}

GpuMesh::GpuMesh(const mesh::TriangleMesh& mesh) : bounds_(bounds_of(mesh)), origin_(bounds_.centre()) {
    const LargeArray<glm::vec3> normals = normals_of(mesh);
    const bool has_branches = mesh.branches.size() == mesh.positions.size();
    std::vector<GpuVertex> vertices(mesh.positions.size());
    std::int32_t largest = 0;
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        vertices[i].position = glm::vec3(glm::dvec3(mesh.positions[i]) - origin_);
        vertices[i].normal = {normalised(normals[i].x), normalised(normals[i].y), normalised(normals[i].z), 0};
        vertices[i].branch = has_branches ? std::max(mesh.branches[i], 0) : 0;
        largest = std::max(largest, vertices[i].branch);
    }

    const std::size_t branch_count = mesh.positions.empty() ? 0 : static_cast<std::size_t>(largest) + 1;
    std::vector<glm::uvec3> sorted;
    ranges_ = append_by_branch(mesh.triangles, vertices, branch_count, sorted);
    if (mesh.triangles.size() > kCoarseFrom && mesh.radii.size() == mesh.positions.size())
        coarse_ranges_ = append_by_branch(coarse_triangles(mesh, vertices), vertices, branch_count, sorted);

    vertex_array_ = make_vertex_array();
    if (sorted.empty()) return;
    vertices_ = make_buffer();
    indices_ = make_buffer();
    glNamedBufferStorage(vertices_, static_cast<GLsizeiptr>(vertices.size() * sizeof(GpuVertex)), vertices.data(), 0);
    glNamedBufferStorage(indices_, static_cast<GLsizeiptr>(sorted.size() * sizeof(glm::uvec3)), sorted.data(), 0);
    glVertexArrayVertexBuffer(vertex_array_, 0, vertices_, 0, sizeof(GpuVertex));
    glVertexArrayElementBuffer(vertex_array_, indices_);
    glVertexArrayAttribFormat(vertex_array_, 0, 3, GL_FLOAT, GL_FALSE, offsetof(GpuVertex, position));
    glVertexArrayAttribFormat(vertex_array_, 1, 3, GL_SHORT, GL_TRUE, offsetof(GpuVertex, normal));
    glVertexArrayAttribIFormat(vertex_array_, 2, 1, GL_INT, offsetof(GpuVertex, branch));
    for (GLuint i = 0; i < 3; ++i) {
        glVertexArrayAttribBinding(vertex_array_, i, 0);
        glEnableVertexArrayAttrib(vertex_array_, i);
    }
}

std::uint64_t GpuMesh::draw(const std::vector<Layer>& layers, Layer layer, const glm::dmat4& to_clip,
                            bool coarse) const {
    const std::vector<Range>& ranges = coarse && !coarse_ranges_.empty() ? coarse_ranges_ : ranges_;
    std::vector<GLsizei> counts;
    std::vector<const void*> offsets;
    std::uint64_t triangles = 0;
    std::uint32_t end = 0; // of the last range, to join neighbours
    for (std::size_t i = 0; i < ranges.size(); ++i) {
        const Range& range = ranges[i];
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
