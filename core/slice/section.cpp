#include "core/slice/section.h"

#include <algorithm>
#include <numeric>
#include <oneapi/tbb/parallel_for.h>
#include <utility>

namespace ramus::slice {

namespace {

constexpr std::size_t kNone = static_cast<std::size_t>(-1);

std::pair<std::uint32_t, std::uint32_t> edge_of(const EdgePoint& point) { return {point.first, point.second}; }

// For each piece, the piece that begins at its end.
std::vector<std::size_t> successors(const std::vector<CutTriangle>& pieces, std::vector<bool>& has_predecessor) {
    std::vector<std::size_t> next(pieces.size(), kNone);
    for (std::size_t p = 0; p < pieces.size(); ++p) {
        const auto edge = edge_of(pieces[p].to);
        auto found = std::ranges::lower_bound(pieces, edge, {}, [](const auto& piece) { return edge_of(piece.from); });
        for (; found != pieces.end() && edge_of(found->from) == edge; ++found) {
            const auto n = static_cast<std::size_t>(found - pieces.begin());
            if (has_predecessor[n]) continue; // of an edge with more than two triangles
            next[p] = n;
            has_predecessor[n] = true;
            break;
        }
    }
    return next;
}

} // namespace

std::vector<Loop> joined_loops(std::vector<CutTriangle> pieces) {
    std::ranges::sort(pieces, {},
                      [](const CutTriangle& piece) { return std::pair(edge_of(piece.from), edge_of(piece.to)); });
    std::vector<bool> has_predecessor(pieces.size(), false);
    const std::vector<std::size_t> next = successors(pieces, has_predecessor);
    std::vector<bool> used(pieces.size(), false);
    std::vector<Loop> loops;
    const auto follow = [&](std::size_t begin) {
        Loop loop;
        std::size_t at = begin;
        while (true) {
            used[at] = true;
            loop.points.push_back(pieces[at].from);
            if (next[at] == kNone) {
                loop.points.push_back(pieces[at].to);
                loop.closed = false;
                break;
            }
            at = next[at];
            if (used[at]) break;
        }
        loops.push_back(std::move(loop));
    };
    for (std::size_t p = 0; p < pieces.size(); ++p)
        if (!has_predecessor[p]) follow(p); // open polylines, from their begin
    for (std::size_t p = 0; p < pieces.size(); ++p)
        if (!used[p]) follow(p);
    return loops;
}

bool plane_crosses(const Plane& plane, const Bounds<glm::dvec3>& box) {
    const glm::dvec3 half = 0.5 * box.size();
    const double reach = glm::dot(glm::abs(plane.normal), half);
    return std::abs(plane.height(box.least + half)) <= reach;
}

bool MeshBlocks::crosses(const Plane& plane, const Bounds<glm::vec3>& box) {
    return plane_crosses(plane, {glm::dvec3(box.least), glm::dvec3(box.most)});
}

MeshBlocks::MeshBlocks(const mesh::TriangleMesh& mesh)
    : mesh_(&mesh), boxes_((mesh.triangles.size() + kBlock - 1) / kBlock) {
    tbb::parallel_for(std::size_t{0}, boxes_.size(), [&](std::size_t b) {
        const std::size_t end = std::min((b + 1) * kBlock, mesh.triangles.size());
        for (std::size_t t = b * kBlock; t < end; ++t)
            for (int k = 0; k < 3; ++k) boxes_[b].hold(mesh.positions[mesh.triangles[t][k]]);
    });
}

std::vector<Loop> section(const MeshBlocks& blocks, const Plane& plane) {
    std::vector<CutTriangle> pieces;
    const auto& positions = blocks.mesh().positions;
    blocks.for_crossed(plane, [&](std::span<const glm::uvec3> triangles) {
        cut_triangles(
            triangles, plane, [&](std::uint32_t v) { return glm::dvec3(positions[v]); }, pieces);
    });
    return joined_loops(std::move(pieces));
}

std::vector<Loop> section(const mesh::TriangleMesh& mesh, const Plane& plane) {
    return section(MeshBlocks(mesh), plane);
}

double enclosed_mm2(std::span<const Loop> loops, const glm::dvec3& normal) {
    double twice = 0.0;
    for (const Loop& loop : loops) {
        if (!loop.closed || loop.points.empty()) continue;
        const glm::dvec3& about = loop.points.front().at;
        for (std::size_t k = 1; k + 1 < loop.points.size(); ++k)
            twice += glm::dot(normal, glm::cross(loop.points[k].at - about, loop.points[k + 1].at - about));
    }
    return 0.5 * twice;
}

} // namespace ramus::slice
