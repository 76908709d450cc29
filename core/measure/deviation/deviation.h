// How far one surface lies from another: for each vertex of the one the distance to the nearest point of the other, and
// what is said of all of them together (S. Oeltze and B. Preim, "Visualization of Vasculature with Convolution
// Surfaces", IEEE Transactions on Medical Imaging 24, 2005, section VII-B). Also area and volume of a surface. mm, mm2,
// mm3.
#pragma once

#include "core/base/large_array.h"
#include "core/mesh/triangle_mesh.h"

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace ramus::measure {

// As a box plot draws it. Quantiles are interpolated linearly between the values in order, the least being the quantile
// of 0 and the most that of 1.
struct BoxPlot {
    double lower_quartile = 0.0, median = 0.0, upper_quartile = 0.0;
    // The least and the largest value within 1.5 interquartile ranges of the quartiles, and the share beyond them.
    double lower_whisker = 0.0, upper_whisker = 0.0;
    double beyond = 0.0;
};

// Counts in bins of equal width from 0 on; the last one has the largest value in it.
struct Histogram {
    double width = 0.0;
    std::vector<std::uint64_t> counts;
};

struct DeviationStatistics {
    std::size_t count = 0;
    double mean = 0.0, rms = 0.0, min = 0.0, max = 0.0;
    double sigma = 0.0; // of all values, not estimated from a sample of them
    double percentile_95 = 0.0;
    BoxPlot box;
    Histogram histogram;
    std::optional<double> above; // share of values above the threshold, where there is one
};

// For each vertex of `surface` the distance to the nearest point of `other`, which has a triangle at least. `threads`:
// 0: all cores.
[[nodiscard]] LargeArray<double> deviations(const mesh::TriangleMesh& surface, const mesh::TriangleMesh& other,
                                            int threads = 0);

// There is a value at least, and all are finite. Reorders `values`.
[[nodiscard]] DeviationStatistics statistics_of(std::span<double> values, std::optional<double> threshold);

// The quantile of `share`, from 0 to 1, of values in any order, which are reordered.
[[nodiscard]] double quantile(std::span<double> values, double share);

// The `count` vertices that are farthest, the farthest first, each at least a hundredth of the surface's size away from
// those before it: places, not vertices side by side. `distances`: as deviations() gives them.
[[nodiscard]] std::vector<std::size_t> farthest_vertices(const mesh::TriangleMesh& surface,
                                                         std::span<const double> distances, std::size_t count);

struct SurfaceSize {
    double area_mm2 = 0.0;
    std::optional<double> volume_mm3; // inside; none of a surface that is not closed
};
[[nodiscard]] SurfaceSize size_of(const mesh::TriangleMesh& mesh);

} // namespace ramus::measure
