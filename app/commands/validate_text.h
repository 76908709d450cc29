// The results of `ramus validate` as JSON and as text.
#pragma once

#include "app/reports/validation/data_set.h"

#include <nlohmann/json_fwd.hpp>
#include <span>

namespace ramus::app {

// For one data set, the object of its results. For several, {"data_sets": [one such object each], "averages": {...}};
// then distances to cones also have the share above half a voxel.
[[nodiscard]] nlohmann::ordered_json validation_json(std::span<const ValidatedDataSet> sets);

// Prints the results on standard output. For one data set, all of them; for several, the findings of each and tables
// with averages.
void print_validation(std::span<const ValidatedDataSet> sets);

} // namespace ramus::app
