#include "app/reports/plots/axis.h"

#include "app/session/numbers.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace ramus::app {

double Axis::share(double value) const {
    return logarithmic ? std::log(value / low) / std::log(high / low) : (value - low) / (high - low);
}

Axis linear_axis(double low, double high) {
    if (!(high > low)) high = low + std::max(std::abs(low), 1e-3);
    return {low, high, false, round_numbers(low, high)};
}

Axis logarithmic_axis(double low, double high) {
    constexpr int kMostTicks = 7;
    const int first = static_cast<int>(std::floor(std::log10(low) + 1e-9));
    const int last = std::max(static_cast<int>(std::ceil(std::log10(high) - 1e-9)), first + 1);
    const int step = (last - first + kMostTicks - 1) / kMostTicks;
    Axis axis{std::pow(10.0, first), std::pow(10.0, last), true, {}};
    for (int power = last; power >= first; power -= step) axis.ticks.insert(axis.ticks.begin(), std::pow(10.0, power));
    return axis;
}

std::string tick_text(double value) {
    char text[64];
    for (int decimals = 0;; ++decimals) {
        std::snprintf(text, sizeof text, "%.*f", decimals, value);
        if (decimals == 12 || std::abs(std::strtod(text, nullptr) - value) <= 1e-6 * std::abs(value)) return text;
    }
}

void draw_x_axis(Svg& svg, const PlotArea& area, const std::string& label) {
    double free_from = 0.0;
    for (const double tick : area.x.ticks) {
        const double x = area.at_x(tick);
        svg.line({x, area.top}, {x, area.bottom}, kGridStroke);
        svg.line({x, area.bottom}, {x, area.bottom + 4.0}, kAxisStroke);
        const std::string words = tick_text(tick);
        const double half = 0.5 * width_of(words, 10.0);
        if (x - half < free_from || x + half > svg.width()) continue;
        svg.text({x, area.bottom + 15.0}, words, Anchor::kMiddle, 10.0, kQuietInk);
        free_from = x + half + 4.0;
    }
    svg.line({area.left, area.bottom}, {area.right, area.bottom}, kAxisStroke);
    svg.text({0.5 * (area.left + area.right), area.bottom + 29.0}, label, Anchor::kMiddle, 11.0, kQuietInk);
}

void draw_y_axis(Svg& svg, const PlotArea& area, const std::string& label) {
    for (const double tick : area.y.ticks) {
        const double y = area.at_y(tick);
        svg.line({area.left, y}, {area.right, y}, kGridStroke);
        svg.line({area.left - 4.0, y}, {area.left, y}, kAxisStroke);
        svg.text({area.left - 6.0, y + 3.5}, tick_text(tick), Anchor::kEnd, 10.0, kQuietInk);
    }
    svg.line({area.left, area.top}, {area.left, area.bottom}, kAxisStroke);
    svg.text_upward({area.left - 46.0, 0.5 * (area.top + area.bottom)}, label);
}

double draw_legend(Svg& svg, PlotPoint at, double most, const std::vector<LegendLine>& lines) {
    constexpr double kSample = 22.0, kGap = 6.0, kBetween = 14.0, kRow = 15.0, kSize = 10.5;
    const double left = at.x;
    double height = kRow;
    for (const LegendLine& line : lines) {
        const double width = kSample + kGap + width_of(line.words, kSize);
        if (at.x > left && at.x + width > most) {
            at = {left, at.y + kRow};
            height += kRow;
        }
        svg.line({at.x, at.y - 3.5}, {at.x + kSample, at.y - 3.5}, line.stroke);
        svg.text({at.x + kSample + kGap, at.y}, line.words, Anchor::kStart, kSize);
        at.x += width + kBetween;
    }
    return height;
}

} // namespace ramus::app
