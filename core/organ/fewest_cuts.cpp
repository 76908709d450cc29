#include "core/organ/fewest_cuts.h"

#include "core/organ/resect/voxel_solid.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <oneapi/tbb/parallel_for.h>
#include <optional>
#include <utility>

namespace ramus::organ {

namespace {

// The voxels of one branch.
struct Held {
    std::size_t targets = 0, functional = 0;
    float first = std::numeric_limits<float>::infinity(); // place of the first target
    float before = -1.0F;                                 // place of the last voxel in front of it
    std::size_t beyond = 0;                               // functional voxels from there on
};

std::vector<Held> held_by(std::size_t branches, const Supply& supply, std::span<const std::uint8_t> targets,
                          std::span<const std::uint8_t> functional) {
    std::vector<Held> held(branches);
    const auto of = [&](std::size_t voxel) -> Held& { return held[static_cast<std::size_t>(supply.branch[voxel])]; };
    for (std::size_t voxel = 0; voxel < supply.branch.size(); ++voxel) {
        Held& branch = of(voxel);
        branch.functional += functional[voxel] != 0 ? 1 : 0;
        if (targets[voxel] == 0) continue;
        ++branch.targets;
        branch.first = std::min(branch.first, supply.at[voxel]);
    }
    for (std::size_t voxel = 0; voxel < supply.branch.size(); ++voxel) {
        Held& branch = of(voxel);
        if (supply.at[voxel] < branch.first)
            branch.before = std::max(branch.before, supply.at[voxel]);
        else
            branch.beyond += functional[voxel] != 0 ? 1 : 0;
    }
    return held;
}

// The place of the cut: the number with the fewest digits behind the voxel in front of the first target. Not 1 if the
// branch has a target: a cut at 1 leaves the whole branch.
double place_of(const Held& branch) {
    if (branch.targets == 0) return 1.0;
    const auto first = static_cast<double>(branch.first), before = static_cast<double>(branch.before);
    double scale = 1.0;
    for (int digits = 0; digits < 9; ++digits, scale *= 10.0) {
        const double place = first < 1.0 ? std::floor(first * scale) / scale : 1.0 - 1.0 / scale;
        if (place > before) return place;
    }
    return std::min(first, std::nextafter(1.0, 0.0));
}

// The least loss with a number of cuts, if any.
using Best = std::optional<SuggestedCuts>;

// By number of cuts: the best of both parts together.
std::vector<Best> combined(const std::vector<Best>& a, const std::vector<Best>& b, std::size_t most_cuts) {
    std::vector<Best> both(std::min(most_cuts + 1, a.size() + b.size() - 1));
    std::vector<std::pair<std::size_t, std::size_t>> from(both.size());
    std::vector<std::size_t> least(both.size(), std::numeric_limits<std::size_t>::max());
    for (std::size_t n = 0; n < a.size(); ++n)
        for (std::size_t m = 0; m < b.size() && n + m < both.size(); ++m)
            if (a[n] && b[m] && a[n]->lost + b[m]->lost < least[n + m]) {
                least[n + m] = a[n]->lost + b[m]->lost;
                from[n + m] = {n, m};
            }
    for (std::size_t n = 0; n < both.size(); ++n) {
        if (least[n] == std::numeric_limits<std::size_t>::max()) continue;
        const SuggestedCuts &one = *a[from[n].first], &other = *b[from[n].second];
        both[n] = {one.cuts, least[n]};
        both[n]->cuts.insert(both[n]->cuts.end(), other.cuts.begin(), other.cuts.end());
    }
    return both;
}

} // namespace

CutSuggestions fewest_cuts(const tree::Dependency& dependency, const Supply& supply,
                           std::span<const std::uint8_t> targets, std::span<const std::uint8_t> functional,
                           std::size_t most_cuts) {
    const auto branches = static_cast<std::size_t>(dependency.branch_count());
    std::vector<Held> held = held_by(branches, supply, targets, functional);
    CutSuggestions result;
    std::vector<std::uint8_t> reached(branches, 0); // the branch or one that it depends on is a bridge
    for (const int id : dependency.order()) {
        const auto b = static_cast<std::size_t>(id);
        const int parent = dependency.parent(id);
        reached[b] = dependency.is_bridge(id) || (parent != tree::kNoBranch && reached[std::size_t(parent)] != 0);
        if (reached[b] != 0) {
            result.covered += held[b].targets;
            continue;
        }
        result.out_of_reach += held[b].targets;
        held[b].targets = 0;
    }
    // By branch: what its dependents lose in all, and the best for them; the last entry is for the whole tree.
    std::vector<std::size_t> behind(branches + 1, 0);
    const std::vector<Best> nothing{SuggestedCuts{}};
    std::vector<std::vector<Best>> best(branches + 1, nothing);
    std::vector<std::uint8_t> needed(branches + 1, 0); // targets on the branch or behind it
    for (std::size_t n = branches; n-- > 0;) {
        const int id = dependency.order()[n];
        const auto b = static_cast<std::size_t>(id);
        const int parent = dependency.parent(id);
        const std::size_t up = parent == tree::kNoBranch ? branches : static_cast<std::size_t>(parent);
        behind[up] += behind[b] + held[b].functional;
        if (held[b].targets == 0 && needed[b] == 0) continue;
        needed[up] = 1;
        std::vector<Best> here = held[b].targets > 0 ? std::vector<Best>(1) : std::move(best[b]);
        if (dependency.is_bridge(id)) {
            if (here.size() < 2) here.resize(2);
            const std::size_t lost = behind[b] + (held[b].targets > 0 ? held[b].beyond : 0);
            if (!here[1] || lost < here[1]->lost) here[1] = {{{id, place_of(held[b])}}, lost};
        }
        best[b] = {};
        best[up] = combined(best[up], here, most_cuts);
    }
    for (Best& suggestion : best[branches]) {
        if (!suggestion || suggestion->cuts.empty()) continue;
        if (!result.by_number.empty() && suggestion->lost >= result.by_number.back().lost) continue;
        std::ranges::sort(suggestion->cuts);
        result.by_number.push_back(std::move(*suggestion));
    }
    return result;
}

std::vector<std::uint8_t> voxels_near(const Organ& organ, const Organ& lesions, double margin_mm, const JobRange& job) {
    std::vector<std::uint8_t> near(organ.count(), 0);
    if (lesions.count() == 0) return near;
    const VoxelSolid solid{lesions};
    const glm::dmat4 to_voxels = glm::inverse(organ.to_patient());
    // How far the margin reaches along each voxel axis.
    const glm::dmat3 rows = glm::transpose(glm::dmat3(to_voxels));
    const glm::dvec3 reach = margin_mm * glm::dvec3(glm::length(rows[0]), glm::length(rows[1]), glm::length(rows[2]));
    glm::dvec3 least(std::numeric_limits<double>::infinity()), most = -least;
    for (const glm::vec3& corner : solid.surface().positions) {
        const glm::dvec3 at(to_voxels * glm::dvec4(glm::dvec3(corner), 1.0));
        least = glm::min(least, at);
        most = glm::max(most, at);
    }
    const glm::dvec3 size(organ.size());
    const glm::ivec3 from(glm::clamp(glm::floor(least - reach), glm::dvec3(0.0), size));
    const glm::ivec3 to(glm::clamp(glm::ceil(most + reach) + 1.0, glm::dvec3(0.0), size));
    if (from.z >= to.z) return near;
    std::atomic<int> done{0};
    tbb::parallel_for(from.z, to.z, [&](int k) {
        if (job.cancelled()) return;
        organ.for_voxels({from.x, from.y, k}, {to.x, to.y, k + 1}, [&](const glm::ivec3& voxel, std::size_t number) {
            near[number] = solid.distance(organ.centre_mm(voxel)) <= margin_mm ? 1 : 0;
        });
        job.report(static_cast<float>(++done) / static_cast<float>(to.z - from.z));
    });
    if (job.cancelled()) return {};
    return near;
}

} // namespace ramus::organ
