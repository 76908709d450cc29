// Closed meshes whose shape is known: a sphere of triangles, a cube.
#pragma once

#include "core/mesh/triangle_mesh.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <map>
#include <utility>
#include <vector>

namespace ramus::test {

struct UnitSphere {
    std::vector<glm::dvec3> points;
    std::vector<glm::uvec3> triangles;
};

inline UnitSphere make_unit_sphere(int level) {
    const double g = 1.6180339887498949;
    std::vector<glm::dvec3> points{{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                                   {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
    std::vector<glm::uvec3> triangles{{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                                      {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                                      {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                                      {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}};
    for (int i = 0; i < level; ++i) {
        std::map<std::pair<unsigned, unsigned>, unsigned> middles;
        const auto middle = [&](unsigned a, unsigned b) {
            const auto [found, fresh] = middles.try_emplace(std::minmax(a, b), static_cast<unsigned>(points.size()));
            if (fresh) points.push_back(points[a] + points[b]);
            return found->second;
        };
        for (glm::dvec3& p : points) p = glm::normalize(p);
        std::vector<glm::uvec3> finer;
        for (const glm::uvec3& t : triangles) {
            const unsigned ab = middle(t.x, t.y), bc = middle(t.y, t.z), ca = middle(t.z, t.x);
            for (const glm::uvec3& part :
                 {glm::uvec3(t.x, ab, ca), glm::uvec3(ab, t.y, bc), glm::uvec3(ca, bc, t.z), glm::uvec3(ab, bc, ca)})
                finer.push_back(part);
        }
        triangles = std::move(finer);
    }
    for (glm::dvec3& p : points) p = glm::normalize(p);
    return {std::move(points), std::move(triangles)};
}

// 20 * 4^level triangles, turned outward, corners on the sphere. Each thread makes the sphere of a level once.
inline mesh::TriangleMesh icosphere(int level, glm::dvec3 centre, double radius) {
    thread_local std::map<int, UnitSphere> spheres;
    const auto [sphere, fresh] = spheres.try_emplace(level);
    if (fresh) sphere->second = make_unit_sphere(level);
    mesh::TriangleMesh mesh;
    for (const glm::dvec3& out : sphere->second.points) {
        mesh.positions.push_back(glm::vec3(centre + radius * out));
        mesh.normals.push_back(glm::vec3(out));
    }
    for (const glm::uvec3& t : sphere->second.triangles) mesh.triangles.push_back(t);
    return mesh;
}

// Around the origin, turned outward.
inline mesh::TriangleMesh cube(double side) {
    mesh::TriangleMesh mesh;
    for (int i = 0; i < 8; ++i)
        mesh.positions.push_back(
            glm::vec3(side * ((i & 1) - 0.5), side * ((i >> 1 & 1) - 0.5), side * ((i >> 2) - 0.5)));
    for (const glm::uvec3& t : {glm::uvec3(0, 2, 1), glm::uvec3(1, 2, 3), glm::uvec3(4, 5, 6), glm::uvec3(5, 7, 6),
                                glm::uvec3(0, 1, 4), glm::uvec3(1, 5, 4), glm::uvec3(2, 6, 3), glm::uvec3(3, 6, 7),
                                glm::uvec3(0, 4, 2), glm::uvec3(2, 4, 6), glm::uvec3(1, 3, 5), glm::uvec3(3, 7, 5)})
        mesh.triangles.push_back(t);
    return mesh;
}

} // namespace ramus::test
