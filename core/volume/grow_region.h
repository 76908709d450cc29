// Region growing: from seed voxels, all voxels that are connected by faces and whose values lie in a range. Barriers
// stop the growth where a person sees that two structures touch.
// Guarantees: exactly the connected voxels, whatever the order of the seeds. Values are read in place, without a copy
// of the volume. Work and result take memory for the region, not for the volume. Not guaranteed: that the region is the
// structure that was meant. A range of values is no segmentation: a region leaks wherever neighbouring tissue has
// similar values, and ends where noise or an artefact exceeds the range. The result must be looked at.
//
//     RAMUS_TRY(range, suggested_range(scan, seed));
//     RAMUS_TRY(grown, grow_region(scan, {.seeds = {seed}, .low = range.low, .high = range.high}, job));
#pragma once

#include "core/base/error.h"
#include "core/base/job.h"
#include "core/volume/sparse_mask.h"
#include "core/volume/volume.h"

#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>
#include <optional>
#include <vector>

namespace ramus::volume {

// Voxels whose centres lie in the ball do not belong to the region.
struct BallBarrier {
    glm::dvec3 centre_mm{0.0}; // RAS
    double radius_mm = 0.0;
};
// Growth does not step from a voxel to its neighbour if the line between their centres crosses the disc. For a
// structure that is thinner than the disc, it is a complete cut.
struct DiscBarrier {
    glm::dvec3 centre_mm{0.0};        // RAS
    glm::dvec3 normal{0.0, 0.0, 1.0}; // of any length but 0
    double radius_mm = 0.0;
};
struct VoxelBox {
    glm::ivec3 first{0}, last{0}; // both inside the box
};

struct RegionGrowing {
    std::vector<glm::ivec3> seeds; // voxels
    double low = 0.0, high = 0.0;  // of values; both belong to the range
    std::vector<BallBarrier> balls = {};
    std::vector<DiscBarrier> discs = {};
    std::optional<VoxelBox> box = {}; // none: the whole volume
    std::uint64_t most_voxels = std::numeric_limits<std::uint64_t>::max();
};

struct GrownRegion {
    SparseMask mask;
    std::uint64_t count = 0;        // voxels
    VoxelBox bounds;                // of the region
    bool touches_border = false;    // of the volume: the structure probably continues beyond it
    bool stopped_at_limit = false;  // most_voxels were found, and at least one more would follow
    std::vector<glm::ivec3> unused; // seeds whose values are out of range, or that a ball or the box excludes
};

// Fails if there is no seed, a seed is not in the volume, the range is empty, no seed can be used, labels of the volume
// overlap (then a voxel has no single value), and when `job` is cancelled (what == "cancelled"). The progress is a
// lower bound, because nobody knows the size of the region before.
[[nodiscard]] Result<GrownRegion> grow_region(const Volume& volume, const RegionGrowing& growing, const JobRange& job);

struct ValueRange {
    double low = 0.0, high = 0.0;    // mean -+ 2.5 standard deviations, extended to the value of the seed
    double mean = 0.0, spread = 0.0; // standard deviation
};

// A range of values for growing from a seed: mean and standard deviation of the neighbourhood, as in the first step of
// ITK's ConfidenceConnectedImageFilter (L. Ibanez et al., The ITK Software Guide, 2005, "Confidence Connected"), with
// its default multiplier. The neighbourhood has the same extent in mm along all axes, 5 voxels along the finest. Unlike
// there, values farther than 3 robust standard deviations (of the median absolute deviation) from the median are left
// out, so that a seed next to a wall still gets the range of its own side. Fails if the seed is not in the volume, or
// labels overlap.
[[nodiscard]] Result<ValueRange> suggested_range(const Volume& volume, const glm::ivec3& seed);

} // namespace ramus::volume
