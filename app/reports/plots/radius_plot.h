// Plot of radii along a branch: as they were read, of the surface, of cones, of a mask's isosurface. mm.
#pragma once

#include "app/reports/plots/svg.h"

#include <string>
#include <vector>

namespace ramus::app {

// Of one branch, from its first point on; all as long as `along_mm`, or empty: there is no such curve.
struct RadiusCurves {
    std::vector<double> along_mm;
    std::vector<double> input_mm, surface_mm, cones_mm, mask_mm;
    std::vector<bool> alone; // away from joints, ends and other vessels; elsewhere the background is grey
};

// The axis of radii begins at 0 and ends above what was read and what is alone; a curve that goes higher where a vessel
// joins another leaves the plot.
[[nodiscard]] Svg radius_plot(const std::string& title, const RadiusCurves& curves, const std::string& unit = "mm");

} // namespace ramus::app
