// Figures 8 to 10 and Tables I and III of the paper: distances between the surfaces of the three methods, and times.
#pragma once

#include "app/paper/figure.h"
#include "app/paper/workbench.h"

namespace ramus::app::paper {

[[nodiscard]] Result<Figure> deviation_from_cones(Workbench& bench, Job& job);      // 8
[[nodiscard]] Result<Figure> deviation_from_isosurface(Workbench& bench, Job& job); // 9
[[nodiscard]] Result<Figure> box_plots_of_trees(Workbench& bench, Job& job);        // 10
[[nodiscard]] Result<Figure> table_of_distances(Workbench& bench, Job& job);        // Table I
[[nodiscard]] Result<Figure> table_of_times(Workbench& bench, Job& job);            // Table III

} // namespace ramus::app::paper
