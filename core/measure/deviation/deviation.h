// Deviation of one surface from another: for each vertex the distance to the nearest point of the other surface, and
// statistics of these distances (S. Oeltze and B. Preim, "Visualization of Vasculature with Convolution Surfaces", IEEE
// Transactions on Medical Imaging 24, 2005, section VII-B). Also area and volume of a surface. Units: mm, mm2, mm3.
#pragma once

#include "core/base/large_array.h"
#include "core/mesh/triangle_mesh.h"

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace ramus::measure {

// The numbers of a box plot. Quantiles are interpolated linearly between the sorted values: the quantile 0 is the least
// value, the quantile 1 the largest.
struct BoxPlot {
    double lower_quartile = 0.0, median = 0.0, upper_quartile = 0.0;
    // The least and the largest value within 1.5 interquartile ranges of the quartiles, and the share of values beyond.
    double lower_whisker = 0.0, upper_whisker = 0.0;
    double beyond = 0.0;
};

// Counts in bins of equal width, from 0 to the bin of the largest value.
struct Histogram {
    double width = 0.0;
    std::vector<std::uint64_t> counts;
};

struct DeviationStatistics {
    std::size_t count = 0;
    double mean = 0.0, rms = 0.0, min = 0.0, max = 0.0;
    double sigma = 0.0; // population standard deviation
    double percentile_95 = 0.0;
    BoxPlot box;
    Histogram histogram;
    std::optional<double> above; // share of values above the threshold, if there is one
};

// For each vertex of `surface`, the distance to the nearest point of `other`, which must have at least one triangle.
// `threads`: 0 means all cores. Not symmetric.
[[nodiscard]] LargeArray<double> deviations(const mesh::TriangleMesh& surface, const mesh::TriangleMesh& other,
                                            int threads = 0);

// There must be at least one value, and all must be finite. Reorders `values`.
[[nodiscard]] DeviationStatistics statistics_of(std::span<double> values, std::optional<double> threshold);

// The quantile at `share`, 0 to 1. Reorders `values`.
[[nodiscard]] double quantile(std::span<double> values, double share);

// The `count` vertices with the largest distances, in descending order, each at least a hundredth of the surface's size
// away from all previous ones, so that neighbours are not listed. `distances`: the result of deviations().
[[nodiscard]] std::vector<std::size_t> farthest_vertices(const mesh::TriangleMesh& surface,
                                                         std::span<const double> distances, std::size_t count);

struct SurfaceSize {
    double area_mm2 = 0.0;
    std::optional<double> volume_mm3; // nothing if the surface is not closed
};
[[nodiscard]] SurfaceSize size_of(const mesh::TriangleMesh& mesh);

} // namespace ramus::measure
