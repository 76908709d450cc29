// ThresholdCurve: what a threshold makes of a scan, for every threshold at once: how many voxels are inside, in how
// many pieces they lie, and where Otsu's method puts it. Who chooses a threshold sees all of that without another look
// at the scan. What comes of a threshold is no segmentation: whatever is as bright is inside.
#pragma once

#include "core/base/error.h"
#include "core/base/job.h"
#include "core/volume/volume.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace ramus::volume {

struct ThresholdCurve {
    // Ascending, the least value first: at thresholds[i] those voxels are inside whose value is at least that.
    std::vector<double> thresholds;
    std::vector<std::uint64_t> voxels; // inside, exactly
    // Groups of them that share faces, edges or corners; of every step-th voxel along each axis alone, so exactly where
    // step is 1, and about where it is more.
    std::vector<std::uint64_t> pieces;
    int step = 1;
    std::size_t otsu = 0; // N. Otsu, IEEE Trans. SMC 9, 1979: the one that parts the values best into two classes

    // The greatest threshold that is not above `value`.
    [[nodiscard]] std::size_t at(double value) const;
    bool operator==(const ThresholdCurve&) const = default;
};

// At most 4,096 thresholds, at equal distances; of whole numbers, whole numbers. Takes about 60 MB beside the volume.
// Fails when all values are equal, and when `job` is cancelled (what == "cancelled").
[[nodiscard]] Result<ThresholdCurve> threshold_curve(const Volume& volume, const JobRange& job);

} // namespace ramus::volume
