#include "app/reports/plots/distance_plots.h"

#include "app/reports/plots/axis.h"
#include "app/session/numbers.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace ramus::app {

namespace {

constexpr double kPlotWidth = 440.0;
constexpr Stroke kMarkStroke{"#5b6570", 1.4, "4 2"};
constexpr std::string_view kBoxFill = "#f2f5f8";

void draw_box(Svg& svg, const PlotArea& area, const BoxRow& row, double middle, const Stroke& stroke) {
    constexpr double kHalf = 7.0;
    const measure::BoxPlot& box = row.statistics->box;
    const Stroke full{stroke.colour, 1.5, ""};
    svg.line({area.at_x(box.lower_whisker), middle}, {area.at_x(box.lower_quartile), middle}, full);
    svg.line({area.at_x(box.upper_quartile), middle}, {area.at_x(box.upper_whisker), middle}, full);
    for (const double whisker : {box.lower_whisker, box.upper_whisker})
        svg.line({area.at_x(whisker), middle - 0.6 * kHalf}, {area.at_x(whisker), middle + 0.6 * kHalf}, full);
    const double left = area.at_x(box.lower_quartile), right = area.at_x(box.upper_quartile);
    svg.rectangle({left, middle - kHalf}, {std::max(right - left, 0.5), 2.0 * kHalf}, kBoxFill, &full);
    const double median = area.at_x(box.median);
    svg.line({median, middle - kHalf}, {median, middle + kHalf}, {kInk, 2.0, ""});
    svg.diamond({area.at_x(row.statistics->mean), middle}, 3.6, kInk);
    if (row.mark_mm && *row.mark_mm <= area.x.high) {
        const double x = area.at_x(*row.mark_mm);
        svg.line({x, middle - 1.5 * kHalf}, {x, middle + 1.5 * kHalf}, kMarkStroke);
    }
}

std::string beyond_text(const measure::DeviationStatistics& statistics, const std::string& unit) {
    return digits(100.0 * statistics.box.beyond) + " % beyond the whiskers, to " + digits(statistics.max) + " " + unit;
}

} // namespace

Svg box_plots(const std::string& title, const std::vector<BoxRow>& rows, const Stroke& stroke, const std::string& mark,
              const std::string& unit) {
    constexpr double kTop = 30.0, kRow = 44.0, kBelow = 70.0, kSide = 14.0;
    const double bottom = kTop + kRow * static_cast<double>(rows.size()) + 4.0;
    double reach = 0.0;
    bool marked = false;
    for (const BoxRow& row : rows)
        reach =
            std::max({reach, row.statistics->box.upper_whisker, row.statistics->mean, row.statistics->percentile_95});
    for (const BoxRow& row : rows) {
        // Extends the axis for a mark, but not so far that boxes become lines.
        if (row.mark_mm && *row.mark_mm < 2.5 * reach) reach = std::max(reach, *row.mark_mm);
    }
    for (const BoxRow& row : rows) marked = marked || (row.mark_mm && *row.mark_mm <= 1.03 * reach);
    Svg svg(kPlotWidth, bottom + kBelow, title);
    svg.text({kSide, 16.0}, title, Anchor::kStart, 12.0);
    const PlotArea area{kSide, kTop - 6.0, kPlotWidth - kSide, bottom, linear_axis(0.0, 1.03 * reach), {}};
    draw_x_axis(svg, area, "Distance, " + unit);
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const double top = kTop + kRow * static_cast<double>(i);
        const std::string beyond = beyond_text(*rows[i].statistics, unit);
        const double room = width_of(beyond, 9.5);
        svg.rectangle({kPlotWidth - kSide - room, top}, {room, 13.0}, "#ffffff"); // no grid behind words
        svg.text({kPlotWidth - kSide, top + 10.0}, beyond, Anchor::kEnd, 9.5, kQuietInk);
        const std::string name = shortened(rows[i].name, kPlotWidth - 2.0 * kSide - room - 12.0);
        svg.rectangle({kSide, top}, {width_of(name), 13.0}, "#ffffff");
        svg.text({kSide, top + 10.0}, name, Anchor::kStart, 11.0, kInk,
                 name == rows[i].name ? std::string_view() : std::string_view(rows[i].name));
        draw_box(svg, area, rows[i], top + 26.0, stroke);
    }
    const double legend = bottom + 50.0;
    svg.text({kSide, legend}, "box: quartiles, bar: median, whiskers: within 1.5 quartile distances, diamond: mean",
             Anchor::kStart, 9.5, kQuietInk);
    if (marked) draw_legend(svg, {kSide, legend + 14.0}, kPlotWidth - kSide, {{mark, kMarkStroke}});
    return svg;
}

Svg histogram_plot(const std::string& title, const measure::DeviationStatistics& statistics, const Stroke& stroke,
                   const std::optional<double>& mark_mm, const std::string& mark, const std::string& unit) {
    constexpr double kHeight = 210.0;
    const measure::Histogram& histogram = statistics.histogram;
    const auto percent = [&](std::uint64_t count) {
        return 100.0 * static_cast<double>(count) / static_cast<double>(statistics.count);
    };
    double least = 100.0;
    for (const std::uint64_t count : histogram.counts)
        if (count > 0) least = std::min(least, percent(count));
    const double end = histogram.width > 0.0 ? histogram.width * static_cast<double>(histogram.counts.size()) : 0.0;
    Svg svg(kPlotWidth, kHeight, title);
    svg.text({14.0, 16.0}, title, Anchor::kStart, 12.0);
    const bool marked = mark_mm && end > 0.0 && *mark_mm <= end;
    const PlotArea area{60.0,
                        28.0,
                        kPlotWidth - 14.0,
                        kHeight - (marked ? 52.0 : 36.0),
                        linear_axis(0.0, end),
                        logarithmic_axis(0.9 * least, 100.0)};
    draw_y_axis(svg, area, "Share of vertices, %");
    draw_x_axis(svg, area, "Distance, " + unit);
    const Stroke outline{stroke.colour, 0.8, ""};
    for (std::size_t bin = 0; bin < histogram.counts.size(); ++bin) {
        if (histogram.counts[bin] == 0) continue;
        const double left = area.at_x(histogram.width * static_cast<double>(bin));
        const double right = end > 0.0 ? area.at_x(histogram.width * static_cast<double>(bin + 1)) : left + 6.0;
        const double top = area.at_y(percent(histogram.counts[bin]));
        svg.rectangle({left, top}, {right - left, area.bottom - top}, "#dbe3ea", &outline);
    }
    if (marked) {
        const double x = area.at_x(*mark_mm);
        svg.line({x, area.top}, {x, area.bottom}, kMarkStroke);
        draw_legend(svg, {14.0, kHeight - 6.0}, kPlotWidth - 14.0, {{mark, kMarkStroke}});
    }
    return svg;
}

} // namespace ramus::app
