// Plots the diameters of cross-sections along the vessel that slices follow.
#pragma once

#include "app/panels/interface.h"

#include <optional>

namespace ramus::app {

// A pointer over the plot shows the slice there; the slice returns when the pointer leaves, unless there was a click.
struct AlongPlot {
    std::optional<double> before_mm; // the place before the pointer came
    std::optional<Way> shown;        // the way that the panel has brought into view
    std::optional<Way> measured;     // the same, with its figures
    int scrolls = 0;                 // frames in which it still does so, since they make the page longer
};

// Requires sections that fit the path.
void draw_along_plot(InterfaceContext& context, const VesselSections& sections);

} // namespace ramus::app
