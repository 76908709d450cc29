#include "core/volume/skeletonize/sampled_line.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace ramus::volume {

SampledLine resampled(const VoxelGraph& graph, const VoxelGraph::Line& line, double voxel) {
    std::vector<MidPoint> raw{graph.nodes[static_cast<std::size_t>(line.from)]};
    raw.insert(raw.end(), line.points.begin(), line.points.end());
    raw.push_back(graph.nodes[static_cast<std::size_t>(line.to)]);
    const double length = length_mm(graph, line);
    const auto least = line.from == line.to ? 4.0 : 2.0; // so that parallel lines between two nodes stay different
    const double segments = std::max(least, std::round(length / voxel));
    SampledLine sampled;
    sampled.step = length / segments;
    double before = 0.0;
    sampled.point_of.push_back(0);
    sampled.at.push_back(raw[0].position);
    sampled.radius.push_back(raw[0].distance);
    for (std::size_t p = 1; p < raw.size(); ++p) {
        const double there = before + glm::distance(raw[p - 1].position, raw[p].position);
        const auto wanted = [&] { return sampled.step * static_cast<double>(sampled.at.size()); };
        const bool is_last = p + 1 == raw.size();
        while ((wanted() <= there || is_last) && static_cast<double>(sampled.at.size()) <= segments) {
            const double t = there > before ? std::clamp((wanted() - before) / (there - before), 0.0, 1.0) : 1.0;
            sampled.at.push_back(glm::mix(raw[p - 1].position, raw[p].position, t));
            sampled.radius.push_back(glm::mix(raw[p - 1].distance, raw[p].distance, t));
        }
        sampled.point_of.push_back(static_cast<std::uint32_t>(std::min(std::round(there / sampled.step), segments)));
        before = there;
    }
    // Distances are to the centres of outside voxels; the wall is half a voxel nearer.
    for (double& radius : sampled.radius) radius = std::max(radius - 0.5 * voxel, 0.5 * voxel);
    return sampled;
}

namespace {

// Searches along the line from point `i` for the nearest point to `position`; finds a local minimum.
std::size_t nearest_from(const std::vector<glm::dvec3>& at, std::size_t i, const glm::dvec3& position) {
    const auto away = [&](std::size_t n) {
        const glm::dvec3 offset = at[n] - position;
        return glm::dot(offset, offset);
    };
    double nearest = away(i);
    for (const int turn : {1, -1})
        while (turn > 0 ? i + 1 < at.size() : i > 0) {
            const std::size_t next = turn > 0 ? i + 1 : i - 1;
            const double distance = away(next);
            if (distance >= nearest) break;
            nearest = distance, i = next;
        }
    return i;
}

} // namespace

std::vector<Slab> slabs_of(const SampledLine& sampled, std::span<const BranchVoxels::Member> members,
                           const VoxelSet& set) {
    std::vector<Slab> slabs(sampled.at.size());
    for (std::size_t i = 0; i < slabs.size(); ++i)
        for (const std::size_t next : {i - 1, i + 1})
            if (next < slabs.size()) slabs[i].length += 0.5 * glm::distance(sampled.at[i], sampled.at[next]);
    // Anisotropic voxels are divided into nearly cubic parts, at most four along each axis.
    const glm::dvec3& spacing = set.spacing();
    const double least = std::min({spacing.x, spacing.y, spacing.z});
    const glm::ivec3 parts = glm::clamp(glm::ivec3(glm::round(spacing / least)), 1, 4);
    const glm::dvec3 part = spacing / glm::dvec3(parts);
    const double volume = part.x * part.y * part.z;
    for (const BranchVoxels::Member& member : members) {
        const glm::dvec3 corner = spacing * (glm::dvec3(set.voxel(member.at)) - 0.5) + 0.5 * part;
        std::size_t i = sampled.point_of[member.point];
        for (int z = 0; z < parts.z; ++z)
            for (int y = 0; y < parts.y; ++y)
                for (int x = 0; x < parts.x; ++x) {
                    const glm::dvec3 position = corner + part * glm::dvec3(x, y, z);
                    i = nearest_from(sampled.at, i, position);
                    slabs[i].volume += volume;
                    const glm::dvec3 offset = position - sampled.at[i];
                    slabs[i].moment += volume * offset;
                    slabs[i].second += volume * glm::outerProduct(offset, offset);
                }
    }
    return slabs;
}

} // namespace ramus::volume
