// Radii along branches: curves of some, and all of them as CSV.
#pragma once

#include "app/reports/plots/radius_plot.h"
#include "app/reports/validation/data_set.h"
#include "core/io/buffered_file.h"
#include "core/validate/worst_radii.h"

#include <span>

namespace ramus::app {

[[nodiscard]] RadiusCurves curves_of(const ValidatedDataSet& set, const validate::BranchError& branch);

// CSV: a line for each place of all branches. `numbered`: the number of the data set, from 1, stands first.
void write_radii(io::BufferedFile& file, std::span<const ValidatedDataSet> sets, bool numbered);

} // namespace ramus::app
