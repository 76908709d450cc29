#include "core/volume/smooth_level.h"

#include "core/base/memory.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>
#include <limits>
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>
#include <optional>
#include <vector>

namespace ramus::volume {

namespace {

// Least distance of level 0 from the centre of a voxel, in thinnest sides of a voxel. Tuned: a larger one leaves
// notches where the true boundary passes near a centre.
constexpr float kMargin = 0.05F;
// Limit of the second difference of the distance to the boundary, in voxels. It is 0 at flat walls, at least 1 across a
// part of four voxels, and 0.46 along the wall of a rod of one voxel.
constexpr float kKink = 0.4F;
// Sweeps at each resolution, and number of coarser resolutions. Tuned on ellipsoids with slices four times as thick as
// their pixels are wide. Twice the sweeps reduce the largest 5 % of the angles by only 1 degree more.
constexpr int kSweeps = 40, kCoarser = 2;
// Largest distance from the other side that is needed, in voxels: the second next slice of the thickest slices.
constexpr int kMostReach = 8;
constexpr std::uint8_t kAllAxes = 7;

using Offset = glm::vec<3, std::int8_t>;
struct Nearest {
    Offset offset{0}; // in voxels, to a voxel of the other side
    float length = std::numeric_limits<float>::infinity();
};

struct Bending {
    MaskBand band;
    MaskBand::Numbered voxels;
    glm::vec3 spacing; // mm
    LargeArray<float> least, most;
    LargeArray<float> values;       // with a 0 after the last, for neighbours that are not in the band
    LargeArray<std::uint8_t> bends; // a bit for each axis along which the second difference counts

    [[nodiscard]] std::size_t count() const { return voxels.inside.size(); }
    [[nodiscard]] float second_difference(const LargeArray<float>& of, std::size_t n, int axis) const {
        const auto& around = voxels.neighbours[n];
        const auto a = static_cast<std::size_t>(axis);
        return of[around[2 * a]] - 2.0F * of[n] + of[around[2 * a + 1]];
    }
};
constexpr double kBytesEach = sizeof(MaskBand::Neighbours) + 3 + 5 * sizeof(float) + sizeof(glm::vec3);

template <class Each> void for_band(std::size_t count, const Each& each) {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, 4096), [&](const auto& range) {
        for (std::size_t n = range.begin(); n < range.end(); ++n) each(n);
    });
}

// For each voxel the least length(offset) over the offsets to voxels of the other side. Offsets propagate between
// neighbours in `reach` passes.
template <class Length>
LargeArray<float> least_to_other_side(const MaskBand::Numbered& voxels, int reach, const Length& length) {
    const std::size_t count = voxels.inside.size();
    std::vector<Nearest> now(count), next(count);
    for (int pass = 0; pass <= reach; ++pass) {
        for_band(count, [&](std::size_t n) {
            Nearest best = now[n];
            for (std::size_t side = 0; side < 6; ++side) {
                const std::uint32_t other = voxels.neighbours[n][side];
                if (other == count) continue;
                Offset offset(0);
                if (voxels.inside[other] == voxels.inside[n]) {
                    if (std::isinf(now[other].length)) continue;
                    offset = now[other].offset;
                }
                offset[static_cast<int>(side / 2)] += static_cast<std::int8_t>(side % 2 == 0 ? -1 : 1);
                const float found = length(glm::vec3(offset));
                if (found < best.length) best = {offset, found};
            }
            next[n] = best;
        });
        now.swap(next);
    }
    LargeArray<float> lengths(count);
    for_band(count, [&](std::size_t n) { lengths[n] = now[n].length; });
    return lengths;
}

