// The table of `ramus info --csv`: one row for each file, with its properties or the error of reading it.
#pragma once

#include "app/reports/report_tables.h"
#include "core/base/error.h"
#include "core/measure/tree_measure.h"
#include "core/tree/vessel_tree.h"

#include <string>

namespace ramus::app {

// Tables of one row each, all with the same columns. The first overload is for a mask or scan, the second for a tree,
// the third for a file that cannot be read. Lengths are in the unit of the column `unit`, volumes in its cube.
[[nodiscard]] Table info_row(const std::string& file);
[[nodiscard]] Table info_row(const std::string& file, const tree::VesselTree& tree,
                             const measure::TreeStatistics& statistics);
[[nodiscard]] Table info_row(const std::string& file, const Error& error);

} // namespace ramus::app
