// Rows of the table of `ramus info --csv`: what is known of a file, or why nothing is.
#pragma once

#include "app/reports/report_tables.h"
#include "core/base/error.h"
#include "core/measure/tree_measure.h"
#include "core/tree/vessel_tree.h"

#include <string>

namespace ramus::app {

// Tables of one row each, with the same columns: of a mask or scan, of a tree, of a file that cannot be read. Lengths
// and volumes are in `unit` and its cube.
[[nodiscard]] Table info_row(const std::string& file);
[[nodiscard]] Table info_row(const std::string& file, const tree::VesselTree& tree,
                             const measure::TreeStatistics& statistics);
[[nodiscard]] Table info_row(const std::string& file, const Error& error);

} // namespace ramus::app
