// Plots radii along a branch in mm: of the tree, of the surface, of cones, of a mask's isosurface.
#pragma once

#include "app/reports/plots/svg.h"

#include <string>
#include <vector>

namespace ramus::app {

// Curves of one branch from its first point; each as long as `along_mm`, or empty if not available.
struct RadiusCurves {
    std::vector<double> along_mm;
    std::vector<double> input_mm, surface_mm, cones_mm, mask_mm;
    std::vector<bool> alone; // away from joints, ends and other vessels; elsewhere the background is grey
};

// The axis of radii begins at 0 and covers the tree's radii and the places that are `alone`; curves that go higher at
// joints leave the plot.
[[nodiscard]] Svg radius_plot(const std::string& title, const RadiusCurves& curves, const std::string& unit = "mm");

} // namespace ramus::app
