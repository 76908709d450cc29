#include "core/mesh/coarse_mesh.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <unordered_map>
#include <vector>

namespace ramus::mesh {

namespace {

glm::vec3 unit(const glm::vec3& v) {
    const float length = glm::length(v);
    return length > 0.0F ? v / length : glm::vec3(0.0F, 0.0F, 1.0F);
}

double area_of(const TriangleMesh& mesh) {
    double twice = 0.0;
    for (const glm::uvec3& t : mesh.triangles) {
        const glm::dvec3 a(mesh.positions[t.x]);
        twice += glm::length(glm::cross(glm::dvec3(mesh.positions[t.y]) - a, glm::dvec3(mesh.positions[t.z]) - a));
    }
    return 0.5 * twice;
}

} // namespace

TriangleMesh coarse_mesh(const TriangleMesh& mesh, std::size_t triangles) {
    if (mesh.triangles.size() <= triangles || triangles == 0) return mesh;
    // A surface passes through one cell for each square of a cell's side, and has two triangles in it.
    const double side = std::max(1e-6, std::sqrt(2.0 * area_of(mesh) / static_cast<double>(triangles)));
    glm::dvec3 corner(mesh.positions[0]);
    for (const glm::vec3& p : mesh.positions) corner = glm::min(corner, glm::dvec3(p));
    struct Sum {
        glm::dvec3 position{0.0};
        glm::vec3 normal{0.0F};
        double count = 0.0;
    };
    std::unordered_map<std::uint64_t, std::uint32_t> cells;
    std::vector<Sum> sums;
    std::vector<std::uint32_t> now(mesh.positions.size());
    const bool with_normals = mesh.normals.size() == mesh.positions.size();
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
        const auto cell = glm::min((glm::dvec3(mesh.positions[v]) - corner) / side, glm::dvec3((1 << 21) - 1));
        const std::uint64_t key = static_cast<std::uint64_t>(cell.x) << 42U |
                                  static_cast<std::uint64_t>(cell.y) << 21U | static_cast<std::uint64_t>(cell.z);
        const auto [found, fresh] = cells.try_emplace(key, static_cast<std::uint32_t>(sums.size()));
        if (fresh) sums.emplace_back();
        now[v] = found->second;
        Sum& sum = sums[found->second];
        sum.position += glm::dvec3(mesh.positions[v]);
        if (with_normals) sum.normal += mesh.normals[v];
        sum.count += 1.0;
    }
    TriangleMesh coarse;
    for (const Sum& sum : sums) {
        coarse.positions.push_back(glm::vec3(sum.position / sum.count));
        if (with_normals) coarse.normals.push_back(unit(sum.normal));
    }
    for (const glm::uvec3& t : mesh.triangles) {
        const glm::uvec3 u(now[t.x], now[t.y], now[t.z]);
        if (u.x != u.y && u.y != u.z && u.z != u.x) coarse.triangles.push_back(u);
    }
    return coarse;
}

void smooth_normals(TriangleMesh& mesh, int passes) {
    if (mesh.normals.size() != mesh.positions.size()) return;
    std::vector<glm::vec3> sums(mesh.normals.size());
    for (int pass = 0; pass < passes; ++pass) {
        std::ranges::fill(sums, glm::vec3(0.0F));
        for (const glm::uvec3& t : mesh.triangles) {
            const glm::vec3 mean = mesh.normals[t.x] + mesh.normals[t.y] + mesh.normals[t.z];
            for (const std::uint32_t corner : {t.x, t.y, t.z}) sums[corner] += mean;
        }
        for (std::size_t v = 0; v < sums.size(); ++v)
            if (sums[v] != glm::vec3(0.0F)) mesh.normals[v] = unit(sums[v]);
    }
}

} // namespace ramus::mesh
