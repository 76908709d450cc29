// The report of validation as one web page that needs nothing beside it: tables, plots, pictures, settings, files. No
// GL: the data sets bring their pictures.
#pragma once

#include "app/reports/validation/data_set.h"

#include <span>
#include <string>
#include <vector>

namespace ramus::app {

// `settings`: what everything was made with; `made`: when. The data sets have their radii in cones and mask.
[[nodiscard]] std::string validation_page(std::span<const ValidatedDataSet> sets, const Facts& settings,
                                          const std::string& made);

// Box plots of all data sets, as files of their own: name and content. Those to the mask where there are masks.
struct NamedText {
    std::string name, text;
};
[[nodiscard]] std::vector<NamedText> box_plot_files(std::span<const ValidatedDataSet> sets);

} // namespace ramus::app
