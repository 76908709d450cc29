// Writes the validation report as a self-contained web page: tables, plots, pictures, settings, files. No GL: the data
// sets contain their pictures.
#pragma once

#include "app/reports/plots/svg.h"
#include "app/reports/validation/data_set.h"
#include "app/reports/validation/validation_tables.h"

#include <span>
#include <string>

namespace ramus::app {

// `settings`: options of the computation; `made`: time. The data sets must have their radii in cones and mask.
[[nodiscard]] std::string validation_page(std::span<const ValidatedDataSet> sets, const Facts& settings,
                                          const std::string& made);

// Box plots of all data sets; to and from the mask only for those with masks.
[[nodiscard]] Svg boxes_of(std::span<const ValidatedDataSet> sets, Held how);
[[nodiscard]] bool has_mask(std::span<const ValidatedDataSet> sets); // whether any has one

} // namespace ramus::app
