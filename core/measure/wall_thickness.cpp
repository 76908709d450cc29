#include "core/measure/wall_thickness.h"

#include "core/base/infinity.h"
#include "core/measure/mesh_distance.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <numeric>
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

namespace ramus::measure {

namespace {

class Solid {
public:
    explicit Solid(const mesh::TriangleMesh& mesh) : mesh_(mesh), surface_(mesh) {}

    [[nodiscard]] double along_normal(std::size_t vertex) const { return way_out(vertex, inward(vertex)); }

    // Beside the normal, ways that lean by 30 degrees count, each as far as it leads along the normal. In a plate and
    // in a tube one of them is the thickness again; at the edge of a wedge, or in the crease between two vessels, all
    // but the one that leaves there at once are long.
    [[nodiscard]] double thickness(std::size_t vertex) const {
        const glm::dvec3 in = inward(vertex);
        const glm::dvec3 aside = glm::normalize(
            glm::cross(in, std::abs(in.x) < 0.7 ? glm::dvec3(1.0, 0.0, 0.0) : glm::dvec3(0.0, 1.0, 0.0)));
        const glm::dvec3 upward = glm::cross(in, aside);
        constexpr int kWays = 8;
        const double lean = std::acos(-1.0) / 6.0;
        double most = way_out(vertex, in);
        for (int i = 0; i < kWays; ++i) {
            const double turn = 2.0 * std::acos(-1.0) * i / kWays;
            const glm::dvec3 outward = std::cos(turn) * aside + std::sin(turn) * upward;
            const double way = way_out(vertex, std::cos(lean) * in + std::sin(lean) * outward);
            most = std::max(most, way * std::cos(lean));
        }
        return most;
    }

private:
    [[nodiscard]] glm::dvec3 inward(std::size_t vertex) const { return -glm::dvec3(mesh_.normals[vertex]); }
    [[nodiscard]] double way_out(std::size_t vertex, const glm::dvec3& direction) const {
        const double way = surface_.way_out(glm::dvec3(mesh_.positions[vertex]), direction);
        return way < kInfinity ? way : 0.0; // out through an edge, at once
    }

    const mesh::TriangleMesh& mesh_;
    MeshDistance surface_;
};

} // namespace

std::vector<Thickness> least_thicknesses(const mesh::TriangleMesh& mesh, int threads) {
    const Solid solid(mesh);
    std::vector<float> at_least(mesh.positions.size()); // the thickness is not less than along the normal
    tbb::task_arena arena(threads > 0 ? threads : tbb::task_arena::automatic);
    arena.execute([&] {
        tbb::parallel_for(tbb::blocked_range<std::size_t>(0, at_least.size(), 1024), [&](const auto& range) {
            for (std::size_t v = range.begin(); v < range.end(); ++v)
                at_least[v] = static_cast<float>(solid.along_normal(v));
        });
    });
    std::vector<std::uint32_t> order(at_least.size());
    std::iota(order.begin(), order.end(), 0U);
    std::ranges::stable_sort(order, {}, [&](std::uint32_t v) { return at_least[v]; });
    int branches = 1;
    for (const int branch : mesh.branches) branches = std::max(branches, branch + 1);
    std::vector<Thickness> least(static_cast<std::size_t>(branches), {kInfinity, {}, tree::kNoBranch});
    for (const std::uint32_t v : order) {
        Thickness& thinnest = least[mesh.branches.empty() ? 0 : static_cast<std::size_t>(mesh.branches[v])];
        if (at_least[v] >= thinnest.mm) continue;
        if (const double here = solid.thickness(v); here < thinnest.mm)
            thinnest = {here, mesh.positions[v], mesh.branches.empty() ? tree::kNoBranch : mesh.branches[v]};
    }
    std::erase_if(least, [](const Thickness& thickness) { return thickness.mm == kInfinity; });
    std::ranges::stable_sort(least, {}, &Thickness::mm);
    return least;
}

} // namespace ramus::measure
