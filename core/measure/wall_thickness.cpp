#include "core/measure/wall_thickness.h"

#include "core/base/bounds.h"
#include "core/base/infinity.h"
#include "core/measure/deviation/packed_triangles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

namespace ramus::measure {

namespace {

// The cosine of the largest angle between the two sides of a wall, 10 degrees. Sides at a larger angle meet nearby, in
// an edge of the solid.
const double kFacesBack = std::cos(std::acos(-1.0) / 18.0);

class Solid {
public:
    explicit Solid(const mesh::TriangleMesh& mesh)
        : mesh_(mesh), surface_(mesh, kMostCopied, mesh.memory()), folded_(mesh.positions.size(), 0, mesh.memory()) {
        constexpr double kHere = 1e-9; // of the size of the whole: rounding, where the way begins on a triangle
        Bounds<glm::dvec3> box;
        for (const glm::vec3& position : mesh.positions) box.hold(glm::dvec3(position));
        here_ = kHere * glm::length(box.size());
        for (const glm::uvec3& triangle : mesh.triangles) {
            const auto [a, b, c] = corners(triangle);
            const glm::dvec3 across = glm::cross(b - a, c - a);
            for (const std::uint32_t v : {triangle.x, triangle.y, triangle.z})
                if (!(glm::dot(across, glm::dvec3(mesh.normals[v])) > 0.0)) folded_[v] = 1;
        }
    }

    // The thickness at a vertex, mm; infinite if it has none.
    [[nodiscard]] double thickness(std::size_t vertex) const {
        if (folded_[vertex] != 0) return kInfinity;
        const glm::dvec3 inward = -glm::dvec3(mesh_.normals[vertex]);
        const glm::dvec3 from(mesh_.positions[vertex]);
        const Crossing exit = surface_.first_exit(from, inward, here_);
        if (!(exit.at < kInfinity)) return kInfinity; // out through an edge
        const glm::uvec3& triangle = mesh_.triangles[exit.triangle];
        if (folded_[triangle.x] != 0 || folded_[triangle.y] != 0 || folded_[triangle.z] != 0) return kInfinity;
        const glm::dvec3 facing = normal_at(triangle, from + exit.at * inward);
        return glm::dot(facing, inward) >= kFacesBack ? exit.at : kInfinity;
    }

private:
    [[nodiscard]] std::array<glm::dvec3, 3> corners(const glm::uvec3& t) const {
        return {glm::dvec3(mesh_.positions[t.x]), glm::dvec3(mesh_.positions[t.y]), glm::dvec3(mesh_.positions[t.z])};
    }
    // The interpolated normal at a place on the triangle.
    [[nodiscard]] glm::dvec3 normal_at(const glm::uvec3& t, const glm::dvec3& place) const {
        const auto [a, b, c] = corners(t);
        const glm::dvec3 across = glm::cross(b - a, c - a);
        const double of_a = glm::dot(glm::cross(b - place, c - place), across);
        const double of_b = glm::dot(glm::cross(c - place, a - place), across);
        const double of_c = glm::dot(glm::cross(a - place, b - place), across);
        return glm::normalize(of_a * glm::dvec3(mesh_.normals[t.x]) + of_b * glm::dvec3(mesh_.normals[t.y]) +
                              of_c * glm::dvec3(mesh_.normals[t.z]));
    }

    const mesh::TriangleMesh& mesh_;
    PackedTriangles surface_;
    LargeArray<std::uint8_t> folded_; // by vertex: a triangle at it faces away from its normal
    double here_ = 0.0;               // mm
};

} // namespace

std::vector<Thickness> least_thicknesses(const mesh::TriangleMesh& mesh, int threads) {
    LargeArray<double> thickness(mesh.positions.size(), mesh.memory());
    tbb::task_arena arena(threads > 0 ? threads : tbb::task_arena::automatic);
    arena.execute([&] {
        const Solid solid(mesh);
        tbb::parallel_for(tbb::blocked_range<std::size_t>(0, thickness.size(), 1024), [&](const auto& range) {
            for (std::size_t v = range.begin(); v < range.end(); ++v) thickness[v] = solid.thickness(v);
        });
    });
    int branches = 1;
    for (const int branch : mesh.branches) branches = std::max(branches, branch + 1);
    std::vector<Thickness> least(static_cast<std::size_t>(branches), {kInfinity, {}, tree::kNoBranch});
    for (std::size_t v = 0; v < thickness.size(); ++v) {
        const int branch = mesh.branches.empty() ? tree::kNoBranch : mesh.branches[v];
        Thickness& thinnest = least[branch == tree::kNoBranch ? 0 : static_cast<std::size_t>(branch)];
        if (thickness[v] < thinnest.mm) thinnest = {thickness[v], mesh.positions[v], branch};
    }
    std::erase_if(least, [](const Thickness& one) { return one.mm == kInfinity; });
    std::ranges::stable_sort(least, {}, &Thickness::mm);
    return least;
}

} // namespace ramus::measure
