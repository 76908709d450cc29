// What ramus validate found, as JSON and in words.
#pragma once

#include "app/reports/validation/data_set.h"

#include <nlohmann/json_fwd.hpp>
#include <span>

namespace ramus::app {

// Of one data set: its own object. Of several {"data_sets": [one such object each], "averages": {...}}; there the
// distances to cones, too, say how many are above half a voxel.
[[nodiscard]] nlohmann::ordered_json validation_json(std::span<const ValidatedDataSet> sets);

// On standard output: all that was found in one data set; of several what was found in each, and tables with averages.
void print_validation(std::span<const ValidatedDataSet> sets);

} // namespace ramus::app
