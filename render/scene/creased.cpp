#include "render/scene/creased.h"

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <oneapi/tbb/parallel_for.h>

namespace ramus::render {

namespace {

// Corners of the page's triangles whose normals contradict a smooth surface through them: on creases, and next to
// walls.
std::vector<std::uint32_t> creased_corners(const PagedMesh& mesh, const TrianglePage& page) {
    // Cosine between a triangle's normal and those at its corners. Tuned with 16 cells around a vessel: one of two
    // hundred vertices at a fork is beyond it; with a larger angle, walls between vessels would be crossed.
    constexpr float kLeastCosine = 0.9F;
    constexpr float kLeastHeight = 0.001F; // of its longest edge: thinner triangles have unreliable normals
    std::vector<std::uint32_t> found;
    for (std::uint32_t i = 0; i < page.count; ++i) {
        const glm::uvec3& t = page.triangles[i];
        const std::array<EdgeEnd, 3> ends{end_of(mesh.vertex(t.x)), end_of(mesh.vertex(t.y)), end_of(mesh.vertex(t.z))};
        const glm::vec3 ab = ends[1].position - ends[0].position, ac = ends[2].position - ends[0].position;
        const glm::vec3 across = glm::cross(ab, ac);
        if (glm::length(across) <= kLeastHeight * std::max(glm::dot(ab, ab), glm::dot(ac, ac))) continue;
        const float least = kLeastCosine * glm::length(across);
        for (int k = 0; k < 3; ++k)
            if (glm::dot(across, ends.at(std::size_t(k)).normal) < least) found.push_back(t[k]);
    }
    return found;
}

} // namespace

std::vector<std::uint8_t> creased_vertices(const PagedMesh& mesh, const std::vector<std::size_t>& pages) {
    std::vector<std::vector<std::uint32_t>> found(pages.size());
    std::vector<std::uint8_t> creased(pages.empty() ? 0 : mesh.vertex_pages().size() * VertexPage::kSize, 0);
    constexpr int kRings = 2;
    const auto mark_found = [&](const auto& find) {
        tbb::parallel_for(std::size_t{0}, pages.size(),
                          [&](std::size_t i) { found[i] = find(*mesh.triangle_pages()[pages[i]]); });
        for (const auto& some : found)
            for (const std::uint32_t vertex : some) creased[vertex] = 1;
    };
    mark_found([&](const TrianglePage& page) { return creased_corners(mesh, page); });
    for (int ring = 0; ring < kRings; ++ring)
        mark_found([&](const TrianglePage& page) {
            std::vector<std::uint32_t> beside;
            for (std::uint32_t i = 0; i < page.count; ++i) {
                const glm::uvec3& t = page.triangles[i];
                if (creased[t.x] + creased[t.y] + creased[t.z] > 0) beside.insert(beside.end(), {t.x, t.y, t.z});
            }
            return beside;
        });
    return creased;
}

} // namespace ramus::render
