#include "core/volume/relax_surface.h"

#include "core/base/grouped.h"

#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>
#include <vector>

namespace ramus::volume {

namespace {

// Tuned by eye on an organ and its vessels, 4 mm slices: how much each pass is drawn back to where the surface was, and
// how much of what is taken back is a vertex's own part rather than its neighbours'.
constexpr float kFaith = 0.01F, kOwn = 0.5F;

template <class Each> void for_vertices(std::size_t count, const Each& each) {
    oneapi::tbb::parallel_for(oneapi::tbb::blocked_range<std::size_t>(0, count, 4096), [&](const auto& range) {
        for (std::size_t v = range.begin(); v < range.end(); ++v) each(v);
    });
}

} // namespace

void relax_surface(mesh::TriangleMesh& surface, const glm::dmat4& to_patient, int passes, const Job& job) {
    const std::size_t count = surface.positions.size();
    const glm::mat3 to_mm{glm::dmat3(to_patient)};
    const glm::mat3 to_voxels{glm::inverse(glm::dmat3(to_patient))};
    // Of each vertex the next one around each of its triangles: of a closed surface, all of its neighbours, once each.
    const Grouped<std::uint32_t> neighbours(count, [&](const auto& put) {
        for (const glm::uvec3& t : surface.triangles)
            for (int k = 0; k < 3; ++k) put(t[k], t[(k + 1) % 3]);
    });
    const std::vector<glm::vec3> before(surface.positions.begin(), surface.positions.end());
    std::vector<glm::vec3> from = before, to(count), back(count);
    const auto mean = [&](const std::vector<glm::vec3>& of, std::size_t v) {
        const auto around = neighbours.of(v);
        glm::vec3 sum(0.0F);
        for (const std::uint32_t other : around) sum += of[other];
        return around.empty() ? of[v] : sum / float(around.size());
    };
    for (int pass = 0; pass < passes && !job.cancelled(); ++pass) {
        for_vertices(count, [&](std::size_t v) {
            to[v] = mean(from, v);
            back[v] = to[v] - glm::mix(from[v], before[v], kFaith);
        });
        for_vertices(count, [&](std::size_t v) {
            const glm::vec3 wanted = to[v] - glm::mix(mean(back, v), back[v], kOwn);
            const glm::vec3 moved = glm::clamp(to_voxels * (wanted - before[v]), glm::vec3(-0.5F), glm::vec3(0.5F));
            from[v] = before[v] + to_mm * moved;
        });
    }
    std::copy(from.begin(), from.end(), surface.positions.begin());
    std::vector<glm::vec3> normals(count, glm::vec3(0.0F));
    for (const glm::uvec3& t : surface.triangles) {
        const glm::vec3 area = glm::cross(from[t.y] - from[t.x], from[t.z] - from[t.x]);
        for (int k = 0; k < 3; ++k) normals[t[k]] += area;
    }
    surface.normals.resize(count);
    for (std::size_t v = 0; v < count; ++v) {
        const float length = glm::length(normals[v]);
        surface.normals[v] = length > 0.0F ? normals[v] / length : glm::vec3(0.0F, 0.0F, 1.0F);
    }
}

} // namespace ramus::volume
