// Plots the cut surface of a resection laid flat.
#pragma once

#include "app/picture/flat_map.h"
#include "app/reports/plots/svg.h"
#include "core/tree/vessel_tree.h"

#include <string>

namespace ramus::app {

// With the patient's sides and a scale bar if `claims` has them, and a legend.
[[nodiscard]] Svg flat_map_plot(const std::string& title, const FlatMap& map, const tree::Claims& claims);

} // namespace ramus::app
