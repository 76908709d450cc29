// The report of validation as one web page that needs nothing beside it: tables, plots, pictures, settings, files. No
// GL: the data sets bring their pictures.
#pragma once

#include "app/reports/plots/svg.h"
#include "app/reports/validation/data_set.h"
#include "app/reports/validation/validation_tables.h"

#include <span>
#include <string>

namespace ramus::app {

// `settings`: what everything was made with; `made`: when. The data sets have their radii in cones and mask.
[[nodiscard]] std::string validation_page(std::span<const ValidatedDataSet> sets, const Facts& settings,
                                          const std::string& made);

// Box plots of all data sets; those to and from the mask where there are masks.
[[nodiscard]] Svg boxes_of(std::span<const ValidatedDataSet> sets, Held how);
[[nodiscard]] bool has_mask(std::span<const ValidatedDataSet> sets); // one of them

} // namespace ramus::app
