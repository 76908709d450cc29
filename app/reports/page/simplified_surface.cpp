#include "app/reports/page/simplified_surface.h"

#include <algorithm>
#include <meshoptimizer.h>
#include <numeric>
#include <span>
#include <tbb/parallel_for.h>
#include <unordered_map>

namespace ramus::app {

namespace {

// The triangles of a branch with vertices of its own.
struct PartOfSurface {
    std::vector<std::uint32_t> indices;
    std::vector<std::uint32_t> vertices; // of the surface
    std::vector<glm::vec3> positions;
};

PartOfSurface part_of(const BranchSurface& surface, std::size_t rank) {
    const std::span<const std::uint32_t> whole(surface.indices);
    const auto range = whole.subspan(3 * std::size_t{surface.first[rank]},
                                     3 * std::size_t{surface.first[rank + 1] - surface.first[rank]});
    PartOfSurface part;
    part.indices.reserve(range.size());
    std::unordered_map<std::uint32_t, std::uint32_t> local;
    local.reserve(range.size() / 4);
    for (const std::uint32_t v : range) {
        const auto [at, is_new] = local.try_emplace(v, static_cast<std::uint32_t>(part.vertices.size()));
        if (is_new) part.vertices.push_back(v), part.positions.push_back(surface.positions[v]);
        part.indices.push_back(at->second);
    }
    return part;
}

void simplify(PartOfSurface& part, const Simplification& wanted, double radius_mm) {
    if (part.indices.empty()) return;
    const float* const positions = &part.positions.front().x;
    const double scale = meshopt_simplifyScale(positions, part.positions.size(), sizeof(glm::vec3));
    const double error = radius_mm > 0.0 ? wanted.share_of_radius * radius_mm : wanted.most_mm;
    const auto target =
        static_cast<std::size_t>(wanted.triangles * static_cast<double>(part.indices.size()) / 3.0) * std::size_t{3};
    std::vector<std::uint32_t> fewer(part.indices.size());
    fewer.resize(
        meshopt_simplify(fewer.data(), part.indices.data(), part.indices.size(), positions, part.positions.size(),
                         sizeof(glm::vec3), target, static_cast<float>(error / std::max(scale, 1e-12)),
                         wanted.moves_borders ? 0U : static_cast<unsigned>(meshopt_SimplifyLockBorder), nullptr));
    part.indices = std::move(fewer);
}

void order(PartOfSurface& part) {
    if (part.indices.empty()) return;
    std::vector<std::uint32_t> made(part.indices.size());
    meshopt_optimizeVertexCacheStrip(made.data(), part.indices.data(), part.indices.size(), part.positions.size());
    part.indices = std::move(made);
}

// Applies `change` to the triangles of each branch.
template <class Change> BranchSurface changed(const BranchSurface& surface, const Change& change) {
    const std::size_t ranks = surface.first.size() - 1;
    std::vector<std::vector<std::uint32_t>> made(ranks);
    tbb::parallel_for(std::size_t{0}, ranks, [&](std::size_t rank) {
        PartOfSurface part = part_of(surface, rank);
        change(part, rank);
        for (std::uint32_t& v : part.indices) v = part.vertices[v];
        made[rank] = std::move(part.indices);
    });
    BranchSurface result{surface.positions, {}, {0}, surface.radius_mm};
    for (std::vector<std::uint32_t>& one : made) {
        result.indices.insert(result.indices.end(), one.begin(), one.end());
        result.first.push_back(static_cast<std::uint32_t>(result.triangles()));
        std::vector<std::uint32_t>().swap(one);
    }
    return result;
}

} // namespace

BranchSurface simplified(const BranchSurface& surface, const Simplification& wanted) {
    return changed(surface, [&](PartOfSurface& part, std::size_t rank) {
        simplify(part, wanted, double(surface.radius_mm[rank]));
        order(part);
    });
}

BranchSurface simplified_together(const BranchSurface& surface, double triangles) {
    // Each branch has vertices of its own, at equal places on borders; the simplifier knows them for seams.
    std::vector<std::uint32_t> indices, sources, ranks;
    std::vector<glm::vec3> positions;
    const std::size_t count = surface.first.size() - 1;
    for (std::size_t rank = 0; rank < count; ++rank) {
        const PartOfSurface part = part_of(surface, rank);
        const auto base = static_cast<std::uint32_t>(positions.size());
        for (const std::uint32_t v : part.indices) indices.push_back(base + v);
        sources.insert(sources.end(), part.vertices.begin(), part.vertices.end());
        positions.insert(positions.end(), part.positions.begin(), part.positions.end());
        ranks.resize(positions.size(), static_cast<std::uint32_t>(rank));
    }
    BranchSurface made{surface.positions, {}, std::vector<std::uint32_t>(count + 1, 0), surface.radius_mm};
    if (indices.empty()) return made;
    const auto target =
        static_cast<std::size_t>(triangles * static_cast<double>(indices.size()) / 3.0) * std::size_t{3};
    constexpr float kAnyError = 1.0F; // of the extent: the number of triangles is what is wanted
    std::vector<std::uint32_t> fewer(indices.size());
    fewer.resize(meshopt_simplify(fewer.data(), indices.data(), indices.size(), &positions.front().x, positions.size(),
                                  sizeof(glm::vec3), target, kAnyError, 0U, nullptr));
    for (std::size_t i = 0; i < fewer.size(); i += 3) ++made.first[ranks[fewer[i]] + 1];
    std::partial_sum(made.first.begin(), made.first.end(), made.first.begin());
    made.indices.resize(fewer.size());
    std::vector<std::uint32_t> next(made.first.begin(), made.first.end() - 1);
    for (std::size_t i = 0; i < fewer.size(); i += 3) {
        const std::size_t at = 3 * std::size_t{next[ranks[fewer[i]]]++};
        for (std::size_t k = 0; k < 3; ++k) made.indices[at + k] = sources[fewer[i + k]];
    }
    return ordered(made);
}

BranchSurface ordered(const BranchSurface& surface) {
    return changed(surface, [](PartOfSurface& part, std::size_t) { order(part); });
}

} // namespace ramus::app
