// Figure 4 of the paper: the bounding volumes of segments.
#pragma once

#include "app/paper/figure.h"
#include "app/paper/workbench.h"

namespace ramus::app::paper {

[[nodiscard]] Result<Figure> bounding_volumes(Workbench& bench, Job& job); // 4

} // namespace ramus::app::paper
