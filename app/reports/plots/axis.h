// Axes of plots: round ticks with the fewest digits, a label with the unit, a grid.
#pragma once

#include "app/reports/plots/svg.h"

#include <string>
#include <vector>

namespace ramus::app {

struct Axis {
    double low = 0.0, high = 1.0;
    bool logarithmic = false;  // requires positive bounds
    std::vector<double> ticks; // ascending, from low to high

    [[nodiscard]] double share(double value) const; // 0 at low, 1 at high; not clamped
};

// From `low` to `high`; slightly extended if they are equal.
[[nodiscard]] Axis linear_axis(double low, double high);
// From the power of ten below `low` to the one above `high`, both positive; ticks at all of them, or every second,
// third, ...
[[nodiscard]] Axis logarithmic_axis(double low, double high);

// "0.25": the fewest digits for the number.
[[nodiscard]] std::string tick_text(double value);

// The part of a drawing with the data.
struct PlotArea {
    double left = 0.0, top = 0.0, right = 0.0, bottom = 0.0;
    Axis x{}, y{};

    [[nodiscard]] double at_x(double value) const { return left + x.share(value) * (right - left); }
    [[nodiscard]] double at_y(double value) const { return bottom - y.share(value) * (bottom - top); }
};

// Draws ticks with a grid and the label below; needs 32 units below `area.bottom`.
void draw_x_axis(Svg& svg, const PlotArea& area, const std::string& label);
// Draws ticks with a grid and the label turned upward at the left; needs 56 units left of `area.left`.
void draw_y_axis(Svg& svg, const PlotArea& area, const std::string& label);

// A legend of line styles in rows from `at`, the first baseline; returns its height.
struct LegendLine {
    std::string words;
    Stroke stroke;
};
double draw_legend(Svg& svg, PlotPoint at, double most, const std::vector<LegendLine>& lines);

} // namespace ramus::app