// The boundary is between voxel centres: not farther than the nearest centre of the other side, and not nearer than the
// nearest cell of voxel centres that has a corner on the other side.
void set_bounds(Bending& state) {
    const std::size_t count = state.count();
    const glm::vec3& spacing = state.spacing;
    const float thinnest = std::min({spacing.x, spacing.y, spacing.z});
    const float thickest = std::max({spacing.x, spacing.y, spacing.z});
    const int reach = static_cast<int>(std::min(float(kMostReach), std::ceil(2.0F * thickest / thinnest)));
    const auto farthest =
        least_to_other_side(state.voxels, reach, [&](const glm::vec3& o) { return glm::length(o * spacing); });
    const auto nearest = least_to_other_side(state.voxels, reach, [&](const glm::vec3& o) {
        return glm::length(glm::max(glm::abs(o) - 1.0F, 0.0F) * spacing);
    });
    state.least.resize(count);
    state.most.resize(count);
    state.values.resize(count + 1, 0.0F);
    state.values[count] = 0.0F;
    for_band(count, [&](std::size_t n) {
        const float low = std::max(nearest[n], kMargin * thinnest);
        state.least[n] = state.voxels.inside[n] != 0 ? low : -farthest[n];
        state.most[n] = state.voxels.inside[n] != 0 ? farthest[n] : -low;
        state.values[n] = 0.5F * (state.least[n] + state.most[n]);
    });
}

void choose_differences(Bending& state) {
    const std::size_t count = state.count();
    state.bends.resize(count);
    for_band(count, [&](std::size_t n) {
        state.bends[n] = 0;
        for (int axis = 0; axis < 3; ++axis) {
            const auto a = static_cast<std::size_t>(axis);
            const auto& around = state.voxels.neighbours[n];
            if (around[2 * a] < count && around[2 * a + 1] < count &&
                (state.voxels.thin[n] == 0 ||
                 std::abs(state.second_difference(state.values, n, axis)) < kKink * state.spacing[axis]))
                state.bends[n] |= static_cast<std::uint8_t>(1U << a);
        }
    });
}

void relax(Bending& state, const JobRange& job) {
    const std::size_t count = state.count();
    const glm::vec3 weights = 1.0F / (state.spacing * state.spacing * state.spacing * state.spacing);
    const float step =
        1.0F / (16.0F * (weights.x + weights.y + weights.z)); // 16: largest eigenvalue of a squared second difference
    LargeArray<glm::vec3> differences(count + 1);
    differences[count] = glm::vec3(0.0F);
    LargeArray<float> before = state.values, ahead = state.values;
    float momentum = 1.0F;
    for (int sweep = 0; sweep < kSweeps && !job.cancelled(); ++sweep) {
        for_band(count, [&](std::size_t n) {
            for (int axis = 0; axis < 3; ++axis)
                differences[n][axis] =
                    (state.bends[n] >> axis & 1) != 0 ? weights[axis] * state.second_difference(ahead, n, axis) : 0.0F;
        });
        const float next = 0.5F * (1.0F + std::sqrt(1.0F + 4.0F * momentum * momentum));
        const float onward = (momentum - 1.0F) / next;
        momentum = next;
        before.swap(state.values);
        for_band(count, [&](std::size_t n) {
            const auto& around = state.voxels.neighbours[n];
            float slope = 0.0F;
            for (int axis = 0; axis < 3; ++axis) {
                const auto a = static_cast<std::size_t>(axis);
                slope += differences[around[2 * a]][axis] - 2.0F * differences[n][axis] +
                         differences[around[2 * a + 1]][axis];
            }
            const float value = std::clamp(ahead[n] - step * slope, state.least[n], state.most[n]);
            ahead[n] = value + onward * (value - before[n]);
            state.values[n] = value;
        });
        job.report(static_cast<float>(sweep + 1) / static_cast<float>(kSweeps));
    }
}

BitMask every_second(const BitMask& mask, const glm::ivec3& steps) {
    BitMask coarse((mask.size() + steps - 1) / steps);
    tbb::parallel_for(0, coarse.size().z, [&](int k) {
        for (int j = 0; j < coarse.size().y; ++j)
            for (int i = 0; i < coarse.size().x; ++i)
                if (mask.test(glm::ivec3(i, j, k) * steps)) coarse.set({i, j, k});
    });
    return coarse;
}

