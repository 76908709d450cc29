// Radii along branches, as curves for plots and as CSV.
#pragma once

#include "app/reports/plots/radius_plot.h"
#include "app/reports/validation/data_set.h"
#include "core/io/buffered_file.h"
#include "core/validate/worst_radii.h"

#include <span>

namespace ramus::app {

[[nodiscard]] RadiusCurves curves_of(const ValidatedDataSet& set, const validate::BranchError& branch);

// Writes CSV with one line per place of all branches. `numbered`: the first column is the number of the data set, from
// 1.
void write_radii(io::BufferedFile& file, std::span<const ValidatedDataSet> sets, bool numbered);

} // namespace ramus::app
