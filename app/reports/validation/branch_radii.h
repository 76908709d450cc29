// Radii along branches: which branches are farthest from what was read, and their curves; all of them as CSV.
#pragma once

#include "app/reports/plots/radius_plot.h"
#include "app/reports/validation/data_set.h"
#include "core/io/buffered_file.h"

#include <cstddef>
#include <span>
#include <vector>

namespace ramus::app {

// A branch by the place of it, away from joints, ends and other vessels, where the surface's radius is most off.
struct BranchError {
    int branch = 0;
    std::size_t first = 0, count = 0; // its places in Validation::radii
    std::size_t worst = 0;            // the place
    double error = 0.0;               // |surface - read| / read, there
};

// The `most` worst, the worst first. Branches without such a place are none of them.
[[nodiscard]] std::vector<BranchError> worst_branches(const validate::Validation& found, std::size_t most);

[[nodiscard]] RadiusCurves curves_of(const ValidatedDataSet& set, const BranchError& branch);

// CSV: a line for each place of all branches. `numbered`: the number of the data set, from 1, stands first.
void write_radii(io::BufferedFile& file, std::span<const ValidatedDataSet> sets, bool numbered);

} // namespace ramus::app
