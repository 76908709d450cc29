// ThresholdCurve: the number of inside voxels and connected pieces of a scan for every threshold, and Otsu's threshold.
// Computed once, it lets a person choose a threshold without reading the scan again. A threshold is no segmentation:
// everything that is as bright is inside.
#pragma once

#include "core/base/error.h"
#include "core/base/job.h"
#include "core/volume/volume.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace ramus::volume {

struct ThresholdCurve {
    // Ascending from the least value. At thresholds[i], voxels with at least this value are inside.
    std::vector<double> thresholds;
    std::vector<std::uint64_t> voxels; // number inside, exact
    // Number of pieces, connected by faces, edges and corners. Counted on every step-th voxel along each axis, so it is
    // exact only if `step` is 1.
    std::vector<std::uint64_t> pieces;
    int step = 1;
    std::size_t otsu = 0; // index of Otsu's threshold (N. Otsu, IEEE Trans. SMC 9, 1979)

    // The index of the greatest threshold that is not above `value`; 0 if all are above.
    [[nodiscard]] std::size_t at(double value) const;
    bool operator==(const ThresholdCurve&) const = default;
};

// Computes the curve for at most 4,096 equidistant thresholds; for volumes of whole numbers, whole thresholds. Takes
// about 60 MB in addition to the volume. Fails if all values are equal, and when `job` is cancelled (what ==
// "cancelled").
[[nodiscard]] Result<ThresholdCurve> threshold_curve(const Volume& volume, const JobRange& job);

} // namespace ramus::volume
