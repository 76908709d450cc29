#include "core/slice/section.h"

#include <algorithm>
#include <cstdint>
#include <oneapi/tbb/parallel_for.h>
#include <utility>

namespace ramus::slice {

namespace {

constexpr std::size_t kNone = static_cast<std::size_t>(-1);

std::uint64_t edge_of(const EdgePoint& point) { return std::uint64_t{point.first} << 32U | point.second; }

// Pieces in the order of the edge that they begin at, then of the one that they end at. Sorting these moves less than
// sorting pieces.
struct PieceOrder {
    std::uint64_t from = 0;
    std::uint32_t piece = 0;
};

std::vector<PieceOrder> ordered(const std::vector<CutTriangle>& pieces) {
    std::vector<PieceOrder> order(pieces.size());
    for (std::size_t p = 0; p < pieces.size(); ++p) order[p] = {edge_of(pieces[p].from), static_cast<std::uint32_t>(p)};
    std::ranges::sort(order, [&](const PieceOrder& a, const PieceOrder& b) {
        return a.from != b.from ? a.from < b.from : edge_of(pieces[a.piece].to) < edge_of(pieces[b.piece].to);
    });
    return order;
}

// For each place of the order, the place of the piece that begins where the piece ends.
std::vector<std::size_t> successors(const std::vector<CutTriangle>& pieces, const std::vector<PieceOrder>& order,
                                    std::vector<bool>& has_predecessor) {
    std::vector<std::size_t> next(pieces.size(), kNone);
    for (std::size_t n = 0; n < order.size(); ++n) {
        const std::uint64_t edge = edge_of(pieces[order[n].piece].to);
        auto found = std::ranges::lower_bound(order, edge, {}, &PieceOrder::from);
        for (; found != order.end() && found->from == edge; ++found) {
            const auto follower = static_cast<std::size_t>(found - order.begin());
            if (has_predecessor[follower]) continue; // of an edge with more than two triangles
            next[n] = follower;
            has_predecessor[follower] = true;
            break;
        }
    }
    return next;
}

} // namespace

std::vector<Loop> joined_loops(const std::vector<CutTriangle>& pieces) {
    const std::vector<PieceOrder> order = ordered(pieces);
    std::vector<bool> has_predecessor(pieces.size(), false);
    const std::vector<std::size_t> next = successors(pieces, order, has_predecessor);
    std::vector<bool> used(pieces.size(), false);
    std::vector<Loop> loops;
    const auto follow = [&](std::size_t begin) {
        Loop loop;
        std::size_t at = begin;
        while (true) {
            used[at] = true;
            const CutTriangle& piece = pieces[order[at].piece];
            loop.points.push_back(piece.from);
            if (next[at] == kNone) {
                loop.points.push_back(piece.to);
                loop.closed = false;
                break;
            }
            at = next[at];
            if (used[at]) break;
        }
        loops.push_back(std::move(loop));
    };
    for (std::size_t n = 0; n < order.size(); ++n)
        if (!has_predecessor[n]) follow(n); // open polylines, from their begin
    for (std::size_t n = 0; n < order.size(); ++n)
        if (!used[n]) follow(n);
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
    return joined_loops(pieces);
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
