#include "core/volume/skeletonize/cut_ends.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <vector>

namespace ramus::volume {

namespace {

// Lengths in radii. The base point is this far from the tip: nearer, an oblique cross-section pulls the centerline to
// its corner.
constexpr double kBeforeTip = 1.5;
constexpr double kDirection = 1.0;   // length of the part before the base that gives the direction
constexpr double kFarthestOff = 3.5; // from the base to the border: thinning stops up to a radius before it
constexpr double kOverWidth = 0.5;   // distance from the axis that the mask must cover at the border
constexpr double kLeastCosine =
    0.35; // of the angle between the vessel and the border's normal; below, the vessel is nearly parallel to the border

bool is_set(const VoxelSet& set, const glm::ivec3& voxel) { return set.bits().test(voxel - set.origin()); }

// The last part of a vessel.
struct LastPart {
    std::vector<std::uint32_t> points; // from the tip to the base
    glm::dvec3 along{0.0};             // unit direction outward
};

class Ends {
public:
    explicit Ends(const tree::Graph& graph) : graph_(graph), next_(graph.points.size()) {
        for (const auto& [a, b] : graph.edges) next_[a].push_back(b), next_[b].push_back(a);
    }
    [[nodiscard]] bool is_end(std::uint32_t point) const { return next_[point].size() == 1; }
    // The last part of the vessel that ends at `tip`, at most to the next node.
    [[nodiscard]] LastPart last_part(std::uint32_t tip) const {
        LastPart part{{tip}, {}};
        std::uint32_t at = next_[tip].front(), before = tip;
        const auto walk = [&](const glm::dvec3& from, double radii, const auto& visit) {
            while (next_[at].size() == 2 && glm::distance(point(at).position, from) < radii * point(at).radius) {
                visit();
                const std::uint32_t on = next_[at][0] == before ? next_[at][1] : next_[at][0];
                before = at, at = on;
            }
        };
        walk(point(tip).position, kBeforeTip, [&] { part.points.push_back(at); });
        if (next_[at].size() == 2) {
            part.points.push_back(at);
            before = part.points[part.points.size() - 2];
            at = next_[at][0] == before ? next_[at][1] : next_[at][0];
            before = part.points.back();
        }
        walk(point(part.points.back()).position, kDirection, [] {});
        const glm::dvec3 way = point(part.points.back()).position - point(at).position;
        part.along = way / std::max(glm::length(way), 1e-12);
        return part;
    }

private:
    [[nodiscard]] const tree::Point& point(std::uint32_t p) const { return graph_.points[p]; }
    const tree::Graph& graph_;
    std::vector<std::vector<std::uint32_t>> next_;
};

// Whether the voxels of the border layer are set at `place` and half a radius around it.
bool vessel_is_cut_at(const VoxelSet& set, const glm::dvec3& place, int axis, int layer, double radius) {
    for (int side = 0; side < 5; ++side) {
        glm::dvec3 at = place;
        const int across = (axis + 1 + side / 2 % 2) % 3;
        if (side < 4) at[across] += (side % 2 == 0 ? -1.0 : 1.0) * kOverWidth * radius;
        glm::ivec3 voxel(glm::round(at / set.spacing()));
        voxel[axis] = layer;
        if (!is_set(set, voxel)) return false;
    }
    return true;
}

} // namespace

std::vector<VolumeCut> extend_to_border(tree::Graph& graph, const VoxelSet& set, const glm::ivec3& size) {
    std::vector<VolumeCut> cuts;
    const Ends ends(graph);
    for (std::uint32_t p = 0; p < graph.points.size(); ++p) {
        if (!ends.is_end(p)) continue;
        const LastPart part = ends.last_part(p);
        const tree::Point base = graph.points[part.points.back()];
        double nearest = kFarthestOff * base.radius;
        glm::dvec3 outward(0.0);
        for (int axis = 0; axis < 3; ++axis) {
            if (std::abs(part.along[axis]) < kLeastCosine) continue;
            const bool upper = part.along[axis] > 0.0;
            const double border = (upper ? size[axis] - 0.5 : -0.5) * set.spacing()[axis];
            const double on = (border - base.position[axis]) / part.along[axis];
            if (!(on > 0.0) || on >= nearest ||
                !vessel_is_cut_at(set, base.position + on * part.along, axis, upper ? size[axis] - 1 : 0, base.radius))
                continue;
            nearest = on;
            outward = glm::dvec3(0.0);
            outward[axis] = upper ? 1.0 : -1.0;
        }
        if (outward == glm::dvec3(0.0)) continue;
        // Distributes the points of the last part evenly from the base to the border.
        const std::size_t count = part.points.size() - 1;
        for (std::size_t n = 0; n < count; ++n) {
            const double on = nearest * static_cast<double>(count - n) / static_cast<double>(count);
            graph.points[part.points[n]] = {base.position + on * part.along, base.radius};
        }
        if (count > 0) cuts.push_back({p, outward});
    }
    return cuts;
}

} // namespace ramus::volume
