// What is said of the distances between surfaces, as JSON and for people.
#pragma once

#include "core/measure/deviation/deviation.h"

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

namespace ramus::app {

// count, mean, sigma, rms, min, max, median, percentile_95, above_percent (null without a threshold), quartiles,
// whiskers, beyond_whiskers_percent, histogram {width_mm, counts}.
[[nodiscard]] nlohmann::ordered_json deviation_json(const measure::DeviationStatistics& statistics);

// area_mm2 and volume_mm3 (null of a surface that is not closed).
[[nodiscard]] nlohmann::ordered_json size_json(const measure::SurfaceSize& size);

// Two lines under a heading of its own.
[[nodiscard]] std::string deviation_text(std::string_view heading, const measure::DeviationStatistics& statistics,
                                         const std::optional<double>& threshold);

} // namespace ramus::app
