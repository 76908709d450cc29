// Figures 11 to 13 and Table II of the paper: the study's pictures and criteria, and pictures as for planning.
#pragma once

#include "app/paper/figure.h"
#include "app/paper/workbench.h"

namespace ramus::app::paper {

[[nodiscard]] Result<Figure> study_pictures(Workbench& bench, Job& job);    // 11
[[nodiscard]] Result<Figure> lesion_in_liver(Workbench& bench, Job& job);   // 12
[[nodiscard]] Result<Figure> branches_in_focus(Workbench& bench, Job& job); // 13
[[nodiscard]] Result<Figure> table_of_criteria(Workbench& bench, Job& job); // Table II

} // namespace ramus::app::paper
