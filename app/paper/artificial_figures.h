// Figures 1 to 3 of the paper: artificial trees under width coefficients 1 and 5.
#pragma once

#include "app/paper/figure.h"
#include "app/paper/workbench.h"

namespace ramus::app::paper {

[[nodiscard]] Result<Figure> bulging(Workbench& bench, Job& job);           // 1
[[nodiscard]] Result<Figure> unwanted_blending(Workbench& bench, Job& job); // 2
[[nodiscard]] Result<Figure> merging(Workbench& bench, Job& job);           // 3

// mm above the joint at the origin at which the surface ends, along y.
[[nodiscard]] double height_over_joint(const mesh::TriangleMesh& mesh);
// The radius from which on two straight vessels, `distance_mm` apart, have one surface: found by making surfaces.
[[nodiscard]] Result<double> found_merging_radius(double distance_mm, double width, Job& job);

} // namespace ramus::app::paper
