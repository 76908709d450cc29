// Plots of distances between surfaces, in mm: box plots of several data sets, and the histogram of one.
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
    std::optional<double> mark_mm; // for example half a voxel's diagonal
};

// One row per data set with median, quartiles, whiskers and mean, and text for values beyond the axis, which covers
// boxes, means and 95th percentiles. `mark`: meaning of the marks. `unit`: of all lengths, "mm".
[[nodiscard]] Svg box_plots(const std::string& title, const std::vector<BoxRow>& rows, const Stroke& stroke,
                            const std::string& mark, const std::string& unit = "mm");

// Percentages of all distances on a logarithmic axis, which makes the few large ones visible.
[[nodiscard]] Svg histogram_plot(const std::string& title, const measure::DeviationStatistics& statistics,
                                 const Stroke& stroke, const std::optional<double>& mark_mm, const std::string& mark,
                                 const std::string& unit = "mm");

} // namespace ramus::app
