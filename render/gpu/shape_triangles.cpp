#include "render/gpu/shape_triangles.h"

#include "core/base/splitmix64.h"

#include <bit>
#include <cstdint>
#include <glm/geometric.hpp>
#include <utility>

namespace ramus::render {

namespace {

// Whether every edge is traversed equally often in both directions: compares sums of random numbers for both directions
// (wrong for an open mesh with probability 2^-64). Vertices at the same position count as one, as along seams.
bool is_closed(const mesh::TriangleMesh& mesh) {
    std::vector<std::uint64_t> positions;
    positions.reserve(mesh.positions.size());
    for (const glm::vec3& p : mesh.positions) {
        std::uint64_t position = 0;
        for (const float x : {p.x, p.y, p.z})
            position = splitmix64(position ^ std::bit_cast<std::uint32_t>(x + 0.0F)); // no -0
        positions.push_back(position);
    }
    std::uint64_t there = 0, back = 0;
    const auto edge = [&](std::uint32_t a, std::uint32_t b) { return splitmix64(positions[a] + 3 * positions[b]); };
    for (const glm::uvec3& t : mesh.triangles)
        for (const auto& [a, b] : {std::pair(t.x, t.y), {t.y, t.z}, {t.z, t.x}}) {
            there += edge(a, b);
            back += edge(b, a);
        }
    return there == back;
}

} // namespace

ShapeTriangles::ShapeTriangles(const mesh::TriangleMesh& mesh)
    : bounds(bounds_of(mesh)), closed(is_closed(mesh)), triangles(mesh.triangles.begin(), mesh.triangles.end()) {
    const glm::vec3 centre(bounds.empty() ? glm::dvec3(0.0) : bounds.centre());
    vertices.reserve(mesh.positions.size());
    for (const glm::vec3& position : mesh.positions) vertices.push_back({position - centre, glm::vec3(0.0F)});
    double volume = 0.0;
    for (const glm::uvec3& t : mesh.triangles) {
        const glm::vec3 a = vertices[t.x].position, b = vertices[t.y].position, c = vertices[t.z].position;
        const glm::vec3 area = glm::cross(b - a, c - a);
        volume += double(glm::dot(a, area));
        for (const std::uint32_t corner : {t.x, t.y, t.z}) vertices[corner].normal += area;
    }
    // Given normals may belong to inverted triangles, or face outward already.
    const bool turn = closed && volume < 0.0, given = mesh.normals.size() == mesh.positions.size();
    double agree = 0.0;
    if (given)
        for (std::size_t i = 0; i < vertices.size(); ++i) {
            agree += double(glm::dot(vertices[i].normal, mesh.normals[i]));
            vertices[i].normal = mesh.normals[i];
        }
    const float sign = turn && (!given || agree > 0.0) ? -1.0F : 1.0F;
    for (Vertex& vertex : vertices) {
        const float length = glm::length(vertex.normal);
        vertex.normal = length > 0.0F ? vertex.normal / (sign * length) : glm::vec3(0, 0, 1);
    }
    if (turn)
        for (glm::uvec3& t : triangles) std::swap(t.y, t.z);
}

} // namespace ramus::render