// Applies the bounds of the finer resolution to the voxels that are in both.
void hold_to_finer(Bending& state, const Bending& finer, const glm::ivec3& steps) {
    state.band.for_each([&](std::uint32_t n, const glm::ivec3& voxel) {
        if (!finer.band.has(voxel * steps)) return;
        const std::uint32_t fine = finer.band.number_of(voxel * steps);
        float least = std::max(state.least[n], finer.least[fine]);
        float most = std::min(state.most[n], finer.most[fine]);
        // For parts that are smaller than the coarse voxels, the two intervals may be disjoint.
        if (least > most) least = finer.least[fine], most = finer.most[fine];
        state.least[n] = least;
        state.most[n] = most;
        state.values[n] = 0.5F * (least + most);
    });
}

// None: a voxel is not in the coarse band, or belongs to a thin part.
std::optional<float> interpolated(const Bending& coarse, const glm::ivec3& voxel, const glm::ivec3& steps) {
    const glm::ivec3 lower = (voxel + 2 * steps) / steps - 2; // rounds down: the band begins at -2
    const glm::vec3 part = glm::vec3(voxel - lower * steps) / glm::vec3(steps);
    float sum = 0.0F;
    for (int corner = 0; corner < 8; ++corner) {
        glm::ivec3 at = lower;
        float weight = 1.0F;
        for (int axis = 0; axis < 3; ++axis) {
            const bool upper = (corner >> axis & 1) != 0;
            at[axis] += upper ? 1 : 0;
            weight *= upper ? part[axis] : 1.0F - part[axis];
        }
        if (weight == 0.0F) continue;
        if (!coarse.band.has(at)) return std::nullopt;
        const std::uint32_t n = coarse.band.number_of(at);
        if (coarse.bends[n] != kAllAxes) return std::nullopt;
        sum += weight * coarse.values[n];
    }
    return sum;
}

Result<Bending> solve(const BitMask& mask, const glm::vec3& spacing, int coarser, double memory_bytes,
                      const JobRange& job, const Bending* finer = nullptr, const glm::ivec3& finer_steps = {}) {
    MaskBand band(mask);
    const double bytes = kBytesEach * static_cast<double>(band.size()), left = memory_left(memory_bytes);
    if (bytes > left || band.size() >= std::numeric_limits<std::uint32_t>::max())
        return fail(takes_too_much("the smooth surface", bytes, left), {}, "crop the volume, or ask for the exact one");
    Bending state{std::move(band), {}, spacing, {}, {}, {}, {}};
    state.voxels = state.band.numbered();
    set_bounds(state);
    if (finer != nullptr) hold_to_finer(state, *finer, finer_steps);
    choose_differences(state);
    if (coarser > 0) {
        const float thinnest = std::min({spacing.x, spacing.y, spacing.z});
        // Axes with thick slices keep their resolution until the others are as coarse.
        const glm::ivec3 steps = 1 + glm::ivec3(glm::lessThan(spacing, glm::vec3(1.5F * thinnest)));
        RAMUS_TRY(coarse, solve(every_second(mask, steps), spacing * glm::vec3(steps), coarser - 1, memory_bytes,
                                job.part(0.0F, 0.4F), &state, steps));
        state.band.for_each([&](std::uint32_t n, const glm::ivec3& voxel) {
            if (state.voxels.thin[n] != 0) return; // the coarser mask may miss thin parts
            if (const auto value = interpolated(coarse, voxel, steps))
                state.values[n] = std::clamp(*value, state.least[n], state.most[n]);
        });
    }
    relax(state, job.part(0.4F, 1.0F));
    if (job.cancelled()) return fail("cancelled");
    return state;
}

} // namespace

Result<SmoothLevel> smooth_level(const BitMask& mask, const glm::dvec3& spacing_mm, double memory_bytes,
                                 const JobRange& job) {
    RAMUS_TRY(state, solve(mask, glm::vec3(spacing_mm), kCoarser, memory_bytes, job));
    return SmoothLevel(std::move(state.band), std::move(state.values));
}

} // namespace ramus::volume
