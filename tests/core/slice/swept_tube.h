// Tubes and scans with known sections, for tests of what goes along a vessel.
#pragma once

#include "core/mesh/triangle_mesh.h"
#include "core/tree/vessel_tree.h"
#include "core/volume/volume.h"
#include "tests/support/built_tree.h"

#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <numbers>
#include <utility>
#include <vector>

namespace ramus::test {

inline constexpr double kPi = std::numbers::pi;

// The surface of `rings` rings of `around` vertices at `place(t, angle)`, t from 0 to 1, closed at both ends by their
// middles. The angle is counter-clockwise, seen against the direction of t.
template <class Place> mesh::TriangleMesh swept_tube(const Place& place, int rings, int around) {
    mesh::TriangleMesh mesh;
    const auto n = static_cast<std::uint32_t>(around);
    const auto add = [&](const glm::dvec3& at) { mesh.positions.emplace_back(at); };
    for (int ring = 0; ring < rings; ++ring)
        for (int k = 0; k < around; ++k) add(place(double(ring) / (rings - 1), 2.0 * kPi * k / around));
    for (const double t : {0.0, 1.0}) {
        glm::dvec3 sum(0.0);
        for (int k = 0; k < around; ++k) sum += place(t, 2.0 * kPi * k / around);
        add(sum / double(around));
    }
    const std::uint32_t first_cap = n * static_cast<std::uint32_t>(rings), last_cap = first_cap + 1;
    for (std::uint32_t k = 0; k < n; ++k) {
        const std::uint32_t next = (k + 1) % n;
        for (std::uint32_t ring = 0; ring + 1 < static_cast<std::uint32_t>(rings); ++ring) {
            const std::uint32_t p = ring * n + k, q = ring * n + next;
            mesh.triangles.emplace_back(p, q, q + n);
            mesh.triangles.emplace_back(p, q + n, p + n);
        }
        mesh.triangles.emplace_back(first_cap, next, k);
        mesh.triangles.emplace_back(last_cap, last_cap - 1 - n + k, last_cap - 1 - n + next);
    }
    return mesh;
}

// Appends another mesh.
inline void join(mesh::TriangleMesh& mesh, const mesh::TriangleMesh& other) {
    const auto base = static_cast<std::uint32_t>(mesh.positions.size());
    for (const auto& at : other.positions) mesh.positions.push_back(at);
    for (const auto& triangle : other.triangles) mesh.triangles.push_back(triangle + base);
}

// A straight tube from `a` to `b` whose section across it is an ellipse with these half axes.
inline mesh::TriangleMesh straight_tube(const glm::dvec3& a, const glm::dvec3& b, glm::dvec2 half, int around = 256) {
    const glm::dvec3 axis = glm::normalize(b - a);
    const glm::dvec3 side =
        glm::normalize(glm::cross(axis, std::abs(axis.z) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0)));
    const glm::dvec3 other = glm::cross(axis, side);
    return swept_tube(
        [&](double t, double angle) {
            return a + t * (b - a) + half.x * std::cos(angle) * side + half.y * std::sin(angle) * other;
        },
        40, around);
}

// A vessel along `place(t)`, t from 0 to 1, of one radius.
template <class Place> tree::VesselTree vessel_of(const Place& place, int points, double radius) {
    std::vector<tree::Point> line;
    for (int n = 0; n < points; ++n) line.push_back({place(double(n) / (points - 1)), radius});
    return vessel_along(std::move(line));
}

// A helix about z, by its angle.
struct Helix {
    double radius, rise; // mm; mm for a radian
    [[nodiscard]] double speed() const { return std::hypot(radius, rise); }
    [[nodiscard]] double torsion() const { return rise / (speed() * speed()); }
    [[nodiscard]] glm::dvec3 at(double angle) const {
        return {radius * std::cos(angle), radius * std::sin(angle), rise * angle};
    }
    [[nodiscard]] glm::dvec3 tangent(double angle) const {
        return glm::dvec3(-radius * std::sin(angle), radius * std::cos(angle), rise) / speed();
    }
    [[nodiscard]] static glm::dvec3 normal(double angle) { return {-std::cos(angle), -std::sin(angle), 0.0}; }
};

// A scan whose voxels have the value of `value(place)`.
template <class Value>
volume::Volume scan_of(const glm::ivec3& size, const glm::dvec3& spacing, const glm::dvec3& corner,
                       const Value& value) {
    volume::Volume scan;
    scan.size = size;
    for (int axis = 0; axis < 3; ++axis) scan.to_patient[axis][axis] = spacing[axis];
    scan.to_patient[3] = glm::dvec4(corner, 1.0);
    SparseArray<float> values;
    values.resize(volume::voxel_count(size));
    std::size_t n = 0;
    for (int k = 0; k < size.z; ++k)
        for (int j = 0; j < size.y; ++j)
            for (int i = 0; i < size.x; ++i)
                values[n++] = static_cast<float>(value(corner + spacing * glm::dvec3(i, j, k)));
    scan.voxels = std::move(values);
    return scan;
}

} // namespace ramus::test
