// Reports on distances between surfaces, as JSON and as text.
#pragma once

#include "core/measure/deviation/deviation.h"

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

namespace ramus::app {

// An object with the members count, mean, sigma, rms, min, max, median, percentile_95, above_percent (null without a
// threshold), quartiles, whiskers, beyond_whiskers_percent and histogram {width_mm, counts}. Lengths are in mm.
[[nodiscard]] nlohmann::ordered_json deviation_json(const measure::DeviationStatistics& statistics);

// An object with the members area_mm2 and volume_mm3, which is null if the surface is not closed.
[[nodiscard]] nlohmann::ordered_json size_json(const measure::SurfaceSize& size);

// The statistics as text: `heading`, two lines, and a third line if there is a threshold (mm).
[[nodiscard]] std::string deviation_text(std::string_view heading, const measure::DeviationStatistics& statistics,
                                         const std::optional<double>& threshold);

} // namespace ramus::app
