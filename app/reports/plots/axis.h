// Axes of plots: round ticks with as few digits as they need, a unit, a grid.
#pragma once

#include "app/reports/plots/svg.h"

#include <string>
#include <vector>

namespace ramus::app {

struct Axis {
    double low = 0.0, high = 1.0;
    bool logarithmic = false;  // then both are above 0
    std::vector<double> ticks; // ascending, from low to high

    [[nodiscard]] double share(double value) const; // 0 at low, 1 at high; not held in between
};

// From `low` to `high`, or a little more where those are the same.
[[nodiscard]] Axis linear_axis(double low, double high);
// From the power of ten below `low` to the one above `high`, both above 0; a tick at each, or at every second, ...
[[nodiscard]] Axis logarithmic_axis(double low, double high);

// "0.25": as few digits as say the number.
[[nodiscard]] std::string tick_text(double value);

// The part of a drawing that has the data.
struct PlotArea {
    double left = 0.0, top = 0.0, right = 0.0, bottom = 0.0;
    Axis x{}, y{};

    [[nodiscard]] double at_x(double value) const { return left + x.share(value) * (right - left); }
    [[nodiscard]] double at_y(double value) const { return bottom - y.share(value) * (bottom - top); }
};

// Ticks with a grid, and the label below; 32 units below `area.bottom`.
void draw_x_axis(Svg& svg, const PlotArea& area, const std::string& label);
// Ticks with a grid, and the label beside, upward; 56 units left of `area.left`.
void draw_y_axis(Svg& svg, const PlotArea& area, const std::string& label);

// Lines with what they mean, in rows from `at` on, which is the first baseline; returns how high they are.
struct LegendLine {
    std::string words;
    Stroke stroke;
};
double draw_legend(Svg& svg, PlotPoint at, double most, const std::vector<LegendLine>& lines);

} // namespace ramus::app
