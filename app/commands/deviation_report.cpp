#include "app/commands/deviation_report.h"

#include "app/session/numbers.h"

#include <nlohmann/json.hpp>

namespace ramus::app {

nlohmann::ordered_json deviation_json(const measure::DeviationStatistics& statistics) {
    nlohmann::ordered_json above = nullptr;
    if (statistics.above) above = 100.0 * *statistics.above;
    const measure::BoxPlot& box = statistics.box;
    return {{"count", statistics.count},
            {"mean", statistics.mean},
            {"sigma", statistics.sigma},
            {"rms", statistics.rms},
            {"min", statistics.min},
            {"max", statistics.max},
            {"median", box.median},
            {"percentile_95", statistics.percentile_95},
            {"above_percent", std::move(above)},
            {"quartiles", {box.lower_quartile, box.upper_quartile}},
            {"whiskers", {box.lower_whisker, box.upper_whisker}},
            {"beyond_whiskers_percent", 100.0 * box.beyond},
            {"histogram", {{"width_mm", statistics.histogram.width}, {"counts", statistics.histogram.counts}}}};
}

nlohmann::ordered_json size_json(const measure::SurfaceSize& size) {
    nlohmann::ordered_json volume = nullptr;
    if (size.volume_mm3) volume = *size.volume_mm3;
    return {{"area_mm2", size.area_mm2}, {"volume_mm3", std::move(volume)}};
}

std::string deviation_text(std::string_view heading, const measure::DeviationStatistics& statistics,
                           const std::optional<double>& threshold) {
    const measure::BoxPlot& box = statistics.box;
    std::string text(heading);
    text += ", mm: mean " + digits(statistics.mean, 4) + ", sigma " + digits(statistics.sigma, 4) + ", rms " +
            digits(statistics.rms, 4) + ", from " + digits(statistics.min, 4) + " to " + digits(statistics.max, 4) +
            "\n    median " + digits(box.median, 4) + ", quartiles " + digits(box.lower_quartile, 4) + " and " +
            digits(box.upper_quartile, 4) + ", whiskers " + digits(box.lower_whisker, 4) + " and " +
            digits(box.upper_whisker, 4) + " (" + digits(100.0 * box.beyond) + " % beyond)";
    if (statistics.above && threshold)
        text += "\n    " + digits(100.0 * *statistics.above) + " % above " + digits(*threshold, 4) + " mm";
    return text + "\n";
}

} // namespace ramus::app
