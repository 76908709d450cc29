// Closed capsules as test meshes, so that pictures can be tested without any surface method.
#pragma once

#include "core/mesh/triangle_mesh.h"

#include <cmath>
#include <glm/geometric.hpp>

namespace ramus::test {

// Adds a closed round cone from a to b with half-sphere ends; `around` vertices a ring.
inline void add_capsule(mesh::TriangleMesh& mesh, glm::vec3 a, glm::vec3 b, float ra, float rb, int branch,
                        int around = 24) {
    const glm::vec3 axis = glm::normalize(b - a);
    const glm::vec3 side =
        glm::normalize(glm::cross(axis, std::abs(axis.z) < 0.9F ? glm::vec3(0, 0, 1) : glm::vec3(1, 0, 0)));
    const glm::vec3 other = glm::cross(axis, side);
    const int quarter = around / 4;
    const auto base = static_cast<std::uint32_t>(mesh.positions.size());
    const auto add = [&](glm::vec3 position, glm::vec3 normal, float radius) {
        mesh.positions.push_back(position);
        mesh.normals.push_back(normal);
        mesh.radii.push_back(radius);
        mesh.branches.push_back(branch);
    };
    constexpr float kHalfPi = 1.57079633F;
    std::uint32_t rings = 0;
    for (int end = 0; end < 2; ++end) {
        for (int i = 0; i <= quarter; ++i, ++rings) {
            const float latitude = kHalfPi * (end == 0 ? float(i) / float(quarter) - 1.0F : float(i) / float(quarter));
            for (int k = 0; k < around; ++k) {
                const float angle = 4.0F * kHalfPi * float(k) / float(around);
                const glm::vec3 n =
                    std::cos(latitude) * (std::cos(angle) * side + std::sin(angle) * other) + std::sin(latitude) * axis;
                add((end == 0 ? a : b) + (end == 0 ? ra : rb) * n, n, end == 0 ? ra : rb);
            }
        }
    }
    const auto n = static_cast<std::uint32_t>(around);
    for (std::uint32_t ring = 0; ring + 1 < rings; ++ring) {
        for (std::uint32_t k = 0; k < n; ++k) {
            const std::uint32_t p = base + ring * n + k, q = base + ring * n + (k + 1) % n;
            mesh.triangles.emplace_back(p, q, q + n);
            mesh.triangles.emplace_back(p, q + n, p + n);
        }
    }
}

} // namespace ramus::test
