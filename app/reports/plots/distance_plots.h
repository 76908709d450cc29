// Plots of distances between surfaces: box plots of one or many data sets, and the histogram of one. mm.
#pragma once

#include "app/reports/plots/svg.h"
#include "core/measure/deviation/deviation.h"

#include <optional>
#include <string>
#include <vector>

namespace ramus::app {

struct BoxRow {
    std::string name;
    const measure::DeviationStatistics* statistics = nullptr;
    std::optional<double> mark_mm; // half a voxel's diagonal, say
};

// A row for each, with median, quartiles, whiskers, the mean, and words for what lies beyond the axis, which reaches to
// where the boxes, means and 95th percentiles do. `mark`: what the marks are.
// `unit`: of all lengths, "mm".
[[nodiscard]] Svg box_plots(const std::string& title, const std::vector<BoxRow>& rows, const Stroke& stroke,
                            const std::string& mark, const std::string& unit = "mm");

// Shares of all distances, in percent on a logarithmic axis: the few far ones are what one looks for.
[[nodiscard]] Svg histogram_plot(const std::string& title, const measure::DeviationStatistics& statistics,
                                 const Stroke& stroke, const std::optional<double>& mark_mm, const std::string& mark,
                                 const std::string& unit = "mm");

} // namespace ramus::app
